#pragma once

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "fields.hpp"
#include "value.hpp"

namespace mcplan::model {

template <class T>
Value written(const T& value);

/// Whether a member is a matrix, which is written row by row.
template <class V, class = void>
struct IsMatrix : std::false_type {};
template <class V>
struct IsMatrix<V, std::enable_if_t<std::is_base_of_v<Eigen::MatrixBase<V>, V>>>
    : std::bool_constant<V::ColsAtCompileTime != 1> {};

/// A member as it stands in a file.
template <class V>
Value written_value(const V& value) {
  if constexpr (std::is_same_v<V, bool> || std::is_same_v<V, int> || std::is_same_v<V, double> ||
                std::is_same_v<V, std::string>) {
    return value;
  } else if constexpr (std::is_enum_v<V>) {
    for (const auto& entry : Names<V>::all)
      if (std::get<1>(entry) == value) return std::get<0>(entry);
    return {};
  } else if constexpr (HasFields<V>::value) {
    return written(value);
  } else if constexpr (IsMap<V>::value) {
    Value::Table table;
    for (const auto& [key, item] : value) table.push_back({key, written_value(item)});
    return table;
  } else if constexpr (IsMatrix<V>::value) {
    Value::Array rows;
    for (Eigen::Index i = 0; i < value.rows(); ++i)
      rows.push_back(written_value(Eigen::VectorXd(value.row(i).transpose())));
    return rows;
  } else {
    Value::Array list;
    list.reserve(static_cast<std::size_t>(value.size()));
    for (const auto& item : value) list.push_back(written_value(item));
    return list;
  }
}

/// A struct with the keys of a file; what is at its default is left out. Lists of tables and tables by name come last,
/// where TOML has them.
template <class T>
Value written(const T& value) {
  [[maybe_unused]] static const T fresh{};
  Value out{Value::Table()};
  for (const bool last : {false, true})
    for_each_field<T>([&](const auto& f) {
      using M = typename std::decay_t<decltype(f)>::Member;
      if (last != (IsStructs<M>::value || IsMap<M>::value)) return;
      if (f.is_required || f.is_always || !equal(value.*f.member, fresh.*f.member))
        out.set(f.key, written_value(value.*f.member));
    });
  return out;
}

}  // namespace mcplan::model
