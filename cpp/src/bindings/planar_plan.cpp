#include "mcplan/planar/plan.hpp"

#include "fields.hpp"
#include "mcplan/planar/checker.hpp"
#include "named_types.hpp"
#include "planar/plan_fields.hpp"
#include "planar/tolerances_fields.hpp"
#include "signals.hpp"

template <>
struct pybind11::detail::type_caster<mcplan::PlanarForceLaw>
    : mcplan::bindings::NamedTypeCaster<mcplan::PlanarForceLaw> {};

namespace mcplan::bindings {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void bind_state(py::module_& m) {
  py::class_<PlanarPointForce> force(m, "PlanarPointForce", "Contact force at one point of an end-effector.");
  force.def_readonly("contact", &PlanarPointForce::contact, "Index into the phase's contacts.");
  force.def_readonly("end_effector", &PlanarPointForce::end_effector, "Index into robot.end_effectors.");
  force.def_readonly("surface", &PlanarPointForce::surface, "Index into task.surfaces.");
  force.def_readonly("point", &PlanarPointForce::point, "Index into the end-effector's points.");
  force.def_readonly("position_W", &PlanarPointForce::position_W, "Actual place of the point [m].");
  force.def_readonly("force_W", &PlanarPointForce::force_W, "On the robot [N].");
  force.def_readonly("tangential", &PlanarPointForce::tangential, "Along the surface [N].");
  force.def_readonly("normal", &PlanarPointForce::normal, "Away from the surface [N].");
  def_value(force, "PlanarPointForce",
            {"contact", "end_effector", "surface", "point", "position_W", "force_W", "tangential", "normal"});

  py::class_<PlanarState> state(m, "PlanarState", "A planar robot at an instant.");
  state.def_readonly("time", &PlanarState::time, "[s]");
  state.def_readonly("phase", &PlanarState::phase);
  state.def_readonly("configuration", &PlanarState::configuration,
                     "PlanarConfiguration: position, velocity, acceleration of base and joints.");
  state.def_readonly("torque", &PlanarState::torque, "Of the joints [N m].");
  state.def_readonly("base_residual", &PlanarState::base_residual,
                     "Force x, y [N] and moment [N m] at the base that nothing carries.");
  def_items(state, "forces", &PlanarState::forces, "Tuple of PlanarPointForce.");
  state.def_property_readonly(
      "contact_error", [](py::object self) { return points_view(self.cast<PlanarState&>().contact_error, self); },
      "A row for each contact: actual minus expected x, y [m], angle [rad].");
  state.def_readonly("com_W", &PlanarState::com_W, "[m]");
  state.def_readonly("com_velocity_W", &PlanarState::com_velocity_W, "[m/s]");
  state.def_readonly("angular_momentum", &PlanarState::angular_momentum, "About the CoM [kg m^2/s].");
  def_value(state, "PlanarState",
            {"time", "phase", "configuration", "torque", "base_residual", "forces", "contact_error", "com_W",
             "com_velocity_W", "angular_momentum"});

  bind_named_types<PlanarForceLaw>(m);
}

std::string describe(const PlanarPlan& plan) {
  return "<PlanarPlan of " + shown(plan.task.robot.name) + ", " + shown(plan.task.name) + ": " +
         std::to_string(plan.durations.size()) + " phases, " + text(plan.duration()) + " s>";
}

void bind_plan_class(py::module_& m) {
  py::class_<PlanarPlan> plan = bind_fields<PlanarPlan>(m);  // its repr is not what could be pasted back
  plan.def("duration", &PlanarPlan::duration, "[s]");
  plan.def("knot_times", &PlanarPlan::knot_times, "[s] phase boundaries, phases + 1 entries, from 0.");
  plan.def("interval_lengths", &PlanarPlan::interval_lengths,
           "[s] Raises InvalidPlanarTask for phases of no or too many intervals.");
  plan.def("at", &PlanarPlan::at, py::arg("t"),
           "PlanarState at time t [s] in [0, duration], in closed form. At a boundary the phase that begins there "
           "is meant (the last one at the end). Raises InvalidInput outside.");
  plan.def("at_phase", &PlanarPlan::at_phase, py::arg("k"), py::arg("since_start"),
           "PlanarState `since_start` [s] after the start of phase k: says which side of a boundary is meant.");
  plan.def("validate", &PlanarPlan::validate,
           "Raise InvalidPlan when sizes do not fit together, a duration or weight is not positive or a number is not "
           "finite; InvalidPlanarTask and InvalidRobot for the task.");
  plan.def("__repr__", &describe, py::prepend());
}

void bind_functions(py::module_& m) {
  const auto require_phase = [](const PlanarTask& task, int phase) {
    task.validate();
    if (phase < 0 || phase >= static_cast<int>(task.phases.size()))
      throw InvalidInput("phase", "must lie in [0, " + std::to_string(task.phases.size() - 1) + "]", text(phase));
  };
  m.def(
      "least_norm_gain",
      [require_phase](const PlanarTask& task, int phase, const VectorXd& weights) {
        require_phase(task, phase);
        return least_norm_gain(task, phase, weights);
      },
      py::arg("task"), py::arg("phase"), py::arg("weights"),
      "(2 points) x 3: gain from [m (a - g); moment about moment_point_W] to the forces (tangential, normal) of all "
      "points of a phase.");
  m.def(
      "moment_point_W",
      [require_phase](const PlanarTask& task, int phase) {
        require_phase(task, phase);
        return moment_point_W(task, phase);
      },
      py::arg("task"), py::arg("phase"), "Mean of the phase's expected points [m].");
}

void bind_checker(py::module_& m) {
  bind_fields<PlanarTolerances>(m).def("validate", &PlanarTolerances::validate,
                                       "Raise InvalidOptions naming all that is no number or out of its range.");

  m.def(
      "check",
      [](PlanarPlan plan, PlanarTolerances tolerances, bool self_collision) {
        return interruptible([&] { return check(plan, tolerances, self_collision, SignalWatch::stop); });
      },
      py::arg("plan"), py::arg("tolerances") = PlanarTolerances(), py::arg("self_collision") = false,
      "Check a planar plan from its splines with exact kinematics and dynamics. Raises InvalidPlan, InvalidPlanarTask "
      "or InvalidRobot where it is malformed, and Interrupted with what was found by then.");

  py::class_<Drift> drift(m, "Drift", "Largest distance and angle of a contact from where it should be.");
  drift.def_readonly("position_m", &Drift::position_m, "[m]");
  drift.def_readonly("angle_rad", &Drift::angle_rad, "[rad]");
  def_value(drift, "Drift", {"position_m", "angle_rad"});
  m.def("largest_drift", &largest_drift, py::arg("plan"), py::arg("sample_s") = 1e-3,
        "Drift of a planar plan, from samples in time and exact kinematics.");

  py::class_<SolidDepth> depth(m, "SolidDepth",
                               "How deep a swinging end-effector goes into the solid behind a surface at most.");
  depth.def_readonly("end_effector", &SolidDepth::end_effector, "Index.");
  depth.def_readonly("surface", &SolidDepth::surface, "Index.");
  depth.def_readonly("depth_m", &SolidDepth::depth_m, "The shortest way out [m]; negative: how far it stays out.");
  depth.def_readonly("phase", &SolidDepth::phase, "Where that is.");
  depth.def_readonly("time_s", &SolidDepth::time_s, "When that is [s].");
  depth.def_readonly("asked", &SolidDepth::asked, "False where the task's no_clearance has the pair.");
  def_value(depth, "SolidDepth", {"end_effector", "surface", "depth_m", "phase", "time_s", "asked"});
  m.def("solid_depths", &solid_depths, py::arg("plan"), py::arg("sample_s") = 1e-3,
        "How deep every swinging end-effector of a planar plan goes into the solid of every surface, from samples in "
        "time "
        "and exact kinematics; also of the pairs in the task's no_clearance.");
}

}  // namespace

void bind_planar_plan(py::module_& m) {
  bind_state(m);
  bind_plan_class(m);
  bind_functions(m);
  bind_checker(m);
}

}  // namespace mcplan::bindings
