#pragma once

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "model/fields.hpp"

namespace mcplan::bindings {

/// What the constructor takes for a member: points come as arrays or as lists.
template <class M>
using Argument = std::conditional_t<std::is_same_v<M, std::vector<Eigen::Vector3d>>, py::object, M>;

template <class M>
M from_argument(Argument<M> value, const char* name) {
  if constexpr (std::is_same_v<M, std::vector<Eigen::Vector3d>>)
    return points_from(value, name);
  else
    return value;
}

template <class M>
auto default_argument(const M& value) {
  if constexpr (std::is_same_v<M, std::vector<Eigen::Vector3d>>)
    return py::tuple();
  else
    return value;
}

/// Whether a member is a matrix of any size, which lies on the heap.
template <class M>
constexpr bool is_sizable() {
  if constexpr (std::is_base_of_v<Eigen::MatrixBase<M>, M>) return M::SizeAtCompileTime == Eigen::Dynamic;
  return false;
}

template <class M>
struct HasSizables : std::false_type {};
template <class M>
struct HasSizables<std::vector<M>> : std::bool_constant<is_sizable<M>()> {};
/// A member as pickles have it; who listens stays behind.
template <class M>
py::object pickled(const M& value) {
  if constexpr (model::IsCallback<M>::value)
    return py::none();
  else
    return py::cast(value);
}

template <class M>
struct IsNested : std::false_type {};
template <class M>
struct IsNested<std::vector<std::vector<M>>> : std::true_type {};

template <class T, class F>
void def_field(py::class_<T>& c, const F& f) {
  using M = typename F::Member;
  const std::string doc = std::string(*f.unit ? "[" + std::string(f.unit) + "] " : "") + f.meaning;
  if constexpr (std::is_same_v<M, std::vector<Eigen::Vector3d>>)
    def_points(c, f.name, f.member, ("N x 3 " + doc).c_str());
  else if constexpr (model::IsStructs<M>::value || HasSizables<M>::value)
    def_items(c, f.name, f.member, ("Tuple: " + doc).c_str());
  else if constexpr (model::HasFields<M>::value)
    def_member(c, f.name, f.member, doc.c_str());
  else if constexpr (is_sizable<M>())
    def_matrix(c, f.name, f.member, doc.c_str());
  else if constexpr (std::is_base_of_v<Eigen::MatrixBase<M>, M>)
    def_vector(c, f.name, f.member, doc.c_str());
  else if constexpr (std::is_arithmetic_v<M> || model::HasNames<M>::value || std::is_same_v<M, std::string> ||
                     std::is_same_v<M, Range> || IsNested<M>::value || model::IsCallback<M>::value)
    c.def_readwrite(f.name, f.member, doc.c_str());
  else
    def_names(c, f.name, f.member, doc.c_str());
}

/// Constructor by keywords, whose defaults are those of the struct.
template <class T, std::size_t... I>
void def_keywords(py::class_<T>& c, std::index_sequence<I...>) {
  constexpr auto& all = model::Fields<T>::all;
  const T fresh{};
  using All = std::decay_t<decltype(all)>;
  c.def(py::init([](Argument<typename std::tuple_element_t<I, All>::Member>... values) {
          constexpr auto& all = model::Fields<T>::all;
          T out{};
          ((out.*std::get<I>(all).member =
                from_argument<typename std::tuple_element_t<I, All>::Member>(std::move(values), std::get<I>(all).name)),
           ...);
          return out;
        }),
        py::kw_only(), (py::arg(std::get<I>(all).name) = default_argument(fresh.*std::get<I>(all).member))...);
}

/// Equality by value, and pickles by value: a tuple of the members.
template <class T, std::size_t... I>
void def_state(py::class_<T>& c, std::index_sequence<I...>) {
  using All = std::decay_t<decltype(model::Fields<T>::all)>;
  c.def(
      "__eq__",
      [](const T& self, const py::object& other) {
        return py::isinstance<T>(other) && model::equal(self, other.cast<const T&>());
      },
      py::arg("other"));
  c.def(py::pickle(
      [](const T& self) -> py::tuple {
        return py::make_tuple(pickled(self.*std::get<I>(model::Fields<T>::all).member)...);
      },
      [](const py::tuple& state) {
        if (state.size() != sizeof...(I)) throw py::value_error("the state of another version of mcplan");
        T out{};
        ((out.*std::get<I>(model::Fields<T>::all).member =
              state[I].template cast<typename std::tuple_element_t<I, All>::Member>()),
         ...);
        return out;
      }));
}

/// A repr that can be pasted.
template <class E>
void def_enum_repr(py::enum_<E>& c, const char* name) {
  c.def(
      "__repr__",
      [name](E value) { return std::string(name) + "." + std::string(py::str(py::cast(value).attr("name"))); },
      py::prepend());
}

/// Class of an enum as its table says, whose repr can be pasted.
template <class E>
void bind_enum(py::module_& m) {
  using Table = model::Names<E>;
  py::enum_<E> c(m, Table::name, Table::meaning);
  for (const auto& [name, value, meaning] : Table::all) c.value(name, value, meaning);
  def_enum_repr(c, Table::name);
}

/// Class of a struct as its table says: constructor by keywords, members, repr that can be pasted, equality, copies,
/// pickles.
template <class T>
py::class_<T> bind_fields(py::module_& m) {
  using Table = model::Fields<T>;
  py::class_<T> c(m, Table::name, Table::meaning);
  constexpr auto count = std::make_index_sequence<std::tuple_size_v<std::decay_t<decltype(Table::all)>>>();
  def_keywords(c, count);
  model::for_each_field<T>([&](const auto& f) { def_field(c, f); });
  std::vector<std::string> names;  // of what repr shows: a function could not be pasted
  model::for_each_field<T>([&](const auto& f) {
    if (!model::IsCallback<typename std::decay_t<decltype(f)>::Member>::value) names.push_back(f.name);
  });
  def_value(c, Table::name, names);
  def_state(c, count);
  return c;
}

}  // namespace mcplan::bindings
