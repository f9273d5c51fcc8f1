#pragma once

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "mcplan/base/error.hpp"

namespace mcplan::bindings {

namespace py = pybind11;

void bind_base(py::module_& m);
void bind_scene(py::module_& m);
void bind_robot(py::module_& m);
void bind_plan(py::module_& m);
void bind_ddp(py::module_& m);
void bind_nlp(py::module_& m);
void bind_rhp(py::module_& m);
void bind_sip(py::module_& m);
void bind_sip_planner(py::module_& m);  // of the sip submodule
void bind_planar(py::module_& m);
void bind_whole_body(py::module_& m);

/// Runs a solve without the GIL.
template <class Solve>
auto without_gil(Solve&& solve) {
  const py::gil_scoped_release release;
  return solve();
}

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

/// Keeps what a member held until `owner` dies: Python may still hold references into it.
template <class Value>
void retire(py::handle owner, Value& member) {
  py::capsule keeper(new Value(std::move(member)), [](void* kept) { delete static_cast<Value*>(kept); });
  py::detail::keep_alive_impl(owner, keeper);
}

/// Member that holds N points: reads as a writable N x 3 view.
template <class T, class... Extra>
void def_points(py::class_<T, Extra...>& c, const char* name, std::vector<Eigen::Vector3d> T::*member,
                const char* doc) {
  c.def_property(
      name, [member](py::object self) { return points_view(self.cast<T&>().*member, self); },
      [member, name](py::object self, const py::object& value) {
        auto points = points_from(value, name);
        auto& target = self.cast<T&>().*member;
        retire(self, target);
        target = std::move(points);
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
        py::tuple out(items.size());
        for (std::size_t i = 0; i < items.size(); ++i)
          out[i] = py::cast(&items[i], py::return_value_policy::reference_internal, self);
        return out;
      },
      [member](py::object self, std::vector<Element> value) {
        auto& target = self.cast<T&>().*member;
        retire(self, target);
        target = std::move(value);
      },
      doc);
}

/// Member vector of fixed size: reads as a writable view.
template <class T, class Vector, class... Extra>
void def_vector(py::class_<T, Extra...>& c, const char* name, Vector T::*member, const char* doc) {
  c.def_property(
      name, [member](T& self) -> Vector& { return self.*member; },
      [member](T& self, const Vector& value) { self.*member = value; }, doc);
}

/// Member that is a closed range {min, max}: reads and writes as a pair.
template <class T, class Range, class... Extra>
void def_range(py::class_<T, Extra...>& c, const char* name, Range T::*member, const char* doc) {
  c.def_property(
      name, [member](const T& self) { return std::make_pair((self.*member).min, (self.*member).max); },
      [member](T& self, const std::pair<double, double>& value) {
        self.*member = {value.first, value.second};
      },
      doc);
}

/// Member struct: reads as a reference.
template <class T, class Member, class... Extra>
void def_member(py::class_<T, Extra...>& c, const char* name, Member T::*member, const char* doc) {
  c.def_property(
      name, [member](T& self) -> Member& { return self.*member; },
      [member](py::object self, const Member& value) {
        Member copy = value;  // `value` may be the member itself
        auto& target = self.cast<T&>().*member;
        retire(self, target);
        target = std::move(copy);
      },
      doc);
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

/// pickle through a pair of Python functions that turn the object into plain data and back.
template <class T, class... Extra>
void def_pickle(py::class_<T, Extra...>& c, const char* module, const char* to_plain, const char* from_plain) {
  c.def("__reduce__", [module, to_plain, from_plain](py::object self) -> py::tuple {
    const py::module_ files = py::module_::import(module);
    return py::make_tuple(files.attr(from_plain), py::make_tuple(files.attr(to_plain)(self)));
  });
}

}  // namespace mcplan::bindings
