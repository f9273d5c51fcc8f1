#include "text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <tuple>

namespace mcplan::model {
namespace {

constexpr std::size_t max_shown = 60;

struct Character {
  char32_t code;      ///< U+FFFD for what is no UTF-8
  std::size_t bytes;  ///< 1 at least
  bool sound;
};

/// The character at the begin of a text that is not empty.
Character character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80) return {first, 1, true};
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < bytes) return {0xFFFD, 1, false};
  char32_t code = first & (0xFF >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {0xFFFD, 1, false};
    code = code << 6 | (byte(i) & 0x3F);
  }
  const bool overlong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
  if (overlong || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return {0xFFFD, 1, false};
  return {code, bytes, true};
}

/// Whether a terminal shows the character as itself: no controls, marks of direction, separators, private ones.
bool is_shown(char32_t code) {
  static constexpr std::pair<char32_t, char32_t> hidden[] = {
      {0x00, 0x1F},     {0x7F, 0xA0},     {0xAD, 0xAD},     {0x600, 0x605},     {0x61C, 0x61C},     {0x1680, 0x1680},
      {0x180E, 0x180E}, {0x2000, 0x200F}, {0x2028, 0x202F}, {0x205F, 0x206F},   {0x3000, 0x3000},   {0xD800, 0xF8FF},
      {0xFEFF, 0xFEFF}, {0xFFF0, 0xFFFB}, {0xFFFE, 0xFFFF}, {0xE0000, 0xE0FFF}, {0xF0000, 0x10FFFF}};
  return std::none_of(std::begin(hidden), std::end(hidden),
                      [&](const auto& range) { return code >= range.first && code <= range.second; });
}

void append_escaped(std::string& out, const Character& c, std::string_view text) {
  char code[16];
  if (!c.sound) {
    std::snprintf(code, sizeof code, "\\x%02x", static_cast<std::uint8_t>(text[0]));
  } else {
    const char* const format = c.code < 0x100 ? "\\x%02x" : c.code < 0x10000 ? "\\u%04x" : "\\U%08x";
    std::snprintf(code, sizeof code, format, static_cast<unsigned>(c.code));
  }
  out += code;
}

/// In quotes of one kind, with control characters and those that no terminal shows written out.
std::string quoted(std::string_view text, char mark) {
  std::string out(1, mark);
  while (!text.empty()) {
    const Character c = character(text);
    if (c.code == '\n' || c.code == '\r' || c.code == '\t') {
      out += c.code == '\n' ? "\\n" : c.code == '\r' ? "\\r" : "\\t";
    } else if (c.code == static_cast<char32_t>(mark) || c.code == '\\') {
      out += '\\';
      out += text[0];
    } else if (c.sound && (c.code == ' ' || is_shown(c.code))) {
      out += text.substr(0, c.bytes);
    } else {
      append_escaped(out, c, text);
    }
    text.remove_prefix(c.bytes);
  }
  return out + mark;
}

/// A text as files write it; what is longer than a message shows is cut.
std::string string_in_file(std::string_view text) { return quoted(prefix(text, max_shown + 1), '"'); }

/// Appends, as files write it, until the text is longer than what a message shows.
void append_shown(std::string& out, const Value& value) {
  if (out.size() > 4 * max_shown) return;
  if (const auto* const flag = value.get<bool>()) out += *flag ? "true" : "false";
  if (const auto* const whole = value.get<std::int64_t>()) out += std::to_string(*whole);
  if (const auto* const number = value.get<double>()) out += number_text(*number);
  if (const auto* const text = value.get<std::string>()) out += string_in_file(*text);
  if (const auto* const other = value.get<Value::Other>()) out += other->text;
  if (value.get<Value::Null>()) out += "null";
  if (const auto* const array = value.get<Value::Array>()) {
    out += '[';
    for (std::size_t i = 0; i < array->size() && out.size() <= 4 * max_shown; ++i) {
      if (i > 0) out += ", ";
      append_shown(out, (*array)[i]);
    }
    out += ']';
  }
  if (const auto* const table = value.get<Value::Table>()) {
    out += '{';
    for (std::size_t i = 0; i < table->size() && out.size() <= 4 * max_shown; ++i) {
      const std::string& key = (*table)[i].key;
      out += (i > 0 ? ", " : " ") + (is_bare_key(key) ? std::string(prefix(key, max_shown + 1)) : string_in_file(key)) +
             " = ";
      append_shown(out, (*table)[i].value);
    }
    out += table->empty() ? "}" : " }";
  }
}

/// Characters that two texts have in common, in the longest run first, then left and right of it (Ratcliff, Obershelp).
int in_common(std::string_view a, std::string_view b) {
  if (a.empty() || b.empty()) return 0;
  std::size_t best = 0, at_a = 0, at_b = 0;
  std::vector<std::size_t> run(b.size() + 1, 0);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = b.size(); j-- > 0;) {
      run[j + 1] = a[i] == b[j] ? run[j] + 1 : 0;
      // Of equally long runs the one that begins first in a, then in b.
      const auto begins = std::make_tuple(i + 1 - run[j + 1], j + 1 - run[j + 1]);
      if (run[j + 1] > best || (run[j + 1] == best && best > 0 && begins < std::make_tuple(at_a, at_b)))
        std::tie(best, at_a, at_b) = std::make_tuple(run[j + 1], i + 1 - run[j + 1], j + 1 - run[j + 1]);
    }
  if (best == 0) return 0;
  return static_cast<int>(best) + in_common(a.substr(0, at_a), b.substr(0, at_b)) +
         in_common(a.substr(at_a + best), b.substr(at_b + best));
}

/// The names that there are, for a message.
std::string listed(std::vector<std::string> names) {
  constexpr std::size_t max_listed = 20;
  if (names.empty()) return "none";
  const bool are_more = names.size() > max_listed;
  if (are_more) names.resize(max_listed);
  for (std::string& name : names) name = printable(prefix(name, 60));
  return joined(names) + (are_more ? ", ..." : "");
}

}  // namespace

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific).ptr;
  const std::string_view text(buffer, static_cast<std::size_t>(end - buffer));
  const std::size_t e = text.find('e');
  const int exponent = std::atoi(std::string(text.substr(e + 1)).c_str());
  if (exponent < -4 || exponent >= 16) return std::string(text);
  std::string digits;
  for (char c : text.substr(0, e))
    if (c >= '0' && c <= '9') digits += c;
  if (exponent < 0) {
    digits = "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
  } else {
    const auto whole = static_cast<std::size_t>(exponent) + 1;
    if (digits.size() <= whole) digits.append(whole + 1 - digits.size(), '0');
    digits.insert(whole, ".");
  }
  return (text[0] == '-' ? "-" : "") + digits;
}

std::string digits(double value, const char* format) {
  char out[40];
  std::snprintf(out, sizeof out, format, value);
  return out;
}

std::string digits(const Eigen::Ref<const Eigen::VectorXd>& values, const char* format) {
  std::string out;
  for (double value : values) out += (out.empty() ? "" : ", ") + digits(value, format);
  return "[" + out + "]";
}

std::string quote(std::string_view text) {
  return quoted(text, text.find('\'') != text.npos && text.find('"') == text.npos ? '"' : '\'');
}

bool is_bare_key(const std::string& key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const Character c = character(text);
    if (c.sound && (c.code == ' ' || is_shown(c.code)))
      out += text.substr(0, c.bytes);
    else
      append_escaped(out, c, text);
    text.remove_prefix(c.bytes);
  }
  return out;
}

std::string shown(const Value& value) {
  std::string out;
  append_shown(out, value);
  return length(out) <= max_shown ? out : std::string(prefix(out, max_shown - 3)) + "...";
}

std::size_t length(std::string_view text) {
  std::size_t count = 0;
  for (; !text.empty(); ++count) text.remove_prefix(character(text).bytes);
  return count;
}

std::string_view prefix(std::string_view text, std::size_t characters) {
  std::size_t bytes = 0;
  for (; characters > 0 && bytes < text.size(); --characters) bytes += character(text.substr(bytes)).bytes;
  return text.substr(0, bytes);
}

std::size_t first_not_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const Character c = character(text.substr(at));
    if (!c.sound) return at;
    at += c.bytes;
  }
  return text.npos;
}

std::string nearest(std::string_view name, const std::vector<std::string>& legal) {
  constexpr double cutoff = 0.6;
  if (length(name) > max_shown) return "";  // comparing takes the square of the length
  std::string best;
  double max_ratio = cutoff;
  for (const std::string& entry : legal) {
    if (length(entry) > max_shown || name.size() + entry.size() == 0) continue;
    const double ratio = 2.0 * in_common(entry, name) / static_cast<double>(name.size() + entry.size());
    if (ratio > max_ratio || (ratio == max_ratio && entry > best)) {
      max_ratio = ratio;
      best = entry;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& legal) {
  const std::string near = nearest(name, legal);
  return near.empty() ? "" : "Did you mean " + quote(near) + "? ";
}

std::string name_rule(const std::string& what, std::string_view name, const std::vector<std::string>& legal) {
  return "must name " + what + ". " + did_you_mean(name, legal) + "There are: " + listed(legal);
}

std::string joined(const std::vector<std::string>& names, const char* separator) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : separator) + name;
  return out;
}

}  // namespace mcplan::model
