#include <pybind11/functional.h>

#include "bindings.hpp"
#include "mcplan/ddp/cost_terms.hpp"
#include "mcplan/ddp/options.hpp"
#include "mcplan/ddp/switched_ddp.hpp"
#include "signals.hpp"

namespace mcplan::bindings {
namespace {

using ddp::Method;
using ddp::Model;
using ddp::Options;
using ddp::StiffnessInput;
using ddp::SwitchedDdp;
using ddp::Weights;

void bind_weights(py::module_& m) {
  py::class_<Weights> c(m, "Weights",
                        "Weights w of the cost terms 1/2 w^2 e^2 (Tazaki, Table I), for non-dimensional quantities: "
                        "length in CoM heights, time in sqrt(height / gravity), mass 1.");
  c.def(py::init<>());
  c.def_readwrite("com", &Weights::com);
  c.def_readwrite("com_end", &Weights::com_end, "At the first and last knot.");
  c.def_readwrite("velocity", &Weights::velocity);
  c.def_readwrite("velocity_end", &Weights::velocity_end);
  c.def_readwrite("rotation", &Weights::rotation, "On the base's angles and rates, inside for Model.lipm alone.");
  c.def_readwrite("rotation_end", &Weights::rotation_end);
  c.def_readwrite("angle", &Weights::angle, "On the base's angles inside, of Model.wrench.");
  c.def_readwrite("momentum", &Weights::momentum, "On the angular momentum inside, of Model.wrench.");
  c.def_readwrite("center_of_pressure", &Weights::center_of_pressure,
                  "On the distance of the acting force from the end-effector, of Model.wrench.");
  c.def_readwrite("force_line", &Weights::force_line,
                  "On the distance from there to the line that points at the CoM, of Model.wrench; very large: the "
                  "paper's forces.");
  c.def_readwrite("end_effector", &Weights::end_effector);
  c.def_readwrite("end_effector_end", &Weights::end_effector_end);
  c.def_readwrite("stride", &Weights::stride, "On the travel of an end-effector within a phase.");
  c.def_readwrite("stiffness", &Weights::stiffness);
  c.def_readwrite("moment", &Weights::moment);
  c.def_readwrite("limit", &Weights::limit, "Reach, stiffness, moment, force, friction, duration.");
  c.def_readwrite("duration", &Weights::duration, "Towards the middle of the duration box.");
  c.def_readwrite("contact_min", &Weights::contact_min, "First complementarity weight.");
  c.def_readwrite("contact_max", &Weights::contact_max, "Last complementarity weight.");
  c.def_readwrite("contact_growth", &Weights::contact_growth, "Factor between iterations, above 1.");
  c.def_readwrite("overshoot_factor", &Weights::overshoot_factor, "On leaving a polygon sideways, at least 1.");
  for (const ddp::CostTerm* term : ddp::cost_terms())
    if (term->has_own_weight())
      c.def_property(
          term->name(), [term](const Weights& self) { return term->weight(self); },
          [term](Weights& self, double weight) { self.own[term->name()] = weight; }, term->own_weight().meaning);
}

void bind_options(py::module_& m) {
  py::enum_<Method>(m, "Method", "Which search runs.")
      .value("standard", Method::standard)
      .value("paper", Method::paper);
  py::enum_<Model>(m, "Model", "What a contact can do.")
      .value("wrench", Model::wrench,
             "Forces act within the sole and need not point at the CoM: angular momentum, turning, friction as it is.")
      .value("lipm", Model::lipm, "The paper's: forces act at the end-effector and point at the CoM.");
  py::enum_<StiffnessInput>(m, "StiffnessInput", "How the contact stiffness enters: mu, or lambda with mu = lambda^2.")
      .value("mu", StiffnessInput::mu)
      .value("lambda_", StiffnessInput::lambda);
  py::class_<Options> c(m, "Options",
                        "Options of the contact-sequence search; the defaults serve all built-in scenes.");
  c.def(py::init<>());
  c.def_readwrite("phases", &Options::phases, "Number of phases N; 0: 18, or more where the way asks for more steps.");
  c.def_readwrite("method", &Options::method);
  c.def_readwrite("model", &Options::model, "Method.paper always takes Model.lipm.");
  c.def_readwrite("stiffness_input", &Options::stiffness_input);
  c.def_readwrite("weights", &Options::weights);
  c.def_readwrite("duration_min_s", &Options::duration_min_s, "Soft box of the phase durations [s]; 0: the robot's.");
  c.def_readwrite("duration_max_s", &Options::duration_max_s, "[s]; 0: the robot's.");
  c.def_readwrite("flight_duration_min_s", &Options::flight_duration_min_s,
                  "Lower bound of phases without any contact [s]. The default goes with the size of the robot.");
  c.def_readwrite("duration_initial_s", &Options::duration_initial_s,
                  "First guess of all phases [s]; 0: the middle of their box, 0.45 for Model.lipm.");
  c.def_readwrite("proximal_weight", &Options::proximal_weight, "First weight on the change of the inputs.");
  c.def_readwrite("interior_points", &Options::interior_points, "Instants inside a phase where limits are held.");
  c.def_readwrite("reach_margin_m", &Options::reach_margin_m,
                  "The reach box is planned smaller by this [m]. The default goes with the size of the robot.");
  c.def_readwrite("sole_inside", &Options::sole_inside,
                  "Share of a sole's half size by which footholds keep from the edges of their surface; 1: the whole "
                  "sole is on it, where it is large enough; negative: the robot's sole_support.");
  c.def_readwrite("friction", &Options::friction, "Hold the friction cones.");
  c.def_readwrite("friction_sides", &Options::friction_sides,
                  "Sides of the pyramid inside the cone that is held instead of it; 0: the cone itself.");
  c.def_readwrite("whole_sequence_moves", &Options::whole_sequence_moves);
  c.def_readwrite("one_switch_per_step", &Options::one_switch_per_step);
  c.def_readwrite("restarts", &Options::restarts, "Further attempts while the checker rejects the plan.");
  c.def_readwrite("max_iterations", &Options::max_iterations, "Over all attempts.");
  c.def_readwrite("time_limit_s", &Options::time_limit_s, "Wall clock [s].");
  c.def_readwrite("threads", &Options::threads, "For pricing; the result does not depend on it.");
  c.def_readwrite("seed", &Options::seed);
  c.def_readwrite("initial_sequence", &Options::initial_sequence,
                  "phases + 1 rows: surface index per end-effector, -1 free. Empty: searched for.");
  c.def_readwrite("record_history", &Options::record_history, "Keep the sequence of every iteration in the report.");
  c.def_readwrite("logger", &Options::logger, "Called with (LogLevel, line); None: silent.");
  c.def("validate", &Options::validate, "Raises InvalidOptions naming the first field out of its range.");
}

}  // namespace

void bind_ddp(py::module_& parent) {
  py::module_ m = parent.def_submodule("ddp", "Contact-sequence search by switched differential dynamic programming.");
  bind_weights(m);
  bind_options(m);
  py::class_<SwitchedDdp> c(
      m, "SwitchedDdp",
      "Contact-sequence search for one scene and robot. Solves release the GIL; Ctrl-C ends them, and "
      "Interrupted carries the best plan so far.");
  c.def(py::init([](const Scene& scene, const Robot& robot, const Options& options) {
          return SwitchedDdp(scene, robot, watched(options));
        }),
        py::arg("scene"), py::arg("robot"), py::arg_v("options", Options(), "Options()"));
  c.def(
      "solve", [](SwitchedDdp& self) { return interruptible([&] { return self.solve(); }); },
      "Plan from the scene's start to its goal.");
  c.def(
      "solve", [](SwitchedDdp& self, Plan plan) { return interruptible([&] { return self.solve(plan); }); },
      py::arg("warm_start"), "The same, starting from an earlier plan's contact sequence, motion and timing.");
  c.def(
      "replan",
      [](SwitchedDdp& self, Plan previous, double t, Knot measured) {
        return interruptible([&] { return self.replan(previous, t, measured); });
      },
      py::arg("previous"), py::arg("t"), py::arg("measured"),
      "Plan on from a measured state at time t [s] of an earlier plan.");
}

}  // namespace mcplan::bindings
