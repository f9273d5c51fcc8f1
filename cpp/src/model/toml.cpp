#include "toml.hpp"

#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#define TOML_ENABLE_UNRELEASED_FEATURES 0
#define TOML_MAX_NESTED_VALUES 64
// What a file says is never a slip of ours: "[[[" would end a build with assertions.
#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <tuple>

#include "file_kind.hpp"
#include "mcplan/base/error.hpp"
#include "text.hpp"

namespace mcplan::model {
namespace {

constexpr std::size_t line_width = 110;
/// Of a key a.b.c: the parser takes time that grows with the square of their number, and stack for each when it ends.
constexpr int max_key_parts = 100;
/// Of tables and lists in each other.
constexpr int max_depth = 100;

// --- reading ---

bool has_long_key(std::string_view text) {
  enum { nothing, word, dot, space_after_word, space_after_dot } last = nothing;
  int parts = 0;
  for (const char c : text) {
    const bool in_word =
        std::isalnum(static_cast<unsigned char>(c)) || (c & 0x80) || c == '_' || c == '-' || c == '"' || c == '\'';
    if (in_word) {
      if (last == space_after_word) parts = 0;
      last = word;
    } else if (c == '.') {
      parts = last == word || last == space_after_word ? parts + 1 : 0;
      last = dot;
    } else if (c == ' ' || c == '\t') {
      last = last == word || last == space_after_word ? space_after_word : last == nothing ? nothing : space_after_dot;
    } else {
      last = nothing;
      parts = 0;
    }
    if (parts >= max_key_parts) return true;
  }
  return false;
}

std::string date_text(const toml::date& date) {
  char out[40];
  std::snprintf(out, sizeof out, "%04d-%02d-%02d", date.year, date.month, date.day);
  return out;
}

std::string time_text(const toml::time& time) {
  char out[60];
  std::snprintf(out, sizeof out, "%02d:%02d:%02d", time.hour, time.minute, time.second);
  if (time.nanosecond > 0) std::snprintf(out + 8, sizeof out - 8, ".%09u", static_cast<unsigned>(time.nanosecond));
  return out;
}

std::string date_time_text(const toml::date_time& both) {
  const std::string text = date_text(both.date) + "T" + time_text(both.time);
  if (!both.offset) return text;
  const int minutes = both.offset->minutes;
  char out[20];
  std::snprintf(out, sizeof out, "%c%02d:%02d", minutes < 0 ? '-' : '+', std::abs(minutes) / 60,
                std::abs(minutes) % 60);
  return text + out;
}

Value value_of(const toml::node& node, int depth);

Value table_of(const toml::table& table, int depth) {
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (const auto& [key, node] : table) entries.emplace_back(&key, &node);
  // The parser sorts by name; messages and what is written again keep the order of the file.
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    const auto place = [](const toml::key& key) {
      return std::make_tuple(key.source().begin.line, key.source().begin.column);
    };
    return place(*a.first) < place(*b.first);
  });
  Value::Table out;
  out.reserve(entries.size());
  for (const auto& [key, node] : entries) out.push_back({std::string(key->str()), value_of(*node, depth + 1)});
  return out;
}

Value value_of(const toml::node& node, int depth) {
  if (depth > max_depth) throw InvalidInput("", "is not TOML: nested too deep", "");
  if (const auto* const table = node.as_table()) return table_of(*table, depth);
  if (const auto* const array = node.as_array()) {
    Value::Array out;
    out.reserve(array->size());
    for (const toml::node& item : *array) out.push_back(value_of(item, depth + 1));
    return out;
  }
  if (const auto* const text = node.as_string()) return text->get();
  if (const auto* const whole = node.as_integer()) return static_cast<std::int64_t>(whole->get());
  if (const auto* const number = node.as_floating_point()) return number->get();
  if (const auto* const flag = node.as_boolean()) return flag->get();
  if (const auto* const date = node.as_date()) return Value::Other{date_text(date->get())};
  if (const auto* const time = node.as_time()) return Value::Other{time_text(time->get())};
  return Value::Other{date_time_text(node.as_date_time()->get())};
}

// --- writing ---

bool is_table(const Value& value) { return value.get<Value::Table>() != nullptr; }

bool is_tables(const Value& value) {
  const auto* const array = value.get<Value::Array>();
  return array && !array->empty() && std::all_of(array->begin(), array->end(), is_table);
}

/// A basic string: what TOML forbids in it is written as \uXXXX.
std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    switch (c) {
      case '"':
        out += "\\\"";
        break;
      case '\\':
        out += "\\\\";
        break;
      case '\n':
        out += "\\n";
        break;
      case '\r':
        out += "\\r";
        break;
      case '\t':
        out += "\\t";
        break;
      case '\b':
        out += "\\b";
        break;
      case '\f':
        out += "\\f";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
          char code[8];
          std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
          out += code;
        } else {
          out += c;
        }
    }
  }
  return out + "\"";
}

std::string toml_key(const std::string& key) { return is_bare_key(key) ? key : toml_string(key); }

std::string inline_text(const Value& value) {
  if (const auto* const flag = value.get<bool>()) return *flag ? "true" : "false";
  if (const auto* const text = value.get<std::string>()) return toml_string(*text);
  if (const auto* const whole = value.get<std::int64_t>()) return std::to_string(*whole);
  if (const auto* const number = value.get<double>()) return number_text(*number);
  if (const auto* const other = value.get<Value::Other>()) return other->text;
  std::string out;
  if (const auto* const array = value.get<Value::Array>()) {
    for (const Value& item : *array) out += (out.empty() ? "" : ", ") + inline_text(item);
    return "[" + out + "]";
  }
  if (const auto* const table = value.get<Value::Table>()) {
    for (const Entry& entry : *table)
      out += (out.empty() ? "" : ", ") + toml_key(entry.key) + " = " + inline_text(entry.value);
    return out.empty() ? "{}" : "{ " + out + " }";
  }
  return "{}";
}

std::string pair_text(const Entry& entry) {
  const std::string line = toml_key(entry.key) + " = " + inline_text(entry.value);
  const auto* const array = entry.value.get<Value::Array>();
  if (!array || length(line) <= line_width) return line;
  std::string out = toml_key(entry.key) + " = [\n";
  for (const Value& item : *array) out += "  " + inline_text(item) + ",\n";
  return out + "]";
}

/// A table under its title; tables in it that are too long for a line become sections of their own.
void append_section(std::string& out, const std::string& path, const Value::Table& table, bool in_list) {
  const auto is_long = [](const Entry& e) { return is_table(e.value) && length(pair_text(e)) > line_width; };
  out += in_list ? "\n[[" + path + "]]\n" : "\n[" + path + "]\n";
  for (const Entry& entry : table)
    if (!is_long(entry)) out += pair_text(entry) + "\n";
  for (const Entry& entry : table)
    if (is_long(entry)) append_section(out, path + "." + toml_key(entry.key), *entry.value.get<Value::Table>(), false);
}

/// Lines of a comment: control characters, which TOML forbids there, are written out.
std::string comment(const std::string& header) {
  std::string out, line;
  const auto finish = [&] {
    while (!line.empty() && line.back() == ' ') line.pop_back();
    out += line.empty() ? "#\n" : "# " + printable(line) + "\n";
    line.clear();
  };
  for (const char c : header)
    if (c == '\n')
      finish();
    else
      line += c;
  if (!line.empty()) finish();
  return out;
}

/// Says of a text that is not TOML what it is instead, if that is known.
void require_no_other_kind(std::string_view text) {
  if (const std::string kind = file_kind(text); !kind.empty()) throw InvalidInput("", "must be TOML", kind);
}

}  // namespace

Value parse_toml(std::string_view text) {
  if (const std::size_t bad = first_not_utf8(text); bad != text.npos) {
    require_no_other_kind(text);
    char value[60];
    std::snprintf(value, sizeof value, "byte 0x%02x at offset %zu", static_cast<unsigned char>(text[bad]), bad);
    throw InvalidInput("", "must be UTF-8 text", value);
  }
  if (text.find_first_not_of(" \t\r\n\v\f") == text.npos) throw InvalidInput("", "is empty", "");
  if (has_long_key(text))
    throw InvalidInput("", "is not TOML of ours: a key may have " + std::to_string(max_key_parts) + " parts at most",
                       "");
  const toml::parse_result parsed = toml::parse(text);
  if (parsed) return table_of(parsed.table(), 0);
  require_no_other_kind(text);
  const toml::parse_error& error = parsed.error();
  std::string reason(error.description());
  if (reason.find("maximum nested") != reason.npos) throw InvalidInput("", "is not TOML: nested too deep", "");
  reason[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(reason[0])));
  const auto& at = error.source().begin;
  throw InvalidInput(
      "",
      "is not TOML: " + reason + " (at line " + std::to_string(at.line) + ", column " + std::to_string(at.column) + ")",
      "");
}

std::string toml_text(const Value& value, const std::string& header) {
  std::string out = comment(header);
  const auto* const table = value.get<Value::Table>();
  if (!table) return out;
  for (const Entry& entry : *table)
    if (!is_table(entry.value) && !is_tables(entry.value)) out += pair_text(entry) + "\n";
  for (const Entry& entry : *table) {
    if (is_table(entry.value)) append_section(out, toml_key(entry.key), *entry.value.get<Value::Table>(), false);
    if (is_tables(entry.value))
      for (const Value& item : *entry.value.get<Value::Array>())
        append_section(out, toml_key(entry.key), *item.get<Value::Table>(), true);
  }
  return out;
}

}  // namespace mcplan::model
