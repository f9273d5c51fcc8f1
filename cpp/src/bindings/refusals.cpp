#include <map>
#include <utility>

#include "bindings.hpp"

/// Where arguments fit no signature pybind11 lists all signatures and the repr of all that was given. Here its
/// functions are called by way of one that makes of this a line, naming the argument: mcplan.refusals knows how. One
/// place serves constructors, members that are assigned, methods and functions.
namespace mcplan::bindings {
namespace {

/// The members that functions assign, by the object that pybind11 gives its function. Never destroyed: Python may call
/// while it ends.
std::map<PyObject*, std::string>& assigned() {
  static auto* const all = new std::map<PyObject*, std::string>();
  return *all;
}

/// What pybind11 has every function do.
PyCFunction dispatcher = nullptr;

py::object in_refusals(const char* name) { return py::module_::import("mcplan.refusals").attr(name); }

void raise(const py::object& error) { PyErr_SetObject(py::type::handle_of(error).ptr(), error.ptr()); }

/// Replaces the error that is set by a line, where it is one of pybind11 about arguments; `arguments` makes a tuple and
/// a dict of them.
template <class Arguments>
void refuse(PyObject* record, const Arguments& arguments) {
  if (!PyErr_ExceptionMatches(PyExc_TypeError)) return;
  py::error_already_set before;
  const auto place = assigned().find(record);
  try {
    const auto [given, named] = arguments();
    const py::object error =
        in_refusals("refusal")(py::str(before.value()), given, named, place == assigned().end() ? "" : place->second);
    if (!error.is_none()) return raise(error);
  } catch (py::error_already_set& failed) {
    failed.discard_as_unraisable("mcplan.refusals");
  }
  before.restore();
}

/// Whether the enum that was made has such a value; an error is set if not.
bool is_member(py::handle made) {
  try {
    const py::object error = in_refusals("no_member")(made);
    if (error.is_none()) return true;
    raise(error);
  } catch (py::error_already_set& failed) {
    failed.restore();
  }
  return false;
}

/// `makes_enum`: the value of an enum, of which pybind11 takes any number; the first argument is what was made.
template <bool makes_enum>
PyObject* call_fast(PyObject* record, PyObject* const* values, Py_ssize_t count, PyObject* keys) {
  using Fast = PyObject* (*)(PyObject*, PyObject* const*, Py_ssize_t, PyObject*);
  PyObject* const out = reinterpret_cast<Fast>(reinterpret_cast<void (*)()>(dispatcher))(record, values, count, keys);
  if (out && (!makes_enum || is_member(values[0]))) return out;
  Py_XDECREF(out);
  refuse(record, [&] {
    py::tuple given(count);
    for (Py_ssize_t i = 0; i < count; ++i) given[i] = py::handle(values[i]);
    py::dict named;
    for (Py_ssize_t i = 0; keys && i < PyTuple_GET_SIZE(keys); ++i)
      named[py::handle(PyTuple_GET_ITEM(keys, i))] = py::handle(values[count + i]);
    return std::pair(given, named);
  });
  return nullptr;
}

/// The same for versions of pybind11 before 3.1.
template <bool makes_enum>
PyObject* call(PyObject* record, PyObject* values, PyObject* keys) {
  PyObject* const out =
      reinterpret_cast<PyCFunctionWithKeywords>(reinterpret_cast<void (*)()>(dispatcher))(record, values, keys);
  if (out && (!makes_enum || is_member(PyTuple_GET_ITEM(values, 0)))) return out;
  Py_XDECREF(out);
  refuse(record, [&] {
    return std::pair(py::reinterpret_borrow<py::tuple>(values),
                     keys ? py::reinterpret_borrow<py::dict>(keys) : py::dict());
  });
  return nullptr;
}

/// The function behind a method.
py::handle plain(py::handle function) {
  return PyInstanceMethod_Check(function.ptr()) ? PyInstanceMethod_GET_FUNCTION(function.ptr()) : function.ptr();
}

PyMethodDef* definition(py::handle function) {
  return PyCFunction_Check(function.ptr()) ? reinterpret_cast<PyCFunctionObject*>(function.ptr())->m_ml : nullptr;
}

template <class Call>
PyCFunction method(Call* call) {
  return reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(call));
}

/// `member`: that the function assigns, "": none.
void redirect(py::handle callable, const std::string& member = "", bool makes_enum = false) {
  const py::handle function = plain(callable);
  PyMethodDef* const own = definition(function);
  if (!own || own->ml_meth != dispatcher) return;
  if ((own->ml_flags & METH_FASTCALL) != 0)
    own->ml_meth = makes_enum ? method(&call_fast<true>) : method(&call_fast<false>);
  else
    own->ml_meth = makes_enum ? method(&call<true>) : method(&call<false>);
  if (!member.empty()) assigned()[PyCFunction_GET_SELF(function.ptr())] = member;
}

void redirect_members(py::handle type) {
  const bool is_enum = py::hasattr(type, "__members__");
  for (py::handle item : py::dict(type.attr("__dict__")).attr("items")()) {
    const auto [key, value] = item.cast<std::pair<std::string, py::object>>();
    const bool is_static = py::hasattr(value, "__func__");
    redirect(is_static ? value.attr("__func__") : value, "", is_enum && (key == "__init__" || key == "__setstate__"));
    if (!py::hasattr(value, "fset")) continue;
    redirect(value.attr("fget"));
    redirect(value.attr("fset"), key);
  }
}

void redirect_all(py::handle module) {
  const std::string within = std::string(py::str(module.attr("__name__"))) + ".";
  for (py::handle member : module.attr("__dict__").attr("values")()) {
    if (PyModule_Check(member.ptr()) && std::string(py::str(member.attr("__name__"))).rfind(within, 0) == 0)
      redirect_all(member);
    else if (PyType_Check(member.ptr()))
      redirect_members(member);
    else
      redirect(member);
  }
}

}  // namespace

void refuse_in_a_line(py::handle module) {
  dispatcher = definition(py::cpp_function([] {}))->ml_meth;
  redirect_all(module);
}

}  // namespace mcplan::bindings
