#pragma once

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "fields.hpp"
#include "names.hpp"
#include "value.hpp"

namespace mcplan::model {

/// How a struct is written.
struct Writing {
  NameLists lists;     ///< for fields that are indices into them
  bool exact = false;  ///< all members under their names, indices, and infinite numbers as text: JSON has none
  bool json = false;   ///< infinite numbers as text, too
};

template <class T>
Value written(const T& value, const Writing& writing = {});

/// Whether a member is a matrix, which is written row by row.
template <class V, class = void>
struct IsMatrix : std::false_type {};
template <class V>
struct IsMatrix<V, std::enable_if_t<std::is_base_of_v<Eigen::MatrixBase<V>, V>>>
    : std::bool_constant<V::ColsAtCompileTime != 1> {};

inline Value written_number(double value, const Writing& writing) {
  if ((writing.exact || writing.json) && std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return value;
}

inline Value written_index(int value, const Rules& rules, const Writing& writing) {
  if (!rules.list || writing.exact) return value;
  const auto list = writing.lists.find(rules.list);
  const auto index = static_cast<std::size_t>(value);
  return list != writing.lists.end() && index < list->second.names.size() ? list->second.names[index] : "";
}

/// A member as it stands in a file.
template <class V>
Value written_value(const V& value, const Rules& rules = {}, const Writing& writing = {}) {
  if constexpr (std::is_same_v<V, bool> || std::is_same_v<V, std::string>) {
    return value;
  } else if constexpr (std::is_same_v<V, int>) {
    return written_index(value, rules, writing);
  } else if constexpr (std::is_same_v<V, double>) {
    return written_number(value, writing);
  } else if constexpr (HasNames<V>::value) {
    for (const auto& entry : Names<V>::all)
      if (std::get<1>(entry) == value) return std::get<0>(entry);
    return {};
  } else if constexpr (IsOptional<V>::value) {
    return value ? written_value(*value, rules, writing) : Value();
  } else if constexpr (IsNameOr<V>::value) {
    return value.name.empty() ? value.table : Value(value.name);
  } else if constexpr (HasFields<V>::value || IsInFile<V>::value) {
    return written(value, writing);
  } else if constexpr (std::is_same_v<V, std::pair<int, int>>) {
    return Value::Array{written_value(value.first, rules, writing), written_value(value.second, rules, writing)};
  } else if constexpr (IsMap<V>::value) {
    Value::Table table;
    for (const auto& [key, item] : value) table.push_back({key, written_value(item, rules, writing)});
    return table;
  } else if constexpr (IsMatrix<V>::value) {
    Value::Array rows;
    for (Eigen::Index i = 0; i < value.rows(); ++i)
      rows.push_back(written_value(Eigen::VectorXd(value.row(i).transpose()), rules, writing));
    return rows;
  } else {
    Value::Array list;
    list.reserve(static_cast<std::size_t>(value.size()));
    for (const auto& item : value) list.push_back(written_value(item, rules, writing));
    return list;
  }
}

/// A struct with the keys of a file; what is at its default is left out. Lists of tables and tables by name come last,
/// where TOML has them.
template <class T>
Value written(const T& value, const Writing& writing) {
  [[maybe_unused]] static const T fresh{};
  Value first{Value::Table()}, last{Value::Table()};
  const auto put = [&](const auto& f, const auto& member, const auto& fresh_member) {
    using M = typename std::decay_t<decltype(f)>::Member;
    Value& out = !writing.exact && (IsStructs<M>::value || IsMap<M>::value) ? last : first;
    if (writing.exact || f.is_required || f.is_always || !equal(member, fresh_member))
      out.set(writing.exact ? f.name : f.key, written_value(member, f.rules, writing));
  };
  for_each_key(value, fresh, put);
  for (Entry& entry : *last.get<Value::Table>()) first.set(std::move(entry.key), std::move(entry.value));
  return first;
}

}  // namespace mcplan::model
