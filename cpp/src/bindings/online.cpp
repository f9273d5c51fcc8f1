#include "fields.hpp"
#include "mcplan/online/following.hpp"
#include "mcplan/online/planned_height.hpp"
#include "mcplan/online/planned_turn.hpp"
#include "online/felt_push_fields.hpp"

namespace mcplan::bindings {

void bind_online(py::module_& parent) {
  py::module_ m = parent.def_submodule("online", "Planning while the robot walks: what to do with a replan's plan.");
  m.attr("HEIGHT_MARGIN_M") = online::kHeightMargin_m;
  m.attr("TURN_MARGIN_RAD_S") = online::kTurnMargin_rad_s;
  m.def("follows", &online::follows, py::arg("report"), py::arg("period_s"),
        "Whether it is better to follow the plan of a replan than to stay with the plan under way: it was made from "
        "the measured state, and it is solved, acceptable, or keeps all limits for twice the time [s] between two "
        "replans.");
  m.def(
      "with_feet_kept_up",
      [](Plan plan) { return without_gil([&] { return online::with_feet_kept_up(std::move(plan)); }); },
      py::arg("plan"),
      "The plan with the ways of feet that are in the air at its start kept from the ground, and raised over their "
      "splines by 0.5 m/s at most. Raises InvalidPlan.");
  m.def("with_planned_height", &online::with_planned_height, py::arg("measured"), py::arg("plan"), py::arg("t"),
        py::arg("margin_m") = online::kHeightMargin_m,
        "The state from which to plan on at time t [s] in the plan under way: the measured one, but with height and "
        "vertical velocity of the CoM as planned where they are off by less than a margin [m].");
  m.def(
      "with_planned_turn", &online::with_planned_turn, py::arg("measured"), py::arg("plan"), py::arg("t"),
      py::arg("margin_rad_s") = online::kTurnMargin_rad_s,
      "The state from which to plan on at time t [s] in the plan under way: the measured one, but what the base turns "
      "otherwise than planned is less by a margin [rad/s], or nothing, and its angular momentum with it.");
  bind_fields<online::FeltPush>(m);
  m.def(
      "com_shift_W", &online::com_shift_W, py::arg("push"), py::arg("com_height"), py::arg("gravity"),
      "How far beside the measured CoM to plan from while a push is felt, (3,) [m], for a pendulum of a height [m] "
      "under gravity [m/s^2]; references of the CoM are as far on the other side of the plan's. Raises InvalidInput.");
  py::class_<online::PushObserver>(m, "PushObserver",
                                   "Feels pushes by the CoM's velocity against what the controller's model promised.")
      .def(py::init<>())
      .def("update", &online::PushObserver::update, py::arg("velocity_W"), py::arg("promised_W").none(true),
           py::arg("dt_s"),
           "What is felt at this control step: velocity of the CoM on the level (2,) [m/s], its acceleration since "
           "the last call by the model (2,) [m/s^2] or None where contacts were others than the model thought, and "
           "the time since the last call [s]. While contacts are others, for 30 ms after it, and where a velocity or "
           "acceleration is one that no robot has, or no number, nothing can be said: what was felt is held for a "
           "fifth of the time for which it had been felt, 0.3 s at most. Noise makes it slower, and is no push. "
           "Raises InvalidInput for a time that is not positive.")
      .def_property_readonly(
          "push", [](const online::PushObserver& self) { return online::FeltPush(self.push()); },
          "The FeltPush of the last call, a copy.");
}

}  // namespace mcplan::bindings
