#include "model/toml.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "mcplan/base/error.hpp"
#include "model/json.hpp"

using namespace mcplan;

namespace {

/// Rule of the error of a text that is refused, "" where it is read.
std::string rule(const std::string& text) {
  try {
    model::parse_toml(text);
  } catch (const InvalidInput& found) {
    return found.rule();
  }
  return "";
}

std::string repeated(const std::string& piece, int count) {
  std::string out;
  for (int i = 0; i < count; ++i) out += piece;
  return out;
}

}  // namespace

TEST_CASE("tables keep the order of the file") {
  const model::Value data = model::parse_toml("z = 1\na = [1.5, true, 'x']\n[m]\ny = 2\nb = 3\n");
  CHECK(model::json_text(data) == R"({"z": 1, "a": [1.5, true, "x"], "m": {"y": 2, "b": 3}})");
}

TEST_CASE("what is written reads back the same") {
  const std::string text =
      "# a comment\nname = \"\\u001b \\\" \\\\\"\n\"odd key\" = 1e-300\nlist = [1, 2.0]\n\n[table]\nx = true\n\n"
      "[[items]]\ny = [[0.1, 0.2], [0.3, 0.4]]\n";
  const model::Value data = model::parse_toml(text);
  CHECK(model::toml_text(data, "a comment") == text);
}

TEST_CASE("long lists take a line an entry") {
  model::Value::Array rows;
  for (int i = 0; i < 12; ++i)
    rows.push_back(model::Value::Array{model::Value(i + 0.123456789), model::Value(-0.123456789)});
  model::Value data;
  data.set("vertices", rows);
  const std::string text = model::toml_text(data);
  CHECK(std::count(text.begin(), text.end(), '\n') == 14);
}

TEST_CASE("no text overflows the stack or takes long") {
  CHECK(rule("x = " + repeated("[", 100000)).find("nested too deep") != std::string::npos);
  CHECK(rule("x = " + repeated("{a=", 100000)).find("nested too deep") != std::string::npos);
  CHECK(rule("a" + repeated(".a", 500000) + " = 1").find("100 parts") != std::string::npos);
  CHECK(rule("[" + repeated("a . ", 500000) + "a]").find("100 parts") != std::string::npos);
  // The deepest that both limits allow: keys of 99 parts in tables in each other.
  std::string deep = "x = ";
  for (int i = 0; i < 60; ++i) deep += "{" + repeated("a.", 99) + "a = ";
  CHECK(rule(deep + "1" + repeated("}", 60)).find("nested too deep") != std::string::npos);
}

TEST_CASE("sentences with full stops are no long keys") {
  CHECK(rule("x = '" + repeated("One two. ", 300) + "'") == "");
  CHECK(rule("x = [" + repeated("1.5, ", 300) + "]") == "");
}

TEST_CASE("what is no TOML is said with its place") {
  CHECK(rule("") == "is empty");
  CHECK(rule(" \n\t") == "is empty");
  CHECK(rule("a = \xff").rfind("must be UTF-8", 0) == 0);
  CHECK(rule("a = 1\na = 2").rfind("is not TOML: ", 0) == 0);
  CHECK(rule("a = 1\nb = ").find("(at line 2, column 5)") != std::string::npos);
}
