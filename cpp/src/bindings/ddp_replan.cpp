#include <pybind11/stl.h>

#include "ddp/replan/replan_fields.hpp"
#include "fields.hpp"
#include "signals.hpp"

namespace mcplan::bindings {

void bind_ddp_replan(py::module_& m) {
  bind_fields<ddp::VelocityCommand>(m);
  bind_fields<ddp::ReplanOptions>(m).def("validate", &ddp::ReplanOptions::validate,
                                         "Raise InvalidOptions naming all that is out of its range.");
  m.def(
      "replan",
      // By value, as other threads may change them while the GIL is released.
      [](Plan previous, double t, Knot state, std::vector<int> contacts, Scene scene, Robot robot,
         ddp::ReplanOptions options, ddp::Options search, std::optional<ddp::VelocityCommand> command) {
        options.search = watched(search);
        options.command = command;
        return interruptible([&] {
          return ddp::replan(previous, t, {state, std::move(contacts)}, scene, robot, options);
        });
      },
      py::arg("previous"), py::arg("t"), py::arg("state"), py::arg("contacts"), py::arg("scene"), py::arg("robot"),
      py::arg("options"), py::arg("search"), py::arg("command") = py::none(),
      "Plan on from a measured state at time t [s] of an earlier plan; see mcplan.replan. `contacts`: surface index by "
      "end-effector, -1 free; empty: as planned.");
}

}  // namespace mcplan::bindings
