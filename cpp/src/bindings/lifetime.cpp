#include <map>
#include <thread>

#include "bindings.hpp"

namespace mcplan::bindings {
namespace {

/// What Python's references into one member hold.
struct Lease {
  const void* member;
  py::object owner;
  py::handle capsule;          ///< that Python sees, and whose end is the lease's
  std::shared_ptr<void> kept;  ///< what the member held, once it has been replaced
};

/// The leases that are alive, by the place of their member. Read and written under the GIL; never destroyed, since
/// Python may drop references after static objects are gone.
std::map<const void*, Lease*>& leases() {
  static auto* const all = new std::map<const void*, Lease*>();
  return *all;
}

void forget(void* pointer) {
  auto* const ended = static_cast<Lease*>(pointer);
  const auto found = leases().find(ended->member);
  if (found != leases().end() && found->second == ended) leases().erase(found);
  delete ended;
}

/// Planners that are at work, and the thread they work for. Read and written under the GIL.
std::map<const void*, std::thread::id>& at_work() {
  static auto* const all = new std::map<const void*, std::thread::id>();
  return *all;
}

/// Called where an object without a C++ value is used, which pybind11 would else fill with memory as it comes.
void* refuse(std::size_t) { throw py::type_error("the object was never initialised: its __init__ was not called"); }

}  // namespace

py::object lease(const void* member, py::handle owner) {
  const auto found = leases().find(member);
  if (found != leases().end()) return py::reinterpret_borrow<py::object>(found->second->capsule);
  auto* const fresh = new Lease{member, py::reinterpret_borrow<py::object>(owner), {}, nullptr};
  const py::capsule capsule(fresh, &forget);
  fresh->capsule = capsule;
  leases()[member] = fresh;
  return capsule;
}

void hand_over(const void* begin, std::size_t size, const std::function<std::shared_ptr<void>()>& make_keeper) {
  const auto first = leases().lower_bound(begin), last = leases().lower_bound(static_cast<const char*>(begin) + size);
  if (first == last) return;
  const std::shared_ptr<void> keeper = make_keeper();
  for (auto it = first; it != last; ++it) it->second->kept = keeper;
  leases().erase(first, last);
}

Alone::Alone(const void* planner, const std::string& call) : planner_(planner) {
  require_idle(planner, call, false);
  at_work()[planner] = std::this_thread::get_id();
}

Alone::~Alone() { at_work().erase(planner_); }

void require_idle(const void* planner, const std::string& call, bool own_thread_may) {
  const auto found = at_work().find(planner);
  if (found == at_work().end()) return;
  const bool same = found->second == std::this_thread::get_id();
  if (same && own_thread_may) return;
  throw InvalidInput(call, "must not be called while the same planner is at work (each thread needs its own)",
                     same ? "a call from its own callback" : "a call from another thread");
}

void refuse_uninitialised(py::handle module) {
  for (py::handle member : module.attr("__dict__").attr("values")()) {
    if (PyModule_Check(member.ptr())) {
      // Submodules alone: what they import is somebody else's.
      const std::string name = py::str(member.attr("__name__"));
      if (name.rfind(std::string(py::str(module.attr("__name__"))) + ".", 0) == 0) refuse_uninitialised(member);
    } else if (PyType_Check(member.ptr())) {
      auto* const type = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(member.ptr()));
      if (type) type->operator_new = &refuse;
    }
  }
}

}  // namespace mcplan::bindings
