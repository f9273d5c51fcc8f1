#include "json.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "file_kind.hpp"
#include "text.hpp"

namespace mcplan::model {
namespace {

constexpr std::size_t max_json_depth = 100;
/// Of a text, tables and lists among them: each takes 50 bytes.
constexpr std::size_t max_json_values = 2'000'000;

/// Takes what the parser finds, piece by piece, so that neither it nor this needs stack for what is nested.
class ValueBuilder {
 public:
  Value root;

  bool null() { return put(Value()); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(std::int64_t value) { return put(value); }
  bool number_unsigned(std::uint64_t value) {
    if (value > static_cast<std::uint64_t>(INT64_MAX)) return put(Value::Other{std::to_string(value)});
    return put(static_cast<std::int64_t>(value));
  }
  bool number_float(double value, const std::string&) { return put(value); }
  bool string(std::string& value) { return put(std::move(value)); }
  bool binary(nlohmann::json::binary_t&) { return false; }
  bool start_object(std::size_t) { return open(Value::Table()); }
  bool start_array(std::size_t) { return open(Value::Array()); }
  bool key(std::string& value) {
    key_ = std::move(value);
    return true;
  }
  bool end_object() { return has_each_key_once(*open_.back().value.get<Value::Table>()) && close(); }
  bool end_array() { return close(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) {
    const std::string what = error.what();  // "[json.exception.parse_error.101] parse error at line 1, ..."
    const std::size_t begin = what.find("] ");
    reason = begin == what.npos ? what : what.substr(begin + 2);
    return false;
  }

  std::string reason = "arrays and objects nested too deep";
  bool too_many = false;

 private:
  /// Whether there are not too many yet.
  bool counted() {
    if (++count_ <= max_json_values) return true;
    too_many = true;
    return false;
  }

  /// JSON leaves open which of two entries with the same key holds; TOML and we refuse them.
  bool has_each_key_once(const Value::Table& table) {
    keys_.clear();
    for (const Entry& entry : table) keys_.push_back(entry.key);
    std::sort(keys_.begin(), keys_.end());
    const auto again = std::adjacent_find(keys_.begin(), keys_.end());
    if (again == keys_.end()) return true;
    reason = "the key " + shown(std::string(*again)) + " twice";
    return false;
  }

  bool put(Value value) {
    add(std::move(value));
    return counted();
  }

  bool open(Value value) {
    if (open_.size() >= max_json_depth || !counted()) return false;
    open_.push_back({std::move(key_), std::move(value)});
    key_.clear();
    return true;
  }

  bool close() {
    Entry done = std::move(open_.back());
    open_.pop_back();
    key_ = std::move(done.key);
    add(std::move(done.value));
    return true;
  }

  void add(Value value) {
    if (open_.empty()) {
      root = std::move(value);
    } else if (auto* const array = open_.back().value.get<Value::Array>()) {
      array->push_back(std::move(value));
    } else {
      open_.back().value.get<Value::Table>()->push_back({std::move(key_), std::move(value)});
    }
    key_.clear();
  }

  std::vector<Entry> open_;
  std::string key_;
  std::vector<std::string_view> keys_;  ///< of the table that ends
  std::size_t count_ = 0;
};

void append_json_string(std::string& out, const std::string& text) {
  out += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// How JSON is laid out.
struct Layout {
  int indent, open_levels;
};

void append_json(std::string& out, const Value& value, const Layout& layout, int level) {
  // A list of numbers or texts stands on one line, whatever the level.
  const auto* const array = value.get<Value::Array>();
  const bool flat = array && (array->empty() || !((*array)[0].get<Value::Table>() || (*array)[0].get<Value::Array>()));
  const bool open = layout.indent > 0 && level < layout.open_levels && !flat;
  const auto line = [&](int at) {
    if (open) out += "\n" + std::string(static_cast<std::size_t>(layout.indent * at), ' ');
  };
  const char* const comma = open ? "," : ", ";
  if (const auto* const flag = value.get<bool>()) out += *flag ? "true" : "false";
  if (const auto* const whole = value.get<std::int64_t>()) out += std::to_string(*whole);
  if (const auto* const number = value.get<double>()) out += std::isfinite(*number) ? number_text(*number) : "null";
  if (const auto* const text = value.get<std::string>()) append_json_string(out, *text);
  if (value.get<Value::Null>() || value.get<Value::Other>()) out += "null";
  if (array) {
    out += '[';
    for (std::size_t i = 0; i < array->size(); ++i) {
      if (i > 0) out += comma;
      line(level + 1);
      append_json(out, (*array)[i], layout, level + 1);
    }
    line(level);
    out += ']';
  }
  if (const auto* const table = value.get<Value::Table>()) {
    out += '{';
    for (std::size_t i = 0; i < table->size(); ++i) {
      if (i > 0) out += comma;
      line(level + 1);
      append_json_string(out, (*table)[i].key);
      out += ": ";
      append_json(out, (*table)[i].value, layout, level + 1);
    }
    if (!table->empty()) line(level);
    out += '}';
  }
}

}  // namespace

Value parse_json(std::string_view text) {
  ValueBuilder builder;
  if (nlohmann::json::sax_parse(text.begin(), text.end(), &builder)) return std::move(builder.root);
  if (builder.too_many) throw std::length_error("may have " + std::to_string(max_json_values) + " values at most");
  const std::string kind = file_kind_or_toml(text);
  throw std::invalid_argument(kind.empty() || kind == "JSON" ? builder.reason : kind);
}

std::string json_text(const Value& value, int indent, int open_levels) {
  std::string out;
  append_json(out, value, {indent, open_levels}, 0);
  return out;
}

}  // namespace mcplan::model
