#include "signals.hpp"

#include <utility>

namespace mcplan::bindings {
namespace {

thread_local SignalWatch* current = nullptr;

}  // namespace

SignalWatch::SignalWatch() : outer_(std::exchange(current, this)) {}

SignalWatch::~SignalWatch() { current = outer_; }

bool SignalWatch::stop() {
  if (current == nullptr) return false;
  if (!current->asked()) {
    const py::gil_scoped_acquire acquire;
    current->look();
  }
  return current->asked();
}

bool SignalWatch::keep(const py::error_already_set& error) {
  if (current == nullptr) return false;
  if (!current->asked()) current->raised_.emplace(error);
  return true;
}

void SignalWatch::look() {
  if (PyErr_CheckSignals() == 0) return;
  const py::error_already_set error;  // takes it, also where an earlier one is kept
  keep(error);
}

void SignalWatch::raise(py::handle result) {
  const py::error_already_set error = std::move(*raised_);
  raised_.reset();
  if (!error.type().is(py::handle(PyExc_KeyboardInterrupt))) throw error;
  const py::object type = py::module_::import("mcplan.errors").attr("Interrupted");
  const py::object interrupted = type(result);
  PyErr_SetObject(type.ptr(), interrupted.ptr());
  throw py::error_already_set();
}

void SignalWatch::keep_interrupt(const py::error_already_set& error) {
  const py::gil_scoped_acquire acquire;
  if (!error.matches(PyExc_KeyboardInterrupt) || !keep(error)) throw error;
}

}  // namespace mcplan::bindings
