#pragma once

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "mcplan/base/error.hpp"
#include "mcplan/base/range.hpp"

/// A closed range is a pair in Python.
template <>
struct pybind11::detail::type_caster<mcplan::Range> {
  PYBIND11_TYPE_CASTER(mcplan::Range, const_name("tuple[float, float]"));

  bool load(handle from, bool convert) {
    make_caster<std::pair<double, double>> pair;
    if (!pair.load(from, convert)) return false;
    std::tie(value.min, value.max) = cast_op<std::pair<double, double>>(std::move(pair));
    return true;
  }
  static handle cast(const mcplan::Range& from, return_value_policy, handle) {
    return make_tuple(from.min, from.max).release();
  }
};

namespace mcplan::bindings {

namespace py = pybind11;

void bind_base(py::module_& m);
void bind_model(py::module_& m);
void bind_scene(py::module_& m);
void bind_robot(py::module_& m);
void bind_plan(py::module_& m);
void bind_plan_samples(py::module_& m);
void bind_ddp(py::module_& m);
void bind_ddp_replan(py::module_& m);
void bind_nlp(py::module_& m);
void bind_ipm(py::module_& m);
void bind_rhp(py::module_& m);
void bind_wb(py::module_& m);
void bind_online(py::module_& m);
void bind_sip(py::module_& m);
void bind_sip_planner(py::module_& m);  // of the sip submodule
void bind_planar(py::module_& m);
void bind_planar_plan(py::module_& m);
void bind_planar_files(py::module_& m);

/// Runs a solve without the GIL. Another thread may change meanwhile what was given by reference: give copies.
template <class Solve>
auto without_gil(Solve&& solve) {
  const py::gil_scoped_release release;
  return solve();
}

/// One call of a planner at a time, for those that change while they work: InvalidInput naming `call` when the planner
/// is at work already, for another thread or for the one whose callback asks. Made and destroyed under the GIL.
class Alone {
 public:
  Alone(const void* planner, const std::string& call);
  ~Alone();
  Alone(const Alone&) = delete;
  Alone& operator=(const Alone&) = delete;

 private:
  const void* planner_;
};

/// Throws as Alone does; `own_thread_may`: a callback of the planner may look at it.
void require_idle(const void* planner, const std::string& call, bool own_thread_may);

/// Makes use of an object whose __init__ never ran a TypeError, for all classes of a module and its submodules.
void refuse_uninitialised(py::handle module);

/// Makes arguments that fit no signature, and numbers that an enum does not have, a typed error of one line, for all
/// functions and classes of a module and its submodules.
void refuse_in_a_line(py::handle module);

/// Text that Python reads back as the same value: arrays as nested lists, infinity as float('inf').
std::string paste(py::handle value);

/// The text with control characters but line ends written out: names from files are shown on a terminal, not obeyed.
std::string shown(const std::string& text);

/// "Name(a=..., b=...)" from the attributes listed.
std::string paste(py::handle self, const std::string& name, const std::vector<std::string>& attributes);

/// Rows of an N x 3 array (or of nested lists); InvalidInput naming `field` for any other shape.
std::vector<Eigen::Vector3d> points_from(py::handle value, const std::string& field);

/// Numbers of a 1-D array (or of a list); InvalidInput naming `field` for any other shape.
Eigen::VectorXd vector_from(py::handle value, const std::string& field);

/// Writable N x 3 view of `points`, which `owner` keeps alive.
py::array points_view(std::vector<Eigen::Vector3d>& points, py::handle owner);

/// What Python holds while it refers into what a member keeps on the heap: alive as long as any such reference, it
/// keeps the member's owner alive, and takes over what the member held when that is replaced. `member`: the vector, at
/// its place in `owner`.
py::object lease(const void* member, py::handle owner);

/// Takes what leases of members in [begin, begin + size) refer to over into `keep`, made by `make_keeper` if there are
/// any. Without a reference nothing is kept: what is replaced goes at once.
void hand_over(const void* begin, std::size_t size, const std::function<std::shared_ptr<void>()>& make_keeper);

/// Replaces a member. References that Python holds into what it held stay valid: they see the old values from then on.
template <class Value>
void replace(Value& member, Value value) {
  hand_over(&member, sizeof(Value), [&member] { return std::make_shared<Value>(std::move(member)); });
  member = std::move(value);
}

/// Member that holds N points: reads as a writable N x 3 view.
template <class T, class... Extra>
void def_points(py::class_<T, Extra...>& c, const char* name, std::vector<Eigen::Vector3d> T::*member,
                const char* doc) {
  c.def_property(
      name,
      [member](py::object self) {
        auto& points = self.cast<T&>().*member;
        return points_view(points, lease(&points, self));
      },
      [member, name](py::object self, const py::object& value) {
        replace(self.cast<T&>().*member, points_from(value, name));
      },
      doc);
}

/// Member that holds several structs: reads as a tuple of references, so that elements can be changed in place, and
/// appending to it fails instead of changing a copy. Assign a list to change how many there are.
template <class T, class Element, class... Extra>
void def_items(py::class_<T, Extra...>& c, const char* name, std::vector<Element> T::*member, const char* doc) {
  c.def_property(
      name,
      [member](py::object self) {
        auto& items = self.cast<T&>().*member;
        const py::object keeper = lease(&items, self);
        py::tuple out(items.size());
        for (std::size_t i = 0; i < items.size(); ++i)
          out[i] = py::cast(&items[i], py::return_value_policy::reference_internal, keeper);
        return out;
      },
      [member](py::object self, std::vector<Element> value) { replace(self.cast<T&>().*member, std::move(value)); },
      doc);
}

/// Member vector of fixed size: reads as a writable view.
template <class T, class Vector, class... Extra>
void def_vector(py::class_<T, Extra...>& c, const char* name, Vector T::*member, const char* doc) {
  c.def_property(
      name, [member](T& self) -> Vector& { return self.*member; },
      [member](T& self, const Vector& value) { self.*member = value; }, doc);
}

/// Member struct: reads as a reference, which shows what is assigned later.
template <class T, class Member, class... Extra>
void def_member(py::class_<T, Extra...>& c, const char* name, Member T::*member, const char* doc) {
  c.def_property(
      name, [member](T& self) -> Member& { return self.*member; },
      [member](T& self, const Member& value) {
        Member copy = value;  // `value` may be the member itself, or lie in it
        replace(self.*member, std::move(copy));
      },
      doc);
}

/// Member vector or matrix of any size: reads as a writable view.
template <class T, class Matrix, class... Extra>
void def_matrix(py::class_<T, Extra...>& c, const char* name, Matrix T::*member, const char* doc) {
  c.def_property(
      name,
      [member](py::object self) {
        Matrix& matrix = self.cast<T&>().*member;
        return py::cast(&matrix, py::return_value_policy::reference_internal, lease(&matrix, self));
      },
      [member](T& self, Matrix value) { replace(self.*member, std::move(value)); }, doc);
}

/// Member that holds plain values (names, indices, pairs): reads as a tuple or a read-only mapping.
template <class T, class Value, class... Extra>
void def_names(py::class_<T, Extra...>& c, const char* name, Value T::*member, const char* doc) {
  c.def_property(
      name,
      [member](const T& self) -> py::object {
        py::object value = py::cast(self.*member);
        if (py::isinstance<py::dict>(value)) return py::module_::import("types").attr("MappingProxyType")(value);
        return py::tuple(value);
      },
      [member](T& self, Value value) { self.*member = std::move(value); }, doc);
}

/// repr() from attributes, and copy.copy / copy.deepcopy by value.
template <class T, class... Extra>
void def_value(py::class_<T, Extra...>& c, const std::string& name, const std::vector<std::string>& attributes) {
  c.def("__repr__", [name, attributes](py::handle self) { return paste(self, name, attributes); });
  c.def("__copy__", [](const T& self) { return T(self); });
  c.def(
      "__deepcopy__", [](const T& self, const py::dict&) { return T(self); }, py::arg("memo"));
}

}  // namespace mcplan::bindings
