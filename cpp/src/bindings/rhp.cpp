#include <pybind11/functional.h>

#include "fields.hpp"
#include "mcplan/rhp/receding_horizon.hpp"
#include "pickles.hpp"
#include "rhp/options_fields.hpp"
#include "signals.hpp"

namespace mcplan::bindings {
namespace {

using rhp::Cycle;
using rhp::Fidelity;
using rhp::RecedingHorizon;
using rhp::State;
using rhp::Transcription;
using rhp::Walk;

void bind_rhp_options(py::module_& m) {
  bind_enum<Fidelity>(m);
  bind_enum<Transcription>(m);
  bind_fields<rhp::Options>(m).def("validate", &rhp::Options::validate,
                                   "Raise InvalidOptions naming all that is out of its range.");
}

void bind_state(py::module_& m) {
  py::class_<State> c(m, "State", "Where the robot is: the start of a horizon.");
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  c.def(py::init([](const Eigen::Vector3d& com_W, const Eigen::Vector3d& com_velocity_W,
                    const Eigen::Vector3d& angular_momentum_W, const py::object& feet_W, std::vector<int> surfaces) {
          return State{com_W, com_velocity_W, angular_momentum_W, points_from(feet_W, "feet_W"), std::move(surfaces)};
        }),
        py::kw_only(), py::arg("com_W") = zero, py::arg("com_velocity_W") = zero, py::arg("angular_momentum_W") = zero,
        py::arg("feet_W") = py::tuple(), py::arg("surfaces") = std::vector<int>());
  def_vector(c, "com_W", &State::com_W, "[m]");
  def_vector(c, "com_velocity_W", &State::com_velocity_W, "[m/s]");
  def_vector(c, "angular_momentum_W", &State::angular_momentum_W, "About the CoM [kg m^2/s].");
  def_points(c, "feet_W", &State::feet_W, "Sole centres, one row a foot, in the robot's order [m].");
  def_names(c, "surfaces", &State::surfaces, "Indices of the surfaces on which the feet stand.");
  def_value(c, "State", {"com_W", "com_velocity_W", "angular_momentum_W", "feet_W", "surfaces"});
}

void bind_results(py::module_& m) {
  bind_enum<rhp::StepFrom>(m);
  py::class_<Cycle> c(m, "Cycle", "How one cycle went.");
  c.def_readonly("index", &Cycle::index);
  c.def_readonly("status", &Cycle::status, "solved: converged, and the checker accepts the executed step.");
  c.def_readonly("message", &Cycle::message);
  c.def_readonly("executed", &Cycle::executed, "A step was taken into the walk: step_from is not none.");
  c.def_readonly("step_from", &Cycle::step_from, "Where that step comes from.");
  c.def_readonly("solver", &Cycle::solver, "That found the step: ipopt or ipm.");
  c.def_readonly("iterations", &Cycle::iterations);
  c.def_readonly("time_s", &Cycle::time_s, "Wall clock, set-up and check included [s].");
  c.def_readonly("evaluation_s", &Cycle::evaluation_s, "Of which in functions and derivatives [s].");
  c.def_readonly("linear_solver_s", &Cycle::linear_solver_s, "Of which in the linear solver [s].");
  c.def_readonly("variables", &Cycle::variables);
  c.def_readonly("constraints", &Cycle::constraints);
  c.def_readonly("cost", &Cycle::cost, "Of the whole horizon.");
  c.def_readonly("acceleration_cost", &Cycle::acceleration_cost, "Executed step: integral of |a|^2 [m^2/s^3].");
  c.def_readonly("momentum_cost", &Cycle::momentum_cost, "Executed step: integral of |L|^2.");
  c.def_readonly("distance_m", &Cycle::distance_m, "Executed step: travel of the CoM along the heading [m].");
  c.def_readonly("duration_s", &Cycle::duration_s, "Executed step [s].");
  c.def_readonly("defect", &Cycle::defect, "Largest residual of the horizon's equations.");
  c.def_readonly("drift_com_m", &Cycle::drift_com_m,
                 "Forces of the executed step replayed in continuous time against its states, at its end [m].");
  c.def_readonly("drift_momentum", &Cycle::drift_momentum, "The same of L [kg m^2/s].");
  c.def_readonly("worst_violation", &Cycle::worst_violation,
                 "Of the executed step; without one, of the program's best point.");
  c.def("__repr__", [](py::handle self) {
    return "<Cycle " + std::string(py::str(self.attr("index"))) + ": " + std::string(py::str(self.attr("status"))) +
           ", " + std::string(py::str(self.attr("iterations"))) + " iterations>";
  });
  def_pickle(c, &Cycle::index, &Cycle::status, &Cycle::message, &Cycle::executed, &Cycle::step_from, &Cycle::solver,
             &Cycle::iterations, &Cycle::time_s, &Cycle::evaluation_s, &Cycle::linear_solver_s, &Cycle::variables,
             &Cycle::constraints, &Cycle::cost, &Cycle::acceleration_cost, &Cycle::momentum_cost, &Cycle::distance_m,
             &Cycle::duration_s, &Cycle::defect, &Cycle::drift_com_m, &Cycle::drift_momentum, &Cycle::worst_violation);

  py::class_<Walk> w(m, "Walk", "A walk: its plan, how it was found, cycle by cycle.");
  def_member(w, "plan", &Walk::plan, "The executed steps, one after the other.");
  def_member(w, "report", &Walk::report, "Status and message of the worst cycle, times summed.");
  def_items(w, "cycles", &Walk::cycles, "Tuple of Cycle.");
  w.def_readonly("success", &Walk::success, "Every cycle that was asked for gave a step within its constraints.");
  w.def("distance_m", &Walk::distance_m, "Travelled by the CoM along the heading [m].");
  w.def("acc_per_m", &Walk::acc_per_m, "Integral of |a|^2 per metre, executed steps.");
  w.def("momentum_per_m", &Walk::momentum_per_m, "Integral of |L|^2 per metre, executed steps.");
  w.def("drift_com_m", &Walk::drift_com_m, "Largest of a cycle [m].");
  w.def("drift_momentum", &Walk::drift_momentum, "Largest of a cycle [kg m^2/s].");
  w.def("__repr__", [](py::handle self) {
    return "<Walk of " + std::to_string(py::len(self.attr("cycles"))) +
           " cycles: " + std::string(py::str(py::float_(self.attr("distance_m")()).attr("__format__")(".2f"))) +
           " m, " + std::string(py::str(self.attr("report").attr("status"))) + ">";
  });
  def_pickle(w, &Walk::plan, &Walk::report, &Walk::cycles, &Walk::success);
  m.attr("Result") = w;
}

}  // namespace

void bind_rhp(py::module_& parent) {
  py::module_ m = parent.def_submodule("rhp", "Multi-fidelity receding-horizon planning of walks on two feet.");
  m.attr("Solver") = parent.attr("nlp").attr("Solver");  // beside the options that have it
  bind_rhp_options(m);
  bind_state(m);
  bind_results(m);
  py::class_<RecedingHorizon> c(m, "RecedingHorizon",
                                "One nonlinear program a cycle, of whose steps the first is executed. Solves release "
                                "the GIL; Ctrl-C ends them, and Interrupted carries the walk or the cycle.");
  c.def(py::init([](const Scene& scene, const Robot& robot, const rhp::Options& options) {
          return RecedingHorizon(scene, robot, watched(options));
        }),
        py::arg("scene"), py::arg("robot"), py::arg_v("options", rhp::Options(), "Options()"),
        "The contact sequence is scene.steps; after its end the feet go on in turn on its last surface.");
  c.def(py::init([](const Scene& scene, const Robot& robot, const Plan& sequence, const rhp::Options& options) {
          return RecedingHorizon(scene, robot, sequence, watched(options));
        }),
        py::arg("scene"), py::arg("robot"), py::arg("sequence"), py::arg_v("options", rhp::Options(), "Options()"),
        "Contact sequence and start are those of a plan; the walk comes to rest after its last step.");
  c.def(
      "walk",
      [](RecedingHorizon& self) {
        const Alone alone(&self, "walk");
        return interruptible([&] { return self.walk(); });
      },
      "Run all cycles that the options ask for, or until one fails.");
  c.def(
      "step",
      [](RecedingHorizon& self) {
        const Alone alone(&self, "step");
        return interruptible([&] { return self.step(); });
      },
      "One cycle from where the last one ended; after one that a limit cut short without a step, on where that one "
      "stopped.");
  c.def(
      "step",
      [](RecedingHorizon& self, State measured) {
        const Alone alone(&self, "step");
        return interruptible([&] { return self.step(measured); });
      },
      py::arg("measured"), "One cycle from a measured state.");
  const auto def_look = [&c](const char* name, auto look, const char* doc) {
    c.def(
        name,
        [name, look](const RecedingHorizon& self) {
          require_idle(&self, name, true);
          return (self.*look)();
        },
        doc, py::return_value_policy::copy);
  };
  def_look("state", &RecedingHorizon::state, "At the start of the next cycle.");
  def_look("executed", &RecedingHorizon::executed, "The step that the last good cycle executes, from time 0.");
  def_look("horizon", &RecedingHorizon::horizon, "Its whole horizon, predicted steps included.");
  def_look("result", &RecedingHorizon::result, "What was executed so far.");
}

}  // namespace mcplan::bindings
