#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "bindings.hpp"
#include "model/fields.hpp"

namespace mcplan::bindings {

template <class T, class = void>
struct HasEquality : std::false_type {};
template <class T>
struct HasEquality<T, std::void_t<decltype(std::declval<const T&>() == std::declval<const T&>())>> : std::true_type {};

/// Whether two members are the same, number by number; two numbers that are none are. Structs without a table of fields
/// compare as in Python.
template <class M>
bool same(const M& a, const M& b) {
  if constexpr (std::is_floating_point_v<M>) {
    return a == b || (std::isnan(a) && std::isnan(b));
  } else if constexpr (model::IsList<M>::value) {
    bool all = a.size() == b.size();
    for (std::size_t i = 0; all && i < a.size(); ++i) all = same(a[i], b[i]);
    return all;
  } else if constexpr (model::IsMap<M>::value) {
    bool all = a.size() == b.size();
    for (auto i = a.begin(), j = b.begin(); all && i != a.end(); ++i, ++j)
      all = i->first == j->first && same(i->second, j->second);
    return all;
  } else if constexpr (model::HasFields<M>::value || HasEquality<M>::value) {
    return model::equal(a, b);
  } else {
    return py::cast(a).equal(py::cast(b));
  }
}

/// Equality and pickles by value of a struct without a table of fields: a tuple of these members, in this order.
template <class T, class... Extra, class... Member>
void def_pickle(py::class_<T, Extra...>& c, Member... members) {
  c.def(
      "__eq__",
      [members...](const T& self, const py::object& other) {
        return py::isinstance<T>(other) && (same(self.*members, other.cast<const T&>().*members) && ...);
      },
      py::arg("other"));
  c.def(py::pickle([members...](const T& self) -> py::tuple { return py::make_tuple(py::cast(self.*members)...); },
                   [members...](const py::tuple& state) {
                     if (state.size() != sizeof...(members))
                       throw py::value_error("the state of another version of mcplan");
                     T out{};
                     std::size_t i = 0;
                     ((out.*members = state[i++].template cast<std::decay_t<decltype(out.*members)>>()), ...);
                     return out;
                   }));
}

}  // namespace mcplan::bindings
