#include <pybind11/functional.h>

#include <optional>

#include "fields.hpp"
#include "mcplan/planar/sip/certificate.hpp"
#include "mcplan/planar/sip/planner.hpp"
#include "pickles.hpp"
#include "planar/sip/options_fields.hpp"
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

void bind_options(py::module_& m) {
  bind_enum<Forces>(m);
  bind_enum<ContactMode>(m);
  bind_enum<Continuous>(m);
  bind_enum<FreeFlyer>(m);
  bind_enum<HessianChoice>(m);
  bind_fields<Options>(m)
      .def("has_cost", &Options::has_cost, "Whether there is anything to minimise; torques with dynamics only.")
      .def("validate", &Options::validate, "Raise InvalidOptions naming all that is out of its range.");
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
  c.def_readonly("solver", &Result::solver, "That found the motion: ipopt or ipm.");
  c.def_property(
      "certificate", [](const JudgedResult& self) { return self.certificate; },
      [](JudgedResult& self, std::optional<Certificate> value) { self.certificate = std::move(value); },
      "What is proved of the plan, a copy; None: not asked for.", py::return_value_policy::copy);
  c.def("__repr__", [](const JudgedResult& self) {
    return "<sip.Result: " + shown(self.plan.task.name) + ", " + std::string(py::str(py::cast(self.report.status))) +
           ", " + std::to_string(self.report.iterations) + " iterations, " + std::to_string(self.parameters) +
           " parameters, " + std::to_string(self.constraints) + " constraints>";
  });
  def_pickle(c, &Result::plan, &Result::report, &Result::solver, &Result::parameters, &Result::constraints,
             &Result::drift_m, &Result::drift_rad, &JudgedResult::certificate);
}

void bind_planner_class(py::module_& m) {
  py::class_<Planner> c(
      m, "Planner",
      "Whole-body planning of a planar robot through a sequence of contact stances by semi-infinite "
      "programming (Lengagne et al., 2010). Solves release the GIL; Ctrl-C ends them, and Interrupted "
      "carries the best plan so far.");
  c.def(py::init([](const PlanarTask& task, const Options& options) { return Planner(task, watched(options)); }),
        py::arg("task"), py::arg_v("options", Options(), "Options()"),
        "Raises InvalidPlanarTask, InvalidRobot, InvalidOptions.");
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
  bind_options(m);
  bind_result(m);
  bind_planner_class(m);
}

}  // namespace mcplan::bindings
