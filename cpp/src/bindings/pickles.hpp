#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "bindings.hpp"

namespace mcplan::bindings {

/// Pickles by value of a struct without a table of fields: a tuple of these members, in this order.
template <class T, class... Extra, class... Member>
void def_pickle(py::class_<T, Extra...>& c, Member... members) {
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
