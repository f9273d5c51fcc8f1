#include "mcplan/plan/plan.hpp"

#include "fields.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/plan/loads.hpp"
#include "mcplan/plan/plan_files.hpp"
#include "mcplan/plan/report.hpp"
#include "named_types.hpp"
#include "pickles.hpp"
#include "plan/plan_fields.hpp"
#include "plan/tolerances_fields.hpp"
#include "signals.hpp"

template <>
struct pybind11::detail::type_caster<mcplan::ForceLaw> : mcplan::bindings::NamedTypeCaster<mcplan::ForceLaw> {};

namespace mcplan::bindings {
namespace {

using Eigen::Vector3d;

void bind_parts(py::module_& m) {
  bind_fields<Contact>(m);
  py::class_<Phase> phase = bind_fields<Phase>(m);
  phase.def("node_count", &Phase::node_count,
            "Instants at which forces are given: `intervals` when held, one more when linear, 0 without such.");
  phase.def_property_readonly("has_points", &Phase::has_points,
                              "Whether forces act at points, not as one force that follows the CoM.");
  phase.def_property_readonly("has_momentum", &Phase::has_momentum,
                              "Whether the angular momentum is a state of knots, not what the base has by its rates.");
  phase.def_property_readonly("has_wrenches", &Phase::has_wrenches,
                              "Whether contacts have a centre of pressure and a moment that turn the base.");
  bind_fields<Knot>(m);
  bind_fields<Swing>(m);
}

void bind_state(py::module_& m) {
  py::class_<EndEffectorState> end(m, "EndEffectorState", "An end-effector at an instant.");
  end.def_readonly("surface", &EndEffectorState::surface, "Index into scene.surfaces, -1: free.");
  end.def_readonly("position_W", &EndEffectorState::position_W, "[m]");
  end.def_readonly("velocity_W", &EndEffectorState::velocity_W, "[m/s]");
  end.def_readonly("force_W", &EndEffectorState::force_W, "Contact force on the robot [N], zero when free.");
  end.def_readonly("moment_W", &EndEffectorState::moment_W, "Contact moment on the robot [N m], zero when free.");
  end.def_readonly("center_of_pressure_W", &EndEffectorState::center_of_pressure_W,
                   "Where the force acts [m]; position_W when free.");
  end.def_readonly("yaw", &EndEffectorState::yaw, "Heading of the sole [rad].");
  const auto def_rows = [&end](const char* name, std::vector<Vector3d> EndEffectorState::*member, const char* doc) {
    end.def_property_readonly(
        name, [member](py::object self) { return points_view(self.cast<EndEffectorState&>().*member, self); }, doc);
  };
  def_rows("points_W", &EndEffectorState::points_W, "N x 3 [m], where the law has forces at points.");
  def_rows("point_forces_W", &EndEffectorState::point_forces_W, "N x 3, force on the robot at each point [N].");
  def_value(end, "EndEffectorState",
            {"surface", "position_W", "velocity_W", "force_W", "moment_W", "center_of_pressure_W", "yaw", "points_W",
             "point_forces_W"});

  py::class_<PlanState> state(m, "PlanState", "The robot at an instant.");
  state.def_readonly("time", &PlanState::time, "[s]");
  state.def_readonly("phase", &PlanState::phase);
  state.def_readonly("com_W", &PlanState::com_W, "[m]");
  state.def_readonly("com_velocity_W", &PlanState::com_velocity_W, "[m/s]");
  state.def_readonly("com_acceleration_W", &PlanState::com_acceleration_W, "[m/s^2]");
  state.def_readonly("base_rpy", &PlanState::base_rpy, "[rad]");
  state.def_readonly("base_rpy_rate", &PlanState::base_rpy_rate, "[rad/s]");
  state.def_readonly("base_quat_wxyz", &PlanState::base_quat_wxyz, "R_WB");
  state.def_readonly("angular_momentum_W", &PlanState::angular_momentum_W, "About the CoM [kg m^2/s].");
  def_items(state, "end_effectors", &PlanState::end_effectors, "One EndEffectorState per end-effector of the robot.");
  def_value(state, "PlanState",
            {"time", "phase", "com_W", "com_velocity_W", "com_acceleration_W", "base_rpy", "base_rpy_rate",
             "base_quat_wxyz", "angular_momentum_W", "end_effectors"});
}

std::string describe(const Plan& plan) {
  int flights = 0;
  for (const auto& row : plan.contact_sequence()) {
    bool any = false;
    for (int surface : row) any = any || surface >= 0;
    flights += !any;
  }
  return "<Plan of " + shown(plan.robot.name) + " on " + shown(plan.scene.name) + ": " +
         std::to_string(plan.phases.size()) + " phases, " + text(plan.duration()) + " s, " + std::to_string(flights) +
         " in flight>";
}

void bind_plan_class(py::module_& m) {
  py::class_<Plan> plan = bind_fields<Plan>(m);  // its repr is not what could be pasted back, which would be pages long
  plan.def("duration", &Plan::duration, "[s]");
  plan.def("knot_times", &Plan::knot_times, "[s], phases + 1 entries, from 0.");
  plan.def("end_effector_count", &Plan::end_effector_count);
  plan.def("contact_sequence", &Plan::contact_sequence, "Surface index per phase and end-effector, -1: free.");
  plan.def(
      "at", &Plan::at, py::arg("t"),
      "PlanState at time t [s] in [0, duration], in closed form. At a knot the phase that begins there is meant (the "
      "last one at the end). Raises InvalidInput outside, InvalidPlan where an edited plan does not fit together.");
  plan.def("at_phase", &Plan::at_phase, py::arg("k"), py::arg("since_start"),
           "PlanState `since_start` [s], 0 to its duration, after the start of phase k: says which side of a knot is "
           "meant. Raises as at() does.");
  plan.def("validate", &Plan::validate,
           "Raise InvalidPlan when sizes or indices do not fit together or a number is not finite.");
  plan.def("__repr__", py::overload_cast<const Plan&>(&describe), py::prepend());
  m.def(
      "plan_to_json", [](const Plan& self) { return py::bytes(plan_to_json(self)); }, py::arg("plan"),
      "A plan as JSON; numbers read back as the same. Raises InvalidPlan.");
  m.def(
      "plan_from_json", [](const py::bytes& content) { return plan_from_json(content); }, py::arg("content"),
      "The plan of a JSON text. Raises InvalidPlan.");
}

std::string describe(const Report& report) {
  std::string out = std::string(to_string(report.status)) + " after " + text(report.time_s) + " s (" +
                    text(report.iterations) + " iterations, " + text(report.switches) + " switches), cost " +
                    text(report.cost);
  if (!report.message.empty()) out += "\n" + report.message;
  if (!report.worst_violation.name.empty()) out += "\nclosest to its limit: " + report.worst_violation.to_string();
  return shown(out);
}

void bind_violation(py::module_& m) {
  py::class_<Violation> violation(m, "Violation", "A constraint and the place where a plan breaks it most.");
  violation.def(py::init([](std::string name, int phase, std::string end_effector, double time_s, double value,
                            double tolerance, std::string unit, std::string surface) {
                  return Violation{std::move(name), phase,     std::move(end_effector), time_s,
                                   value,           tolerance, std::move(unit),         std::move(surface)};
                }),
                py::kw_only(), py::arg("name") = "", py::arg("phase") = -1, py::arg("end_effector") = "",
                py::arg("time_s") = 0.0, py::arg("value") = 0.0, py::arg("tolerance") = 0.0, py::arg("unit") = "",
                py::arg("surface") = "");
  violation.def_readwrite("name", &Violation::name, "E.g. 'friction'.");
  violation.def_readwrite("phase", &Violation::phase, "-1: not tied to a phase.");
  violation.def_readwrite("end_effector", &Violation::end_effector, "Empty: not tied to one.");
  violation.def_readwrite("time_s", &Violation::time_s);
  violation.def_readwrite("value", &Violation::value, "Amount beyond the limit, in `unit`; negative: margin left.");
  violation.def_readwrite("tolerance", &Violation::tolerance, "Largest value that is still accepted.");
  violation.def_readwrite("unit", &Violation::unit);
  violation.def_readwrite("surface", &Violation::surface, "Whose solid a warning is about; empty: not tied to one.");
  violation.def("__str__", [](const Violation& self) { return shown(self.to_string()); });
  def_value(violation, "Violation",
            {"name", "phase", "end_effector", "time_s", "value", "tolerance", "unit", "surface"});
  def_pickle(violation, &Violation::name, &Violation::phase, &Violation::end_effector, &Violation::time_s,
             &Violation::value, &Violation::tolerance, &Violation::unit, &Violation::surface);
}

void bind_iteration(py::module_& m) {
  py::class_<Iteration> row(m, "Iteration", "One row of the iteration table.");
  row.def_readonly("index", &Iteration::index);
  row.def_readonly("cost", &Iteration::cost, "Total, at the weight of this iteration.");
  row.def_readonly("merit", &Iteration::merit, "What the line search lowers.");
  row.def_readonly("defect", &Iteration::defect, "Largest dynamics defect (non-dimensional).");
  row.def_readonly("contact_weight", &Iteration::contact_weight);
  row.def_readonly("proximal_weight", &Iteration::proximal_weight);
  row.def_readonly("step", &Iteration::step, "Accepted step length.");
  row.def_readonly("switches", &Iteration::switches, "Contact switches accepted in this iteration.");
  row.def_readonly("neighbours", &Iteration::neighbours, "Candidates priced.");
  row.def_readonly("sequence", &Iteration::sequence,
                   "Steps x end-effectors after this iteration, if history is recorded.");
  def_value(
      row, "Iteration",
      {"index", "cost", "merit", "defect", "contact_weight", "proximal_weight", "step", "switches", "neighbours"});
  def_pickle(row, &Iteration::index, &Iteration::cost, &Iteration::merit, &Iteration::defect,
             &Iteration::contact_weight, &Iteration::proximal_weight, &Iteration::step, &Iteration::switches,
             &Iteration::neighbours, &Iteration::sequence);
}

void bind_report(py::module_& m) {
  bind_enum<PlanFrom>(m);
  py::class_<Report> report(m, "Report", "How a solve went; str() tells it in a few lines.");
  report.def("__str__", py::overload_cast<const Report&>(&describe));
  report.def_readonly("status", &Report::status);
  report.def_readonly("message", &Report::message);
  report.def_readonly("iterations", &Report::iterations);
  report.def_readonly("switches", &Report::switches);
  report.def_readonly("time_s", &Report::time_s, "Wall clock of the whole solve.");
  report.def_readonly("timing_s", &Report::timing_s, "Wall clock by part.");
  report.def_readonly("cost", &Report::cost);
  report.def_readonly("cost_terms", &Report::cost_terms);
  report.def_readonly("friction_use", &Report::friction_use,
                      "Largest tangential over normal force by end-effector, grasps included.");
  report.def_readonly("worst_violation", &Report::worst_violation, "Largest value / tolerance over all constraints.");
  def_items(report, "warnings", &Report::warnings, "Tuple of Violation: warnings of the checker about the plan.");
  report.def_readonly("plan_from", &Report::plan_from, "Of a replan: where its plan comes from.");
  report.def_readonly("kept_until_s", &Report::kept_until_s,
                      "Of a replan: time [s] until which its plan keeps all limits.");
  report.def_readonly(
      "checked_until_s", &Report::checked_until_s,
      "Of a replan: time [s] until which the checker looked at its plan. What comes later is kept of the "
      "plan before as it was accepted (previous_accepted).");
  def_items(report, "start_violations", &Report::start_violations,
            "Tuple of Violation: of a replan, what the measured state violates by itself, worst first.");
  report.def_readonly("seed", &Report::seed);
  report.def_readonly("threads", &Report::threads);
  report.def_readonly("parallel_loops", &Report::parallel_loops,
                      "Loops over neighbours that were shared out over threads.");
  report.def_readonly("paper_verdict", &Report::paper_verdict,
                      "Of the paper's method: how it ended by its own measures; else empty.");
  report.def_readonly("paper_cost", &Report::paper_cost,
                      "Of the paper's method: its objective at its last iterate, before contacts are made exact.");
  report.def_readonly("version", &Report::version);
  def_items(report, "history", &Report::history, "One Iteration a row.");
  def_value(report, "Report",
            {"status", "message", "iterations", "switches", "time_s", "cost", "cost_terms", "worst_violation", "seed",
             "threads", "version"});
  def_pickle(report, &Report::status, &Report::message, &Report::iterations, &Report::switches, &Report::time_s,
             &Report::timing_s, &Report::cost, &Report::cost_terms, &Report::worst_violation, &Report::warnings,
             &Report::friction_use, &Report::seed, &Report::threads, &Report::parallel_loops, &Report::plan_from,
             &Report::kept_until_s, &Report::checked_until_s, &Report::start_violations, &Report::paper_verdict,
             &Report::paper_cost, &Report::version, &Report::history);

  py::class_<PlanResult> result(m, "PlanResult", "A plan and how it was found.");
  result.def_property_readonly("plan", [](PlanResult& self) -> Plan& { return self.plan; });
  result.def_property_readonly("report", [](PlanResult& self) -> Report& { return self.report; });
  def_value(result, "PlanResult", {"plan", "report"});
  def_pickle(result, &PlanResult::plan, &PlanResult::report);
}

void bind_checker(py::module_& m) {
  bind_fields<Tolerances>(m).def("validate", &Tolerances::validate,
                                 "Raise InvalidOptions naming all that is no number or out of its range.");

  py::class_<CheckResult> result(m, "CheckResult", "The worst place of every constraint, violated or not.");
  def_items(result, "constraints", &CheckResult::constraints, "Tuple of Violation, violated or not.");
  result.def_readonly("complete", &CheckResult::complete, "False: interrupted; what was found by then is listed.");
  def_items(result, "warnings", &CheckResult::warnings, "Tuple of Violation that ok() does not ask for.");
  def_items(result, "start", &CheckResult::start,
            "Tuple of Violation: what the measured start violates by itself, of which ok() does not ask; worst first.");
  result.def_readonly("kept_until_s", &CheckResult::kept_until_s,
                      "Time of the earliest violation [s]; checked_until_s where there is none, 0 where the plan could "
                      "not be evaluated.");
  result.def_readonly("checked_until_s", &CheckResult::checked_until_s, "How far the plan was looked at [s].");
  result.def_readonly("start_slack_s", &CheckResult::start_slack_s, "The plan's [s].");
  result.def("ok", &CheckResult::ok);
  result.def("violations", &CheckResult::violations, "Those beyond their tolerance, worst first.");
  result.def(
      "worst", [](const CheckResult& self) { return self.worst(); }, "Largest value / tolerance, violated or not.");
  result.def(
      "raise_if_violated",
      [](const CheckResult& self) {
        if (self.ok()) return;
        const py::object type = py::module_::import("mcplan.errors").attr("PlanViolated");
        PyErr_SetObject(type.ptr(), type(self.violations()).ptr());
        throw py::error_already_set();
      },
      "Raise PlanViolated naming the worst violation, if there is one.");
  result.def("__str__", [](const CheckResult& self) { return shown(self.to_string()); });
  result.def("__repr__", [](const CheckResult& self) { return "<CheckResult: " + shown(self.to_string()) + ">"; });
  def_pickle(result, &CheckResult::constraints, &CheckResult::complete, &CheckResult::warnings, &CheckResult::start,
             &CheckResult::kept_until_s, &CheckResult::checked_until_s, &CheckResult::start_slack_s);

  m.def(
      "check",
      [](Plan plan, const Scene* own_scene, const Robot* own_robot, Tolerances tolerances, double until_s) {
        const Scene scene = own_scene ? *own_scene : plan.scene;
        const Robot robot = own_robot ? *own_robot : plan.robot;
        return interruptible([&] { return check(plan, scene, robot, tolerances, SignalWatch::stop, until_s); });
      },
      py::arg("plan"), py::arg("scene") = py::none(), py::arg("robot") = py::none(),
      py::arg("tolerances") = Tolerances(), py::arg("until_s") = std::numeric_limits<double>::infinity(),
      "Check a plan against a scene and a robot (None: those it carries), from its positions, forces and polygons "
      "alone, up to until_s [s] where that is before its end. "
      "Raises InvalidPlan when its arrays do not fit together, and Interrupted with what was found by then.");
}

void bind_loads(py::module_& m) {
  py::class_<ContactLoad> load(m, "ContactLoad", "Largest contact force of an end-effector over a plan.");
  load.def_readonly("end_effector", &ContactLoad::end_effector);
  load.def_readonly("force", &ContactLoad::force, "[weights of the robot]");
  load.def_readonly("friction", &ContactLoad::friction, "[-] tangential over normal force, infinite for a pull.");
  def_value(load, "ContactLoad", {"end_effector", "force", "friction"});
  py::class_<Loads> loads_class(m, "PlanLoads", "Largest loads over a plan.");
  loads_class.def_readonly("angular_momentum", &Loads::angular_momentum, "About the CoM [kg m^2/s].");
  def_items(loads_class, "contacts", &Loads::contacts, "Tuple of ContactLoad, the first to touch something first.");
  def_value(loads_class, "PlanLoads", {"angular_momentum", "contacts"});
  m.def("plan_loads", &loads, py::arg("plan"), py::arg("sample_s") = 0.005,
        "Largest values over the whole plan, looked at least every sample_s [s]. Raises InvalidPlan, InvalidOptions.");
}

}  // namespace

void bind_plan(py::module_& m) {
  bind_named_types<ForceLaw>(m);
  bind_parts(m);
  bind_state(m);
  bind_plan_class(m);
  bind_violation(m);
  bind_iteration(m);
  bind_report(m);
  bind_checker(m);
  bind_loads(m);
}

}  // namespace mcplan::bindings
