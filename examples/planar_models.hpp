// The planar robot and the motion that the C++ examples share. The same numbers stand in python/mcplan/data, which only
// the Python package reads.

#pragma once

#include <cmath>
#include <mcplan/mcplan.hpp>
#include <string>

namespace examples {

/// A joint with a body that hangs down from it by `length` [m].
inline mcplan::PlanarBody link(const std::string& name, int parent, double length, double mass, double offset) {
  mcplan::PlanarBody out;
  out.name = name;
  out.parent = parent;
  out.offset = offset;
  out.mass = mass;
  out.com_B = {0.0, -0.5 * length};
  out.inertia = mass * length * length / 12.0;
  out.velocity_max = 6.0;
  return out;
}

/// Adds a limb of two links and a foot to the hub, which it leaves at `angle` [rad] from down; `bend` is the sign of
/// its knee, which is bent by 0.7 rad in the zero posture.
inline void add_limb(mcplan::PlanarRobot& robot, const std::string& name, double angle, double bend) {
  const int first = static_cast<int>(robot.bodies.size());
  mcplan::PlanarBody upper = link(name + "_upper", 0, 0.4, 3.0, angle + 0.35 * bend);
  upper.joint_P = {0.1 * std::sin(angle), -0.1 * std::cos(angle)};
  upper.position_min = -1.7;
  upper.position_max = 1.7;
  upper.torque_max = 150.0;
  mcplan::PlanarBody lower = link(name + "_lower", first, 0.4, 2.0, -0.7 * bend);
  lower.joint_P = {0.0, -0.4};
  lower.position_min = -2.2;
  lower.position_max = 2.2;
  lower.torque_max = 150.0;
  mcplan::PlanarBody foot = link(name + "_foot", first + 1, 0.06, 0.5, 0.35 * bend);
  foot.joint_P = {0.0, -0.4};
  foot.inertia = 0.002;
  foot.position_min = -1.5;
  foot.position_max = 1.5;
  foot.torque_max = 80.0;
  for (const auto& body : {upper, lower, foot}) robot.bodies.push_back(body);
  mcplan::PlanarEndEffector end;
  end.name = name;
  end.body = first + 2;
  end.position_B = {0.0, -0.06};
  end.points = {-0.08, 0.08};
  robot.end_effectors.push_back(end);
}

/// Three equal limbs on a hub, 24.5 kg.
inline mcplan::PlanarRobot climber9() {
  const double third = 2.0 * std::acos(-1.0) / 3.0;
  mcplan::PlanarRobot robot;
  robot.name = "climber9";
  mcplan::PlanarBody hub;
  hub.name = "hub";
  hub.mass = 8.0;
  hub.inertia = 0.08;
  robot.bodies = {hub};
  add_limb(robot, "A", -0.5 * third, -1.0);
  add_limb(robot, "B", 0.5 * third, 1.0);
  add_limb(robot, "C", 1.5 * third, 1.0);
  return robot;
}

/// The robot wheels over limb B: A leaves the ground behind, C comes down ahead.
inline mcplan::PlanarTask cartwheel() {
  mcplan::PlanarTask motion;
  motion.name = "cartwheel";
  motion.robot = climber9();
  mcplan::PlanarSurface ground;
  ground.name = "ground";
  ground.friction = 2.0;
  motion.surfaces = {ground};
  const auto standing = [](int end_effector, double x) {
    mcplan::PlanarContact contact;
    contact.end_effector = end_effector;
    contact.position_W = {x, 0.0};
    return contact;
  };
  mcplan::PlanarPhase begin, middle, end;
  begin.intervals = end.intervals = 3;
  middle.intervals = 4;
  begin.contacts = {standing(0, 0.0), standing(1, 0.7)};
  middle.contacts = {standing(1, 0.7)};
  end.contacts = {standing(1, 0.7), standing(2, 1.4)};
  for (const int swinging : {0, 2}) {
    mcplan::PlanarClearance clearance;
    clearance.end_effector = swinging;
    clearance.middle_height = 0.0;
    middle.clearances.push_back(clearance);
  }
  motion.phases = {begin, middle, end};
  return motion;
}

}  // namespace examples
