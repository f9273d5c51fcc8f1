#include "bindings.hpp"
#include "mcplan/planar/robot.hpp"
#include "mcplan/planar/task.hpp"

namespace mcplan::bindings {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

void bind_bodies(py::module_& m) {
  py::class_<Capsule> capsule(m, "Capsule",
                              "Segment with a radius, in a body's frame: its looks, and what it collides with.");
  capsule.def(py::init([](const Vector2d& from_B, const Vector2d& to_B, double radius) {
                return Capsule{from_B, to_B, radius};
              }),
              py::kw_only(), py::arg("from_B") = Vector2d(Vector2d::Zero()),
              py::arg("to_B") = Vector2d(Vector2d::Zero()), py::arg("radius") = 0.0);
  def_vector(capsule, "from_B", &Capsule::from_B, "[m]");
  def_vector(capsule, "to_B", &Capsule::to_B, "[m]");
  capsule.def_readwrite("radius", &Capsule::radius, "[m]");
  def_value(capsule, "Capsule", {"from_B", "to_B", "radius"});

  const PlanarBody d;
  py::class_<PlanarBody> body(m, "PlanarBody",
                              "A rigid body of a planar robot and the revolute joint that carries it. Its frame B has "
                              "its origin at the joint, turned by offset + q against its parent's.");
  body.def(py::init([](std::string name, int parent, const Vector2d& joint_P, double offset, double mass,
                       const Vector2d& com_B, double inertia, double position_min, double position_max,
                       double velocity_max, double torque_max, std::vector<Capsule> capsules) {
             return PlanarBody{
                 std::move(name), parent,       joint_P,      offset,       mass,       com_B,
                 inertia,         position_min, position_max, velocity_max, torque_max, std::move(capsules)};
           }),
           py::kw_only(), py::arg("name") = d.name, py::arg("parent") = d.parent, py::arg("joint_P") = d.joint_P,
           py::arg("offset") = d.offset, py::arg("mass") = d.mass, py::arg("com_B") = d.com_B,
           py::arg("inertia") = d.inertia, py::arg("position_min") = d.position_min,
           py::arg("position_max") = d.position_max, py::arg("velocity_max") = d.velocity_max,
           py::arg("torque_max") = d.torque_max, py::arg("capsules") = d.capsules);
  body.def_readwrite("name", &PlanarBody::name);
  body.def_readwrite("parent", &PlanarBody::parent, "An earlier body; -1 for the base alone.");
  def_vector(body, "joint_P", &PlanarBody::joint_P, "Joint in the parent's frame [m].");
  body.def_readwrite("offset", &PlanarBody::offset, "Angle against the parent at q = 0 [rad].");
  body.def_readwrite("mass", &PlanarBody::mass, "[kg]");
  def_vector(body, "com_B", &PlanarBody::com_B, "[m]");
  body.def_readwrite("inertia", &PlanarBody::inertia, "About the CoM [kg m^2].");
  body.def_readwrite("position_min", &PlanarBody::position_min, "Of the joint [rad].");
  body.def_readwrite("position_max", &PlanarBody::position_max, "[rad]");
  body.def_readwrite("velocity_max", &PlanarBody::velocity_max, "[rad/s]");
  body.def_readwrite("torque_max", &PlanarBody::torque_max, "[N m]");
  def_items(body, "capsules", &PlanarBody::capsules, "Tuple of Capsule.");
  def_value(body, "PlanarBody",
            {"name", "parent", "joint_P", "offset", "mass", "com_B", "inertia", "position_min", "position_max",
             "velocity_max", "torque_max", "capsules"});

  py::class_<PlanarEndEffector> end(m, "PlanarEndEffector",
                                    "A contact frame of a body: x axis in the sole, y axis from the ground into the "
                                    "robot. Forces act at points of the sole.");
  end.def(py::init([](std::string name, int body_index, const Vector2d& position_B, double angle_B,
                      std::vector<double> points) {
            return PlanarEndEffector{std::move(name), body_index, position_B, angle_B, std::move(points)};
          }),
          py::kw_only(), py::arg("name") = "", py::arg("body") = 0, py::arg("position_B") = Vector2d(Vector2d::Zero()),
          py::arg("angle_B") = 0.0, py::arg("points") = std::vector<double>());
  end.def_readwrite("name", &PlanarEndEffector::name);
  end.def_readwrite("body", &PlanarEndEffector::body, "Index of its body.");
  def_vector(end, "position_B", &PlanarEndEffector::position_B, "Of the frame's origin [m].");
  end.def_readwrite("angle_B", &PlanarEndEffector::angle_B, "Of its x axis [rad].");
  def_names(end, "points", &PlanarEndEffector::points, "Where forces act, along the x axis [m].");
  def_value(end, "PlanarEndEffector", {"name", "body", "position_B", "angle_B", "points"});
}

void bind_planar_robot(py::module_& m) {
  using Pairs = std::vector<std::pair<int, int>>;
  const PlanarRobot d;
  py::class_<PlanarRobot> robot(
      m, "PlanarRobot", "A planar tree of rigid bodies on a free base; x forward, y up. Joint j moves body j + 1.");
  robot.def(py::init([](std::string name, std::string description, std::vector<PlanarBody> bodies,
                        std::vector<PlanarEndEffector> end_effectors, Pairs collision_pairs, double gravity) {
              return PlanarRobot{std::move(name),          std::move(description),     std::move(bodies),
                                 std::move(end_effectors), std::move(collision_pairs), gravity};
            }),
            py::kw_only(), py::arg("name") = "", py::arg("description") = "", py::arg("bodies") = d.bodies,
            py::arg("end_effectors") = d.end_effectors, py::arg("collision_pairs") = d.collision_pairs,
            py::arg("gravity") = d.gravity);
  robot.def_readwrite("name", &PlanarRobot::name);
  robot.def_readwrite("description", &PlanarRobot::description);
  def_items(robot, "bodies", &PlanarRobot::bodies, "Tuple of PlanarBody, the base first.");
  def_items(robot, "end_effectors", &PlanarRobot::end_effectors, "Tuple of PlanarEndEffector.");
  def_names(robot, "collision_pairs", &PlanarRobot::collision_pairs, "Bodies whose capsules may not touch.");
  robot.def_readwrite("gravity", &PlanarRobot::gravity, "Along -y [m/s^2].");
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
  robot.def("validate", &PlanarRobot::validate, "Raise InvalidRobot naming the first field out of its range.");
  def_value(robot, "PlanarRobot", {"name", "description", "bodies", "end_effectors", "collision_pairs", "gravity"});
  def_pickle(robot, "mcplan.files.planar_data", "robot_to_plain", "robot_from_plain");
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

void bind_ground(py::module_& m) {
  const PlanarSurface s;
  py::class_<PlanarSurface> surface(m, "PlanarSurface",
                                    "A straight piece of the ground or of a wall. Its outward normal is 90 degrees to "
                                    "the left of its tangent; what lies behind is solid.");
  surface.def(py::init([](std::string name, const Vector2d& origin_W, double angle, double friction, double from,
                          double to) { return PlanarSurface{std::move(name), origin_W, angle, friction, from, to}; }),
              py::kw_only(), py::arg("name") = s.name, py::arg("origin_W") = s.origin_W, py::arg("angle") = s.angle,
              py::arg("friction") = s.friction, py::arg("from_") = s.from, py::arg("to") = s.to);
  surface.def_readwrite("name", &PlanarSurface::name);
  def_vector(surface, "origin_W", &PlanarSurface::origin_W, "[m]");
  surface.def_readwrite("angle", &PlanarSurface::angle, "Of its tangent [rad].");
  surface.def_readwrite("friction", &PlanarSurface::friction, "Coefficient [-].");
  surface.def_readwrite("from_", &PlanarSurface::from, "Extent along the tangent, from the origin [m].");
  surface.def_readwrite("to", &PlanarSurface::to, "[m]");
  surface.def_property_readonly("tangent_W", &PlanarSurface::tangent_W, "Unit vector.");
  surface.def_property_readonly("normal_W", &PlanarSurface::normal_W, "Unit vector, outward.");
  def_value(surface, "PlanarSurface", {"name", "origin_W", "angle", "friction", "from_", "to"});

  const PlanarContact c;
  py::class_<PlanarContact> contact(m, "PlanarContact", "An end-effector that stands still on a surface for a phase.");
  contact.def(py::init([](int end_effector, int surface_index, const Vector2d& position_W, double angle) {
                return PlanarContact{end_effector, surface_index, position_W, angle};
              }),
              py::kw_only(), py::arg("end_effector") = 0, py::arg("surface") = 0, py::arg("position_W") = c.position_W,
              py::arg("angle") = 0.0);
  contact.def_readwrite("end_effector", &PlanarContact::end_effector, "Index into robot.end_effectors.");
  contact.def_readwrite("surface", &PlanarContact::surface, "Index into motion.surfaces.");
  def_vector(contact, "position_W", &PlanarContact::position_W, "Of the end-effector's frame [m].");
  contact.def_readwrite("angle", &PlanarContact::angle, "Of its x axis [rad]; whole turns count.");
  def_value(contact, "PlanarContact", {"end_effector", "surface", "position_W", "angle"});

  const PlanarClearance k;
  py::class_<PlanarClearance> clearance(m, "PlanarClearance",
                                        "Points of a swinging end-effector stay outside a surface's solid.");
  clearance.def(py::init([](int end_effector, int surface_index, int first_interval, int end_interval, double height) {
                  return PlanarClearance{end_effector, surface_index, first_interval, end_interval, height};
                }),
                py::kw_only(), py::arg("end_effector") = 0, py::arg("surface") = 0, py::arg("first_interval") = 0,
                py::arg("end_interval") = -1, py::arg("middle_height") = k.middle_height);
  clearance.def_readwrite("end_effector", &PlanarClearance::end_effector, "Index into robot.end_effectors.");
  clearance.def_readwrite("surface", &PlanarClearance::surface, "Index into motion.surfaces.");
  clearance.def_readwrite("first_interval", &PlanarClearance::first_interval, "Of the phase.");
  clearance.def_readwrite("end_interval", &PlanarClearance::end_interval,
                          "One after the last; -1: to the phase's end.");
  clearance.def_readwrite("middle_height", &PlanarClearance::middle_height,
                          "At the begin of interval n / 2 of the phase at least this [m].");
  def_value(clearance, "PlanarClearance",
            {"end_effector", "surface", "first_interval", "end_interval", "middle_height"});

  const PlanarPose p;
  py::class_<PlanarPose> pose(m, "PlanarPose", "A pose that a body has to have at an instant of a phase.");
  pose.def(py::init([](int body, double fraction, const Vector3d& min, const Vector3d& max) {
             return PlanarPose{body, fraction, min, max};
           }),
           py::kw_only(), py::arg("body") = 0, py::arg("fraction") = 0.0, py::arg("min") = p.min,
           py::arg("max") = p.max);
  pose.def_readwrite("body", &PlanarPose::body, "Index into robot.bodies.");
  pose.def_readwrite("fraction", &PlanarPose::fraction, "Of the phase, 0..1.");
  def_vector(pose, "min", &PlanarPose::min, "x, y [m], angle [rad] of the body's frame.");
  def_vector(pose, "max", &PlanarPose::max, "x, y [m], angle [rad]");
  def_value(pose, "PlanarPose", {"body", "fraction", "min", "max"});
}

void bind_motion(py::module_& m) {
  const PlanarPhase d;
  py::class_<PlanarPhase> phase(m, "PlanarPhase", "A stretch of time with constant contacts.");
  phase.def(py::init([](int intervals, double min_duration, double max_duration, std::vector<PlanarContact> contacts,
                        std::vector<PlanarClearance> clearances, std::vector<PlanarPose> poses) {
              return PlanarPhase{intervals,           min_duration,          max_duration,
                                 std::move(contacts), std::move(clearances), std::move(poses)};
            }),
            py::kw_only(), py::arg("intervals") = d.intervals, py::arg("min_duration") = d.min_duration,
            py::arg("max_duration") = d.max_duration, py::arg("contacts") = d.contacts,
            py::arg("clearances") = d.clearances, py::arg("poses") = d.poses);
  phase.def_readwrite("intervals", &PlanarPhase::intervals, "Of the joints' splines.");
  phase.def_readwrite("min_duration", &PlanarPhase::min_duration, "[s]");
  phase.def_readwrite("max_duration", &PlanarPhase::max_duration, "[s]");
  def_items(phase, "contacts", &PlanarPhase::contacts, "Tuple of PlanarContact.");
  def_items(phase, "clearances", &PlanarPhase::clearances, "Tuple of PlanarClearance.");
  def_items(phase, "poses", &PlanarPhase::poses, "Tuple of PlanarPose.");
  def_value(phase, "PlanarPhase", {"intervals", "min_duration", "max_duration", "contacts", "clearances", "poses"});

  py::class_<PlanarTask> motion(m, "PlanarTask",
                                "A task for whole-body planning: planar robot, ground, sequence of contact stances.");
  motion.def(
      py::init([](std::string name, std::string description, const PlanarRobot& robot,
                  std::vector<PlanarSurface> surfaces, std::vector<PlanarPhase> phases) {
        return PlanarTask{std::move(name), std::move(description), robot, std::move(surfaces), std::move(phases)};
      }),
      py::kw_only(), py::arg("name") = "", py::arg("description") = "", py::arg("robot") = PlanarRobot(),
      py::arg("surfaces") = std::vector<PlanarSurface>(), py::arg("phases") = std::vector<PlanarPhase>());
  motion.def_readwrite("name", &PlanarTask::name);
  motion.def_readwrite("description", &PlanarTask::description);
  def_member(motion, "robot", &PlanarTask::robot, "PlanarRobot.");
  def_items(motion, "surfaces", &PlanarTask::surfaces, "Tuple of PlanarSurface.");
  def_items(motion, "phases", &PlanarTask::phases, "Tuple of PlanarPhase.");
  motion.def("interval_count", &PlanarTask::interval_count, "Of all phases.");
  motion.def(
      "first_interval",
      [](const PlanarTask& self, int k) {
        if (k < 0 || k > static_cast<int>(self.phases.size()))
          throw InvalidInput("phase", "must lie in [0, " + std::to_string(self.phases.size()) + "]", text(k));
        return self.first_interval(k);
      },
      py::arg("phase"), "Index of the first interval of a phase.");
  motion.def(
      "phase_of",
      [](const PlanarTask& self, int interval) {
        if (interval < 0 || interval >= self.interval_count())
          throw InvalidInput("interval", "must lie in [0, " + text(self.interval_count() - 1) + "]", text(interval));
        return self.phase_of(interval);
      },
      py::arg("interval"), "Phase that an interval belongs to.");
  motion.def("validate", &PlanarTask::validate,
             "Raise InvalidMotion (InvalidRobot for the robot) naming the first field out of its range.");
  def_value(motion, "PlanarTask", {"name", "description", "robot", "surfaces", "phases"});
  def_pickle(motion, "mcplan.files.planar_data", "motion_to_plain", "motion_from_plain");
}

}  // namespace

void bind_planar(py::module_& m) {
  bind_bodies(m);
  bind_planar_robot(m);
  bind_configuration(m);
  bind_dynamics(m);
  bind_ground(m);
  bind_motion(m);
}

}  // namespace mcplan::bindings
