#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "fields.hpp"
#include "value.hpp"
#include "write.hpp"

namespace mcplan::model {

/// JSON schema of a number, a text or a list under these rules.
Value number_schema(const Rules& rules);
Value whole_schema(const Rules& rules);
Value text_schema(const Rules& rules);
Value list_schema(Value items, std::size_t min_entries, std::size_t max_entries);

/// Of a name that something must have.
Rules named_rules();

/// What stands in files for a struct, where that is more than its members.
template <class T>
struct InFiles {
  using Type = T;
};

template <class T>
Value struct_schema(Value::Table& definitions);

/// JSON schema of a member; those of structs go to the definitions.
template <class V>
Value value_schema(const Rules& rules, Value::Table& definitions) {
  Value out;
  if constexpr (std::is_same_v<V, bool>) {
    out.set("type", "boolean");
  } else if constexpr (std::is_same_v<V, int>) {
    out = rules.list ? text_schema(named_rules()) : whole_schema(rules);
  } else if constexpr (std::is_same_v<V, double>) {
    out = number_schema(rules);
  } else if constexpr (std::is_same_v<V, std::string>) {
    out = text_schema(rules);
  } else if constexpr (HasNames<V>::value) {
    Value::Array names;
    for (const auto& entry : Names<V>::all) names.push_back(std::get<0>(entry));
    out.set("enum", std::move(names));
  } else if constexpr (IsOptional<V>::value) {
    out = value_schema<typename V::value_type>(rules, definitions);
  } else if constexpr (IsNameOr<V>::value) {
    out.set("anyOf", Value::Array{text_schema(named_rules()), struct_schema<typename IsNameOr<V>::Type>(definitions)});
  } else if constexpr (HasFields<V>::value || IsInFile<V>::value) {
    out = struct_schema<typename InFiles<V>::Type>(definitions);
  } else if constexpr (std::is_same_v<V, std::pair<int, int>>) {
    out = list_schema(value_schema<int>(rules, definitions), 2, 2);
  } else if constexpr (IsMap<V>::value) {
    out.set("type", "object");
    Value names;
    names.set("minLength", 1);
    out.set("propertyNames", std::move(names));
    out.set("additionalProperties", value_schema<typename V::mapped_type>(rules, definitions));
  } else if constexpr (std::is_base_of_v<Eigen::MatrixBase<V>, V>) {
    constexpr int columns = V::ColsAtCompileTime, rows = V::RowsAtCompileTime;
    out = number_schema(rules);
    if (columns != 1)
      out = list_schema(std::move(out), static_cast<std::size_t>(columns), static_cast<std::size_t>(columns));
    const std::size_t size = static_cast<std::size_t>(rows);
    out = rows > 0 ? list_schema(std::move(out), size, size)
                   : list_schema(std::move(out), rules.min_entries, rules.max_entries);
  } else {
    out = list_schema(value_schema<typename V::value_type>(rules, definitions), rules.min_entries, rules.max_entries);
  }
  return out;
}

/// A reference to the definition of a struct, which is made where there is none yet.
template <class T>
Value struct_schema(Value::Table& definitions) {
  static const T fresh{};
  bool there = false;
  for (const Entry& entry : definitions) there = there || entry.key == Fields<T>::name;
  if (!there) {
    definitions.push_back({Fields<T>::name, {}});
    Value properties{Value::Table()}, out;
    Value::Array required;
    for_each_key(fresh, [&](const auto& f, const auto& member) {
      using M = typename std::decay_t<decltype(f)>::Member;
      Value entry = value_schema<M>(f.rules, definitions);
      const std::string unit = *f.unit ? "[" + std::string(f.unit) + "] " : "";
      entry.set("description", unit + f.meaning);
      if (f.is_required) {
        required.push_back(f.key);
      } else if constexpr (!HasFields<M>::value && !IsOptional<M>::value && !IsNameOr<M>::value) {
        if (!f.rules.not_empty || !equal(member, M())) entry.set("default", written_value(member));
      }
      if (f.earlier) {
        Value earlier = value_schema<M>(f.rules, definitions);
        earlier.set("description", std::string("Earlier name of ") + f.key + ".");
        earlier.set("deprecated", true);
        properties.set(f.earlier, std::move(earlier));
      }
      properties.set(f.key, std::move(entry));
    });
    out.set("type", "object");
    out.set("description", Fields<T>::meaning);
    out.set("properties", std::move(properties));
    out.set("required", std::move(required));
    out.set("additionalProperties", false);
    for (Entry& entry : definitions)
      if (entry.key == Fields<T>::name) entry.value = std::move(out);
  }
  Value reference;
  reference.set("$ref", "#/$defs/" + std::string(Fields<T>::name));
  return reference;
}

/// The JSON schema of a file that holds one struct.
template <class T>
Value schema() {
  Value::Table definitions;
  Value out;
  out.set("$schema", "https://json-schema.org/draft/2020-12/schema");
  out.set("title", Fields<T>::name);
  const Value reference = struct_schema<T>(definitions);
  out.set("$ref", *reference.find("$ref"));
  out.set("$defs", std::move(definitions));
  return out;
}

}  // namespace mcplan::model
