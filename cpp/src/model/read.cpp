#include "read.hpp"

#include <algorithm>
#include <climits>
#include <cstdio>
#include <set>

namespace mcplan::model {
namespace {

constexpr std::size_t max_keys = 1000;
/// Of a list whose entries are named elsewhere.
constexpr std::size_t max_names = 1000;

std::string short_text(double value) {
  char out[32];
  std::snprintf(out, sizeof out, "%.10g", value);
  return out;
}

std::string interval(const Rules& rules) {
  return (rules.above_low ? "(" : "[") + short_text(rules.low) + ", " + short_text(rules.high) +
         (rules.below_high ? ")" : "]");
}

}  // namespace

std::string broken_rule(double value, const Rules& rules) {
  const bool low = rules.above_low ? value > rules.low : value >= rules.low;
  const bool high = rules.below_high ? value < rules.high : value <= rules.high;
  if (rules.both_ends) return low && high ? "" : "must lie in " + interval(rules);
  if (!rules.may_be_infinite && !std::isfinite(value) && !(std::isnan(value) && rules.high < unbounded))
    return "must be a finite number";
  if (rules.high < unbounded && !high)
    return (rules.below_high ? "must be less than " : "must be at most ") + short_text(rules.high);
  if (std::isnan(value) && rules.low == -unbounded) return "must be a number";
  if (rules.above_low && !low)
    return rules.low == 0.0 ? "must be a positive number" : "must be greater than " + short_text(rules.low);
  if (!low) return "must be at least " + short_text(rules.low);
  return "";
}

bool require_entries(std::size_t count, const Rules& rules, const Place& at, Findings& found, bool points) {
  if (count > rules.max_entries) {
    found.add(at, "may have " + std::to_string(rules.max_entries) + " entries at most", std::to_string(count));
    return false;
  }
  if (count < rules.min_entries) {
    const std::string what = points ? " points" : rules.min_entries == 1 ? " entry" : " entries";
    found.add(at, "needs at least " + std::to_string(rules.min_entries) + what, std::to_string(count));
    return false;
  }
  return true;
}

void require_keys(const Value::Table& table, const std::vector<std::string>& legal,
                  const std::vector<std::string>& required, const Place& at, Findings& found) {
  std::vector<std::string> unknown, meant;
  for (const Entry& entry : table)
    if (std::find(legal.begin(), legal.end(), entry.key) == legal.end()) {
      unknown.push_back(entry.key);
      meant.push_back(nearest(entry.key, legal));
    }
  for (const std::string& key : required) {
    const bool misspelt = std::find(meant.begin(), meant.end(), key) != meant.end();
    if (misspelt)
      found.lacks(Place(at, key).text());
    else
      found.add(Place(at, key), "is required", "");
  }
  for (const std::string& key : unknown) {
    // The legal keys of a table are listed once.
    const std::string keys = &key == &unknown.front() ? "Keys: " + joined(legal) : "";
    std::string rule = "no such key. " + did_you_mean(key, legal) + keys;
    while (rule.back() == ' ' || (keys.empty() && rule.back() == '.')) rule.pop_back();
    found.add(Place(at, key), std::move(rule), "");
  }
}

bool require_few_keys(const Value& value, Findings& found) {
  struct Left {
    std::string where;
    const Value* value;
  };
  std::vector<Left> left = {{"", &value}};
  while (!left.empty()) {
    const Left at = left.back();
    left.pop_back();
    if (const auto* const table = at.value->get<Value::Table>()) {
      if (table->size() > max_keys) {
        found.add(at.where, "may have " + std::to_string(max_keys) + " keys at most", std::to_string(table->size()));
        return false;
      }
      for (const Entry& entry : *table)
        if (entry.value.get<Value::Table>() || entry.value.get<Value::Array>())
          left.push_back({at.where + (at.where.empty() ? "" : ".") + printable(entry.key), &entry.value});
    } else if (const auto* const array = at.value->get<Value::Array>()) {
      for (std::size_t i = 0; i < array->size(); ++i)
        if ((*array)[i].get<Value::Table>() || (*array)[i].get<Value::Array>())
          left.push_back({at.where + "[" + std::to_string(i) + "]", &(*array)[i]});
    }
  }
  return true;
}

bool read_value(const Value& value, bool& out, const Rules&, const Place& at, Reading& reading) {
  if (const bool* const flag = value.get<bool>()) return out = *flag, true;
  reading.found.add(at, "must be true or false", shown(value));
  return false;
}

NameList names_in(const Value* list) {
  const auto* const entries = list ? list->get<Value::Array>() : nullptr;
  NameList out;
  out.is_complete = entries && !entries->empty() && entries->size() <= max_names;
  if (!out.is_complete) return out;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < entries->size(); ++i) {
    const Value* const name = (*entries)[i].find("name");
    const auto* const text = name ? name->get<std::string>() : nullptr;
    out.names.push_back(text ? *text : "");
    out.is_complete = out.is_complete && !out.names.back().empty() && taken.insert(out.names.back()).second;
  }
  return out;
}

bool find_name(const std::string& name, const NameList& list, const char* what, int& out, const Place& at,
               Reading& reading) {
  const auto found = std::find(list.names.begin(), list.names.end(), name);
  if (found != list.names.end() && !name.empty()) return out = static_cast<int>(found - list.names.begin()), true;
  if (list.is_complete && !reading.found.are_many())
    reading.found.add(at, name_rule(what, name, list.names), shown(name));
  else
    reading.found.lacks(at.text());
  return false;
}

bool read_name_or(const Value& value, std::string& name, Value& table, const Place& at, Reading& reading) {
  const auto* const text = value.get<std::string>();
  if (text && !text->empty()) return name = *text, true;
  if (value.get<Value::Table>()) return table = value, true;
  reading.found.add(at, "must be a name, a path or a table", shown(value));
  return false;
}

bool read_value(const Value& value, int& out, const Rules& rules, const Place& at, Reading& reading) {
  if (rules.list && !reading.exact) {
    Rules named;
    named.not_empty = true;
    std::string name;
    return read_value(value, name, named, at, reading) &&
           find_name(name, reading.lists[rules.list], rules.what, out, at, reading);
  }
  const auto* const whole = value.get<std::int64_t>();
  if (!whole || *whole < INT_MIN || *whole > INT_MAX) {
    reading.found.add(at, whole ? "must be a whole number of 32 bits" : "must be a whole number", shown(value));
    return false;
  }
  if (const std::string rule = broken_rule(static_cast<double>(*whole), rules); !rule.empty()) {
    reading.found.add(at, rule, shown(value));
    return false;
  }
  return out = static_cast<int>(*whole), true;
}

bool read_value(const Value& value, double& out, const Rules& rules, const Place& at, Reading& reading) {
  const auto* const whole = value.get<std::int64_t>();
  const auto* const number = value.get<double>();
  const auto* const text = value.get<std::string>();
  // JSON has no infinite numbers: files have their names instead.
  if ((reading.exact || rules.may_be_infinite) && text && (*text == "inf" || *text == "-inf"))
    return read_value((*text == "inf" ? 1.0 : -1.0) * unbounded, out, rules, at, reading);
  if (!whole && !number) {
    reading.found.add(at, "must be a number", shown(value));
    return false;
  }
  const double found = number ? *number : static_cast<double>(*whole);
  if (const std::string rule = broken_rule(found, rules); !rule.empty()) {
    reading.found.add(at, rule, shown(value));
    return false;
  }
  return out = found, true;
}

bool read_value(const Value& value, std::string& out, const Rules& rules, const Place& at, Reading& reading) {
  const auto* const text = value.get<std::string>();
  if (!text || (rules.not_empty && text->empty())) {
    reading.found.add(at, text ? "must not be empty" : "must be a string", shown(value));
    return false;
  }
  return out = *text, true;
}

bool read_value(const Value& value, Eigen::VectorXd& out, const Rules& rules, const Place& at, Reading& reading) {
  std::vector<double> numbers;
  if (!read_list(value, numbers, rules, at, reading)) return false;
  out = Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
  return true;
}

bool read_value(const Value& value, Eigen::Matrix<double, Eigen::Dynamic, 3>& out, const Rules& rules, const Place& at,
                Reading& reading) {
  std::vector<Eigen::Vector3d> rows;
  if (!read_list(value, rows, rules, at, reading)) return false;
  out.resize(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) out.row(static_cast<Eigen::Index>(i)) = rows[i];
  return true;
}

bool read_value(const Value& value, Eigen::MatrixXd& out, const Rules& rules, const Place& at, Reading& reading) {
  const auto* const list = value.get<Value::Array>();
  if (!list) {
    reading.found.add(at, "must be a list", shown(value));
    return false;
  }
  if (!require_entries(list->size(), rules, at, reading.found, false)) return false;
  Rules of_row = rules;
  of_row.min_entries = 0, of_row.max_entries = any_number;
  std::vector<Eigen::VectorXd> rows(list->size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!read_value((*list)[i], rows[i], of_row, Place(at, i), reading)) return false;
    if (rows[i].size() == rows[0].size()) continue;
    reading.found.add(Place(at, i), "must be as long as the rows before", std::to_string(rows[i].size()));
    return false;
  }
  out.resize(static_cast<Eigen::Index>(rows.size()), rows.empty() ? 0 : rows[0].size());
  for (std::size_t i = 0; i < rows.size(); ++i) out.row(static_cast<Eigen::Index>(i)) = rows[i].transpose();
  return true;
}

void check_number(double value, const Rules& rules, const Place& at, Findings& found) {
  if (const std::string rule = broken_rule(value, rules); !rule.empty()) found.add(at, rule, mcplan::text(value));
}

void check_range(const Range& value, const Rules& rules, const Place& at, Findings& found) {
  const bool inside = broken_rule(value.min, rules).empty() && broken_rule(value.max, rules).empty();
  if (inside && (rules.grows ? value.max > value.min : value.max >= value.min)) return;
  const std::string numbers = rules.above_low && rules.low == 0.0 ? "positive numbers" : "numbers";
  found.add(at, "must be two " + numbers + ", the second " + (rules.grows ? "larger" : "not smaller"),
            mcplan::text(value.min) + ", " + mcplan::text(value.max));
}

}  // namespace mcplan::model
