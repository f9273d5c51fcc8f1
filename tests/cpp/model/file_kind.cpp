#include "model/file_kind.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mcplan/base/error.hpp"
#include "model/json.hpp"
#include "model/toml.hpp"

using namespace mcplan;

namespace {

using namespace std::string_literals;

/// A local header of a zip archive with the name of its first member.
std::string archive(const std::string& member) {
  return "PK\x03\x04"s + std::string(22, '\0') + static_cast<char>(member.size()) + "\0\0\0"s + member + "\x89\xff"s;
}

const std::vector<std::pair<std::string, std::string>> binaries = {
    {archive("header.npy"), "an .npz archive"}, {archive("mimetype"), "a zip archive"},
    {"PK\x03\x04"s, "a zip archive"},           {"\x89PNG\r\n\x1a\n\0\0"s, "a PNG picture"},
    {"\xff\xd8\xff\xe0"s, "a JPEG picture"},    {"%PDF-1.7\n"s, "a PDF document"},
    {"\x1f\x8b\x08"s, "a gzip archive"},        {"\x93NUMPY\x01"s, "an .npy array"},
    {"name = 1\0\xff"s, "binary data"},         {"<?xml version=\"1.0\"?><robot/>"s, "XML"},
};

}  // namespace

TEST_CASE("files of another kind are called what they are") {
  for (const auto& [content, kind] : binaries) {
    CHECK(model::file_kind(content) == kind);
    CHECK_THROWS_WITH_AS(model::parse_json(content), kind.c_str(), std::invalid_argument);
    try {
      model::parse_toml(content);
      FAIL(kind);
    } catch (const InvalidInput& found) {
      CHECK(std::string(found.what()) == "must be TOML, got " + kind);
    }
  }
  CHECK_THROWS_WITH_AS(model::parse_toml("{\"a\": 1}"), "must be TOML, got JSON", InvalidInput);
  CHECK_THROWS_WITH_AS(model::parse_json("a = 1\n"), "TOML", std::invalid_argument);
  CHECK(model::file_kind_or_toml("a = 1\n") == "TOML");
}

TEST_CASE("text of the kind that is expected keeps the place of its mistake") {
  CHECK(model::file_kind("a = \n") == "");
  CHECK_THROWS_WITH_AS(model::parse_toml("name = \"\xe9\""), "must be UTF-8 text, got byte 0xe9 at offset 8",
                       InvalidInput);
  for (const std::string json : {"{\"a\": }", "[1, 2", ""}) {
    try {
      model::parse_json(json);
      FAIL(json);
    } catch (const std::invalid_argument& found) {
      CHECK(std::string(found.what()).find("parse error") == 0);
    }
  }
  CHECK_NOTHROW(model::parse_toml("GIF89a = 1\nPK = 2\n"));  // signatures that are keys as well
}
