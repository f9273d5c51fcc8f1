#include <pybind11/functional.h>

#include <optional>

#include "bindings.hpp"
#include "mcplan/planar/sip/certificate.hpp"
#include "mcplan/planar/sip/planner.hpp"
#include "signals.hpp"

namespace mcplan::bindings {
namespace {

using sip::Certificate;
using sip::ContactMode;
using sip::Continuous;
using sip::Forces;
using sip::FreeFlyer;
using sip::HessianChoice;
using sip::Options;
using sip::Planner;
using sip::Result;

void bind_choices(py::module_& m) {
  py::enum_<Forces>(m, "Forces", "Where contact forces come from (Lengagne et al., secs. III-C and IV-D).")
      .value("uniform", Forces::uniform, "Weighted least norm, all weights 1: case 1.")
      .value("per_body", Forces::per_body, "One weight for each contact of a phase: case 2.")
      .value("per_point", Forces::per_point, "One weight for each point of a contact: case 3.")
      .value("parameters", Forces::parameters, "Cubic polynomials of time over each interval, balance as constraints.");
  py::enum_<ContactMode>(m, "ContactMode", "How an end-effector in contact is held where it should be.")
      .value("tube", ContactMode::tube, "Position and angle stay within a tube at every instant.")
      .value("band", ContactMode::band, "Polynomial coefficients 0..neq of position and angle within a band.")
      .value("strict", ContactMode::strict, "The same coefficients zero; one contact of a phase is left out.");
  py::enum_<Continuous>(m, "Continuous", "How an inequality is kept at every instant of an interval.")
      .value("hull", Continuous::hull, "Every Bernstein coefficient within the limits.")
      .value("extremum", Continuous::extremum, "The polynomial's extrema within the limits: exact, not smooth.")
      .value("grid", Continuous::grid, "At grid_points instants: nothing is said about the time between.");
  py::enum_<FreeFlyer>(m, "FreeFlyer", "The trajectory of the base.")
      .value("computed", FreeFlyer::computed, "From the joints (eqs. 9-12).")
      .value("parameterised", FreeFlyer::parameterised, "Three more splines (Table I).");
  py::enum_<HessianChoice>(m, "HessianChoice", "Where second derivatives come from.")
      .value("automatic", HessianChoice::automatic, "As suits the problem, and another one where that fails.")
      .value("exact", HessianChoice::exact, "Of cost and constraints.")
      .value("gauss_newton", HessianChoice::gauss_newton, "Of the cost alone, without its curvature.")
      .value("limited_memory", HessianChoice::limited_memory, "L-BFGS.");
}

void bind_options(py::module_& m) {
  py::class_<Options> c(m, "Options", "Options of the semi-infinite planner.");
  c.def(py::init<>());
  c.def_readwrite("forces", &Options::forces);
  c.def_readwrite("torque_weight", &Options::torque_weight, "Cost: integral of the squared torques [1/(N m)^2 s].");
  c.def_readwrite("duration_weight", &Options::duration_weight, "Cost: duration [1/s].");
  c.def_readwrite("jerk_weight", &Options::jerk_weight, "Cost: integral of the squared joint jerks [s^5].");
  c.def_readwrite("free_durations", &Options::free_durations,
                  "A duration for each phase; else one for the motion, shared by intervals.");
  def_range(c, "total_duration_s", &Options::total_duration_s, "Where free_durations is off: min, max [s].");
  def_range(c, "phase_duration_s", &Options::phase_duration_s,
            "Where free_durations is on: min, max [s]; the motion's own limits hold as well.");
  c.def_readwrite("contact", &Options::contact);
  c.def_readwrite("tube_m", &Options::tube_m, "Half width of the tube or of the band [m].");
  c.def_readwrite("tube_rad", &Options::tube_rad, "[rad]");
  c.def_readwrite("neq", &Options::neq, "Highest coefficient of band and strict, 0 to order.");
  c.def_readwrite("continuous", &Options::continuous);
  c.def_readwrite("grid_points", &Options::grid_points, "Per interval, both ends included.");
  c.def_readwrite("order", &Options::order, "Of the Taylor polynomials, 3 to 12.");
  c.def_readwrite("free_flyer", &Options::free_flyer);
  c.def_readwrite("dynamics", &Options::dynamics, "Contact forces in their cones; off: kinematics alone.");
  c.def_readwrite("torque_limits", &Options::torque_limits);
  c.def_readwrite("clearance", &Options::clearance, "Swinging end-effectors outside solids, as the motion says.");
  c.def_readwrite("self_collision", &Options::self_collision, "Of the robot's collision pairs.");
  c.def_readwrite("clearance_m", &Options::clearance_m,
                  "Least height of swinging points [m]: at lift-off they are at zero to the tube.");
  c.def_readwrite("min_normal_force", &Options::min_normal_force, "At every point [N].");
  c.def_readwrite("margin", &Options::margin, "Kept to joint, torque and force limits, relative.");
  c.def_readwrite("log_weight_max", &Options::log_weight_max, "Bound of the logarithms of weights.");
  c.def_readwrite("kinematics_first", &Options::kinematics_first,
                  "With dynamics: find contacts and joints within limits first, forces from there.");
  c.def_readwrite("feasible_first", &Options::feasible_first,
                  "With a cost: solve without it first, and start from that.");
  c.def_readwrite("hessian", &Options::hessian);
  c.def_readwrite("tolerance", &Options::tolerance, "Optimality tolerance of the solver.");
  c.def_readwrite("constraint_tolerance", &Options::constraint_tolerance);
  c.def_readwrite("max_iterations", &Options::max_iterations, "Of each run of the solver.");
  c.def_readwrite("time_limit_s", &Options::time_limit_s, "Wall clock of the whole solve [s].");
  c.def_readwrite("logger", &Options::logger, "Called with (LogLevel, line), a line an iteration; None: silent.");
  c.def("has_cost", &Options::has_cost, "Whether any weight is positive.");
  c.def("validate", &Options::validate, "Raises InvalidOptions naming the first field out of its range.");
}

/// What Python calls Result: with room for a certificate, which C++ users ask certify() for themselves.
struct JudgedResult : Result {
  std::optional<Certificate> certificate;
};

void bind_result(py::module_& m) {
  py::class_<JudgedResult> c(m, "Result", "A planar plan and how it was found.");
  def_member(c, "plan", static_cast<PlanarPlan JudgedResult::*>(&Result::plan), "The motion: a PlanarPlan.");
  def_member(c, "report", static_cast<Report JudgedResult::*>(&Result::report),
             "Status solved only if the checker accepts the plan; time_s is split in timing_s: \"evaluation\", "
             "\"linear_solver\", \"check\"; cost_terms by name.");
  c.def_readonly("parameters", &Result::parameters, "Variables of the program.");
  c.def_readonly("constraints", &Result::constraints, "Rows of the program.");
  c.def_readonly("drift_m", &Result::drift_m, "Largest of a contact, at 1 kHz, from exact kinematics [m].");
  c.def_readonly("drift_rad", &Result::drift_rad, "[rad]");
  c.def_property(
      "certificate", [](const JudgedResult& self) { return self.certificate; },
      [](JudgedResult& self, std::optional<Certificate> value) { self.certificate = std::move(value); },
      "What is proved of the plan, a copy; None: not asked for.", py::return_value_policy::copy);
  c.def("__repr__", [](const JudgedResult& self) {
    return "<sip.Result: " + shown(self.plan.motion.name) + ", " + std::string(py::str(py::cast(self.report.status))) +
           ", " + std::to_string(self.report.iterations) + " iterations, " + std::to_string(self.parameters) +
           " parameters, " + std::to_string(self.constraints) + " constraints>";
  });
}

void bind_planner_class(py::module_& m) {
  py::class_<Planner> c(
      m, "Planner",
      "Whole-body planning of a planar robot through a sequence of contact stances by semi-infinite "
      "programming (Lengagne et al., 2010). Solves release the GIL; Ctrl-C ends them, and Interrupted "
      "carries the best plan so far.");
  c.def(py::init([](const PlanarTask& motion, const Options& options) { return Planner(motion, watched(options)); }),
        py::arg("motion"), py::arg_v("options", Options(), "Options()"),
        "Raises InvalidMotion, InvalidRobot, InvalidOptions.");
  c.def(
      "solve",
      [](Planner& self) {
        const Alone alone(&self, "solve");
        return interruptible([&] { return JudgedResult{self.solve(), std::nullopt}; });
      },
      "From the robot's zero posture throughout, weights of 1, and one second.");
  c.def(
      "solve",
      [](Planner& self, PlanarPlan plan) {
        const Alone alone(&self, "solve");
        return interruptible([&] { return JudgedResult{self.solve(plan), std::nullopt}; });
      },
      py::arg("warm_start"),
      "From a plan of the same robot and phases; forces, order, tube and durations may differ. Raises InvalidPlan "
      "where its phases or joints do not fit.");
  c.def_property_readonly("parameters", &Planner::parameters, "Variables of the program.");
  c.def_property_readonly("constraints", &Planner::constraints, "Rows of the program.");
}

}  // namespace

void bind_sip_planner(py::module_& m) {
  bind_choices(m);
  bind_options(m);
  bind_result(m);
  bind_planner_class(m);
}

}  // namespace mcplan::bindings
