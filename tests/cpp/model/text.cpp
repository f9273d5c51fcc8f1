#include "model/text.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>

#include "model/toml.hpp"

using namespace mcplan;

TEST_CASE("numbers are written in the fewest digits that read back, as Python writes them") {
  const std::pair<double, const char*> known[] = {{0.0, "0.0"},
                                                  {-0.0, "-0.0"},
                                                  {1.0, "1.0"},
                                                  {-2.5, "-2.5"},
                                                  {0.1, "0.1"},
                                                  {1e-5, "1e-05"},
                                                  {0.0001, "0.0001"},
                                                  {123456.0, "123456.0"},
                                                  {1e15, "1000000000000000.0"},
                                                  {1e16, "1e+16"},
                                                  {1e22, "1e+22"},
                                                  {5e-324, "5e-324"},
                                                  {INFINITY, "inf"},
                                                  {-INFINITY, "-inf"},
                                                  {std::nan(""), "nan"},
                                                  {1.7976931348623157e308, "1.7976931348623157e+308"}};
  for (const auto& [value, written] : known) CHECK(model::number_text(value) == written);
  std::mt19937_64 rng(7);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t bits = rng();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    CAPTURE(bits);
    CHECK(std::strtod(model::number_text(value).c_str(), nullptr) == value);
  }
}

TEST_CASE("texts are quoted so that a terminal shows them and does not obey them") {
  CHECK(model::quote("stairs") == "'stairs'");
  CHECK(model::quote("it's") == "\"it's\"");
  CHECK(model::quote("a\nb\x1b[31m\x7f") == "'a\\nb\\x1b[31m\\x7f'");
  CHECK(model::quote("\xe2\x80\xae") == "'\\u202e'");  // right-to-left override
  CHECK(model::quote("\xc3\xb6") == "'\xc3\xb6'");
  CHECK(model::quote("\xff") == "'\\xff'");
}

TEST_CASE("values are shown in 60 characters at max_ratio") {
  const model::Value long_list(model::Value::Array(1000, model::Value(1.5)));
  CHECK(model::length(model::shown(long_list)) == 60);
}

TEST_CASE("values are shown in the words of the file that has them") {
  using model::Value;
  CHECK(model::shown(Value(Value::Array{Value(1), Value(true), Value("x")})) == "[1, true, \"x\"]");
  CHECK(model::shown(Value(false)) == "false");
  CHECK(model::shown(Value()) == "null");
  CHECK(model::shown(Value("it's \"so\"\\\n\x1b")) == "\"it's \\\"so\\\"\\\\\\n\\x1b\"");
  CHECK(model::shown(Value(Value::Table{{"a", Value(1.5)}, {"b c", Value(Value::Table{})}})) ==
        "{ a = 1.5, \"b c\" = {} }");
  for (const char* const written : {"true", "\"x\"", "[1, 2.5]", "{ a = [true] }", "2026-01-01", "07:32:00", "1e+30",
                                    "2026-01-01T07:32:00", "2026-01-01T07:32:00-07:30", "nan", "-inf"}) {
    CAPTURE(written);
    CHECK(model::shown(*model::parse_toml(std::string("key = ") + written).find("key")) == written);
  }
}

TEST_CASE("what is no UTF-8 is found where it begins") {
  CHECK(model::first_not_utf8("abc \xc3\xb6 \xf0\x9f\xa6\xa9") == std::string::npos);
  CHECK(model::first_not_utf8("name = \"\xff\xfe\"") == 8);
  CHECK(model::first_not_utf8("a\xc3") == 1);             // cut off
  CHECK(model::first_not_utf8("\xed\xa0\x80") == 0);      // half of a surrogate pair
  CHECK(model::first_not_utf8("\xc0\xaf") == 0);          // longer than need be
  CHECK(model::first_not_utf8("\xf4\x90\x80\x80") == 0);  // beyond Unicode
}

TEST_CASE("names that are nearly right are recognised") {
  const std::vector<std::string> keys = {"name", "vertices", "friction", "file", "stairs", "stairs_up"};
  CHECK(model::nearest("verticies", keys) == "vertices");
  CHECK(model::nearest("vertexes", keys) == "vertices");
  CHECK(model::nearest("nam", keys) == "name");
  CHECK(model::nearest("flie", keys) == "file");
  CHECK(model::nearest("stares", keys) == "stairs");
  CHECK(model::nearest("colour", keys) == "");
  CHECK(model::nearest(std::string(100000, 'x'), keys) == "");
  CHECK(model::did_you_mean("nam", keys) == "Did you mean 'name'? ");
}
