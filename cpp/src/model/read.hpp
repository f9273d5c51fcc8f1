#pragma once

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "fields.hpp"
#include "findings.hpp"
#include "mcplan/base/range.hpp"
#include "names.hpp"
#include "text.hpp"
#include "value.hpp"

namespace mcplan::model {

/// What reading one file goes by.
struct Reading {
  Findings found;
  NameLists lists;               ///< by the name that fields give them
  bool exact = false;            ///< what written_exactly() wrote: names of members for keys, indices, infinite as text
  std::string source;            ///< the file, for messages; "" where data come from elsewhere
  std::filesystem::path folder;  ///< where files that it names are looked for
  bool in_file = false;          ///< whether it may name files
};

/// Rule that a number breaks, or "".
std::string broken_rule(double value, const Rules& rules);

/// Says that a list has too few or too many entries; `what`: "points" or "entries".
bool require_entries(std::size_t count, const Rules& rules, const Place& at, Findings& found, bool points);

/// Says that a table has keys that are unknown, and required ones that are missing unless an unknown one means them.
void require_keys(const Value::Table& table, const std::vector<std::string>& legal,
                  const std::vector<std::string>& required, const Place& at, Findings& found);

/// A table of more than 1000 keys, anywhere, is said alone: they would be as many findings. False: there is one.
bool require_few_keys(const Value& value, Findings& found);

// Reads a value into a member; what is wrong with it goes to the findings, and the member stays as it is.
bool read_value(const Value& value, bool& out, const Rules&, const Place& at, Reading& reading);
bool read_value(const Value& value, int& out, const Rules& rules, const Place& at, Reading& reading);
bool read_value(const Value& value, double& out, const Rules& rules, const Place& at, Reading& reading);
bool read_value(const Value& value, std::string& out, const Rules& rules, const Place& at, Reading& reading);
bool read_value(const Value& value, Eigen::VectorXd& out, const Rules& rules, const Place& at, Reading& reading);
bool read_value(const Value& value, Eigen::Matrix<double, Eigen::Dynamic, 3>& out, const Rules& rules, const Place& at,
                Reading& reading);

template <class V>
bool read_value(const Value& value, V& out, const Rules& rules, const Place& at, Reading& reading);

/// Reads a matrix whose rows are equally long, row by row.
bool read_value(const Value& value, Eigen::MatrixXd& out, const Rules& rules, const Place& at, Reading& reading);

/// The names of the entries of a list of tables, as far as they can be known.
NameList names_in(const Value* list);

/// Reads what NameOr holds.
bool read_name_or(const Value& value, std::string& name, Value& table, const Place& at, Reading& reading);

/// Finds a name in a list; says what the names are where it is not there.
bool find_name(const std::string& name, const NameList& list, const char* what, int& out, const Place& at,
               Reading& reading);

/// A value to read into: Eigen leaves its vectors as they come.
template <class V>
V blank() {
  if constexpr (std::is_base_of_v<Eigen::MatrixBase<V>, V>) {
    if constexpr (V::SizeAtCompileTime != Eigen::Dynamic) return V::Zero();
  }
  return V();
}

template <class E>
bool read_enum(const Value& value, E& out, const Place& at, Reading& reading) {
  const auto* const text = value.get<std::string>();
  std::vector<std::string> legal;
  for (const auto& entry : Names<E>::all) {
    if (text && *text == std::get<0>(entry)) return out = std::get<1>(entry), true;
    legal.push_back(std::get<0>(entry));
  }
  reading.found.add(at, "must be one of " + joined(legal), shown(value));
  return false;
}

template <class T>
bool read_struct(const Value& value, T& out, const Place& at, Reading& reading) {
  const auto* const table = value.get<Value::Table>();
  if (!table) {
    reading.found.add(at, "must be a table", shown(value));
    return false;
  }
  std::vector<std::string> required, legal;
  for_each_key(out, [&](const auto& f, auto& member) {
    const char* const now = reading.exact ? f.name : f.key;
    const Value* const earlier = f.earlier ? value.find(f.earlier) : nullptr;
    if (earlier && value.find(now)) {
      legal.push_back(f.earlier);
      reading.found.add(Place(at, f.earlier), std::string("is the earlier name of ") + now + ", which is there too",
                        shown(*earlier));
    }
    const char* const key = earlier && !value.find(now) ? f.earlier : now;
    legal.push_back(key);
    if (const Value* const entry = value.find(key))
      read_value(*entry, member, f.rules, Place(at, key), reading);
    else if (f.is_required)
      required.push_back(key);
  });
  require_keys(*table, legal, required, at, reading.found);
  return true;
}

template <class V>
bool read_fixed(const Value& value, V& out, const Rules& rules, const Place& at, Reading& reading) {
  const auto* const list = value.get<Value::Array>();
  if (!list) {
    reading.found.add(at, "must be a list", shown(value));
    return false;
  }
  Rules size;
  size.min_entries = size.max_entries = static_cast<std::size_t>(out.size());
  if (!require_entries(list->size(), size, at, reading.found, false)) return false;
  for (std::size_t i = 0; i < list->size(); ++i)
    read_value((*list)[i], out[static_cast<Eigen::Index>(i)], rules, Place(at, i), reading);
  return true;
}

template <class Item>
bool read_list(const Value& value, std::vector<Item>& out, const Rules& rules, const Place& at, Reading& reading) {
  const auto* const list = value.get<Value::Array>();
  if (!list) {
    reading.found.add(at, "must be a list", shown(value));
    return false;
  }
  if (!require_entries(list->size(), rules, at, reading.found, std::is_same_v<Item, Eigen::Vector3d>)) return false;
  out.assign(list->size(), blank<Item>());
  for (std::size_t i = 0; i < list->size(); ++i) read_value((*list)[i], out[i], rules, Place(at, i), reading);
  return true;
}

template <class Item>
bool read_map(const Value& value, std::map<std::string, Item>& out, const Rules& rules, const Place& at,
              Reading& reading) {
  const auto* const table = value.get<Value::Table>();
  if (!table) {
    reading.found.add(at, "must be a table", shown(value));
    return false;
  }
  for (const Entry& entry : *table) {
    const Place place(at, entry.key);
    if (entry.key.empty()) reading.found.add(place, "must not be empty", "''");
    Item item = blank<Item>();
    if (read_value(entry.value, item, rules, place, reading)) out[entry.key] = std::move(item);
  }
  return true;
}

template <class Item>
bool read_pair(const Value& value, std::pair<Item, Item>& out, const Rules& rules, const Place& at, Reading& reading) {
  std::vector<Item> items;
  Rules both = rules;
  both.min_entries = both.max_entries = 2;
  if (!read_list(value, items, both, at, reading)) return false;
  out = {items[0], items[1]};
  return true;
}

template <class V>
bool read_value(const Value& value, V& out, const Rules& rules, const Place& at, Reading& reading) {
  if constexpr (HasNames<V>::value) {
    return read_enum(value, out, at, reading);
  } else if constexpr (HasFields<V>::value || IsInFile<V>::value) {
    return read_struct(value, out, at, reading);
  } else if constexpr (IsNameOr<V>::value) {
    return read_name_or(value, out.name, out.table, at, reading);
  } else if constexpr (IsOptional<V>::value) {
    auto item = blank<typename V::value_type>();
    if (!read_value(value, item, rules, at, reading)) return false;
    out = std::move(item);
    return true;
  } else if constexpr (std::is_same_v<V, std::pair<int, int>>) {
    return read_pair(value, out, rules, at, reading);
  } else if constexpr (std::is_base_of_v<Eigen::MatrixBase<V>, V>) {
    return read_fixed(value, out, rules, at, reading);
  } else if constexpr (IsMap<V>::value) {
    return read_map(value, out, rules, at, reading);
  } else {
    return read_list(value, out, rules, at, reading);
  }
}

// --- the same rules for what is in memory ---

void check_number(double value, const Rules& rules, const Place& at, Findings& found);
void check_range(const Range& value, const Rules& rules, const Place& at, Findings& found);

/// What is out of its range in a member of a struct.
template <class V>
void check_value(const V& value, const Rules& rules, const Place& at, Findings& found) {
  if constexpr (std::is_same_v<V, double> || std::is_same_v<V, int>) {
    check_number(value, rules, at, found);
  } else if constexpr (std::is_same_v<V, Range>) {
    check_range(value, rules, at, found);
  } else if constexpr (std::is_same_v<V, std::string>) {
    if (rules.not_empty && value.empty()) found.add(at, "must not be empty", "''");
  } else if constexpr (HasFields<V>::value) {
    check_struct(value, at, found);
  } else if constexpr (std::is_base_of_v<Eigen::MatrixBase<V>, V>) {
    if constexpr (V::ColsAtCompileTime == 1)
      for (Eigen::Index i = 0; i < value.size(); ++i)
        check_number(value[i], rules, Place(at, static_cast<std::size_t>(i)), found);
  } else if constexpr (IsMap<V>::value) {
    for (const auto& [key, item] : value) check_value(item, rules, Place(at, key), found);
  } else if constexpr (IsList<V>::value) {
    using Item = typename V::value_type;
    if (!require_entries(value.size(), rules, at, found, std::is_same_v<Item, Eigen::Vector3d>)) return;
    for (std::size_t i = 0; i < value.size(); ++i) check_value(value[i], rules, Place(at, i), found);
  }
}

template <class T>
void check_struct(const T& value, const Place& at, Findings& found) {
  [[maybe_unused]] static const T fresh{};
  for_each_field<T>([&](const auto& f) {
    // What need not be given is at a default that means "none": a name, a limit that is infinite.
    if (f.is_required || !equal(value.*f.member, fresh.*f.member))
      check_value(value.*f.member, f.rules, *f.key ? Place(at, f.key) : at, found);
  });
}

/// Throws what is out of its range in a struct. `name`: of the argument or member that it is.
template <class Error, class T>
void require_ranges(const T& value, std::string_view name = "") {
  const Place top;
  Findings found;
  check_struct(value, name.empty() ? top : Place(top, name), found);
  found.raise<Error>();
}

}  // namespace mcplan::model
