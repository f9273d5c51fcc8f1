#include "file_kind.hpp"

#include <algorithm>
#include <utility>

#include "mcplan/base/error.hpp"
#include "reading.hpp"
#include "toml.hpp"

namespace mcplan::model {
namespace {

using namespace std::string_view_literals;

constexpr std::pair<std::string_view, const char*> signatures[] = {
    {"\x89PNG\r\n\x1a\n"sv, "a PNG picture"},
    {"\xff\xd8\xff"sv, "a JPEG picture"},
    {"GIF87a"sv, "a GIF picture"},
    {"GIF89a"sv, "a GIF picture"},
    {"%PDF-"sv, "a PDF document"},
    {"\x93NUMPY"sv, "an .npy array"},
    {"\x1f\x8b"sv, "a gzip archive"},
    {"\xfd"
     "7zXZ\0"sv,
     "an xz archive"},
    {"BZh"sv, "a bzip2 archive"},
    {"\x89HDF\r\n\x1a\n"sv, "an HDF5 file"},
    {"\x7f"
     "ELF"sv,
     "a compiled program"},
    {"glTF"sv, "a glTF mesh"},
    {"\xff\xfe"sv, "UTF-16 text"},
    {"\xfe\xff"sv, "UTF-16 text"},
};

bool begins(std::string_view text, std::string_view with) { return text.substr(0, with.size()) == with; }

/// A zip archive; those of NumPy have arrays for members.
std::string archive_kind(std::string_view content) {
  constexpr std::size_t name_at = 30, size_at = 26;  // of the first member's name, and of its length
  if (content.size() < name_at) return "a zip archive";
  const std::size_t size =
      static_cast<unsigned char>(content[size_at]) + 256U * static_cast<unsigned char>(content[size_at + 1]);
  const std::string_view name = content.substr(name_at, size);
  const bool is_array = name.size() > 4 && name.substr(name.size() - 4) == ".npy";
  return is_array ? "an .npz archive" : "a zip archive";
}

}  // namespace

std::string file_kind(std::string_view content) {
  if (begins(content, "PK\x03\x04") || begins(content, "PK\x05\x06")) return archive_kind(content);
  for (const auto& [signature, kind] : signatures)
    if (begins(content, signature)) return kind;
  if (begins(content, "\xef\xbb\xbf")) content.remove_prefix(3);
  const std::string_view text = content.substr(std::min(content.find_first_not_of(" \t\r\n"), content.size()));
  if (content.find('\0') != content.npos) return "binary data";
  if (begins(text, "{")) return "JSON";
  if (begins(text, "<!DOCTYPE html") || begins(text, "<html")) return "an HTML page";
  return begins(text, "<") ? "XML" : "";
}

std::string file_kind_or_toml(std::string_view content) {
  if (std::string kind = file_kind(content); !kind.empty()) return kind;
  if (content.size() > max_toml_bytes) return "";
  try {
    parse_toml(content);
    return "TOML";
  } catch (const InvalidInput&) {
    return "";
  }
}

}  // namespace mcplan::model
