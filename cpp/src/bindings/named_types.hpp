#pragma once

#include <variant>

#include "fields.hpp"
#include "model/fields.hpp"

/// A variant of types without members, whose names stand in model::Names, is an enum in Python: a value for each type,
/// in their order. Files that bind one say so to pybind11:
///
///     template <>
///     struct pybind11::detail::type_caster<ForceLaw> : mcplan::bindings::NamedTypeCaster<ForceLaw> {};
namespace mcplan::bindings {

/// The number of a type within its variant. A class template makes an enum of it for each variant.
template <class V>
struct Number {
  enum class Of : int {};
};

template <class V>
struct NamedTypeCaster {
  using Enum = typename Number<V>::Of;
  PYBIND11_TYPE_CASTER(V, py::detail::make_caster<Enum>::name);

  bool load(py::handle from, bool convert) {
    py::detail::make_caster<Enum> number;
    if (!number.load(from, convert)) return false;
    const auto i = static_cast<std::size_t>(py::detail::cast_op<Enum>(number));
    if (i >= std::variant_size_v<V>) return false;
    value = std::get<1>(model::Names<V>::all[i]);
    return true;
  }

  static py::handle cast(const V& from, py::return_value_policy, py::handle) {
    return py::cast(static_cast<Enum>(from.index())).release();
  }
};

/// The enum of such a variant.
template <class V>
void bind_named_types(py::module_& m) {
  using Table = model::Names<V>;
  using Enum = typename Number<V>::Of;
  py::enum_<Enum> c(m, Table::name, Table::meaning);
  for (const auto& [name, type, meaning] : Table::all) c.value(name, static_cast<Enum>(type.index()), meaning);
  def_enum_repr<Enum>(c, Table::name);
}

}  // namespace mcplan::bindings
