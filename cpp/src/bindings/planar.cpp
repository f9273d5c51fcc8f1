#include "fields.hpp"
#include "mcplan/planar/robot.hpp"
#include "mcplan/planar/task.hpp"
#include "planar/task_fields.hpp"

namespace mcplan::bindings {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

void bind_planar_robot(py::module_& m) {
  bind_fields<Capsule>(m);
  bind_fields<PlanarBody>(m);
  bind_fields<PlanarEndEffector>(m);
  py::class_<PlanarRobot> robot = bind_fields<PlanarRobot>(m);
  robot.def("joint_count", &PlanarRobot::joint_count);
  robot.def("mass", &PlanarRobot::mass, "[kg]");
  robot.def("body_index", &PlanarRobot::body_index, py::arg("name"), "Index of a body, or -1.");
  robot.def("end_effector_index", &PlanarRobot::end_effector_index, py::arg("who"), "Index of an end-effector, or -1.");
  robot.def(
      "joints_to",
      [](const PlanarRobot& self, int body) {
        self.validate();
        if (body < 0 || body >= static_cast<int>(self.bodies.size()))
          throw InvalidInput("body", "must be the index of a body", text(body));
        return self.joints_to(body);
      },
      py::arg("body"), "Joints between the base and a body, base first.");
  robot.def("validate", &PlanarRobot::validate, "Raise InvalidRobot naming all that is out of its range.");
}

void bind_configuration(py::module_& m) {
  const Vector3d zero = Vector3d::Zero();
  const VectorXd none;
  py::class_<PlanarConfiguration> x(m, "PlanarConfiguration", "Position, velocity, acceleration of base and joints.");
  x.def(py::init([](const Vector3d& base, const Vector3d& base_velocity, const Vector3d& base_acceleration,
                    const VectorXd& q, const VectorXd& velocity, const VectorXd& acceleration) {
          return PlanarConfiguration{base, base_velocity, base_acceleration, q, velocity, acceleration};
        }),
        py::kw_only(), py::arg("base") = zero, py::arg("base_velocity") = zero, py::arg("base_acceleration") = zero,
        py::arg("q") = none, py::arg("velocity") = none, py::arg("acceleration") = none);
  def_vector(x, "base", &PlanarConfiguration::base, "x, y [m], angle [rad] in the world.");
  def_vector(x, "base_velocity", &PlanarConfiguration::base_velocity, "[m/s], [rad/s]");
  def_vector(x, "base_acceleration", &PlanarConfiguration::base_acceleration, "[m/s^2], [rad/s^2]");
  def_matrix(x, "q", &PlanarConfiguration::q, "Joint positions [rad].");
  def_matrix(x, "velocity", &PlanarConfiguration::velocity, "[rad/s]");
  def_matrix(x, "acceleration", &PlanarConfiguration::acceleration, "[rad/s^2]");
  def_value(x, "PlanarConfiguration", {"base", "base_velocity", "base_acceleration", "q", "velocity", "acceleration"});

  py::class_<PlanarMotionOfFrame> frame(m, "PlanarMotionOfFrame", "Where a frame is and how it moves.");
  frame.def_readonly("position_W", &PlanarMotionOfFrame::position_W, "[m]");
  frame.def_readonly("velocity_W", &PlanarMotionOfFrame::velocity_W, "[m/s]");
  frame.def_readonly("acceleration_W", &PlanarMotionOfFrame::acceleration_W, "[m/s^2]");
  frame.def_readonly("angle", &PlanarMotionOfFrame::angle, "[rad]");
  frame.def_readonly("rate", &PlanarMotionOfFrame::rate, "[rad/s]");
  frame.def_readonly("angular_acceleration", &PlanarMotionOfFrame::angular_acceleration, "[rad/s^2]");
  def_value(frame, "PlanarMotionOfFrame",
            {"position_W", "velocity_W", "acceleration_W", "angle", "rate", "angular_acceleration"});

  py::class_<PlanarForce> force(m, "PlanarForce", "A force of the environment on the robot at a point of a body.");
  force.def(py::init([](int body, const Vector2d& point_W, const Vector2d& force_W) {
              return PlanarForce{body, point_W, force_W};
            }),
            py::kw_only(), py::arg("body"), py::arg("point_W"), py::arg("force_W"));
  force.def_readwrite("body", &PlanarForce::body, "Index of the body.");
  def_vector(force, "point_W", &PlanarForce::point_W, "[m]");
  def_vector(force, "force_W", &PlanarForce::force_W, "[N]");
  def_value(force, "PlanarForce", {"body", "point_W", "force_W"});

  py::class_<PlanarInverseDynamics> dynamics(m, "PlanarInverseDynamics", "Torques, and what is left over at the base.");
  dynamics.def_readonly("torque", &PlanarInverseDynamics::torque, "Of the joints [N m].");
  dynamics.def_readonly("base_residual", &PlanarInverseDynamics::base_residual,
                        "Force x, y [N] and moment about the base's origin [N m] that nothing carries.");
  def_value(dynamics, "PlanarInverseDynamics", {"torque", "base_residual"});
}

/// Sizes that the functions below rely on.
void require_fit(const PlanarRobot& robot, const PlanarConfiguration& x) {
  robot.validate();
  const Eigen::Index joints = robot.joint_count();
  for (const auto& [field, vector] : {std::pair<const char*, const VectorXd*>{"configuration.q", &x.q},
                                      {"configuration.velocity", &x.velocity},
                                      {"configuration.acceleration", &x.acceleration}})
    if (vector->size() != joints)
      throw InvalidInput(field, "must have an entry for each joint (" + std::to_string(joints) + ")",
                         std::to_string(vector->size()));
}

void bind_dynamics(py::module_& m) {
  m.def(
      "planar_kinematics",
      [](const PlanarRobot& robot, const PlanarConfiguration& x) {
        require_fit(robot, x);
        return planar_kinematics(robot, x);
      },
      py::arg("robot"), py::arg("configuration"), "Frames of all bodies: a list of PlanarMotionOfFrame.");
  m.def("planar_point", &planar_point, py::arg("body"), py::arg("point_B"), py::arg("angle_B") = 0.0,
        "A point of a body, in the body's frame [m]; angle_B [rad] is added to the body's.");
  m.def(
      "planar_inverse_dynamics",
      [](const PlanarRobot& robot, const PlanarConfiguration& x, const std::vector<PlanarForce>& forces) {
        require_fit(robot, x);
        for (const PlanarForce& force : forces)
          if (force.body < 0 || force.body >= static_cast<int>(robot.bodies.size()))
            throw InvalidInput("forces", "must name a body", text(force.body));
        return planar_inverse_dynamics(robot, x, forces);
      },
      py::arg("robot"), py::arg("configuration"), py::arg("forces") = std::vector<PlanarForce>(),
      "Torques [N m] by the recursive Newton-Euler algorithm, and what is left over at the base.");
}

void bind_task(py::module_& m) {
  py::class_<PlanarSurface> surface = bind_fields<PlanarSurface>(m);
  surface.def_property_readonly("tangent_W", &PlanarSurface::tangent_W, "Unit vector.");
  surface.def_property_readonly("normal_W", &PlanarSurface::normal_W, "Unit vector, outward.");
  bind_fields<PlanarContact>(m);
  bind_fields<PlanarNoClearance>(m);
  bind_fields<PlanarClearance>(m);
  bind_fields<PlanarPose>(m);
  bind_fields<PlanarPhase>(m);
  py::class_<PlanarTask> task = bind_fields<PlanarTask>(m);
  task.def("interval_count", &PlanarTask::interval_count, "Of all phases.");
  task.def(
      "first_interval",
      [](const PlanarTask& self, int k) {
        if (k < 0 || k > static_cast<int>(self.phases.size()))
          throw InvalidInput("phase", "must lie in [0, " + std::to_string(self.phases.size()) + "]", text(k));
        return self.first_interval(k);
      },
      py::arg("phase"), "Index of the first interval of a phase.");
  task.def(
      "phase_of",
      [](const PlanarTask& self, int interval) {
        if (interval < 0 || interval >= self.interval_count())
          throw InvalidInput("interval", "must lie in [0, " + text(self.interval_count() - 1) + "]", text(interval));
        return self.phase_of(interval);
      },
      py::arg("interval"), "Phase that an interval belongs to.");
  task.def("validate", &PlanarTask::validate,
           "Raise InvalidPlanarTask (InvalidRobot for the robot) naming all that is out of its range.");
}

}  // namespace

void bind_planar(py::module_& m) {
  bind_planar_robot(m);
  bind_configuration(m);
  bind_dynamics(m);
  bind_task(m);
}

}  // namespace mcplan::bindings
