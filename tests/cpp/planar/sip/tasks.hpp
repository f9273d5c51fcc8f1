#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "mcplan/planar/sip/options.hpp"
#include "mcplan/planar/task.hpp"
#include "planar/sip/layout.hpp"

/// The robots and tasks of Lengagne et al., and random parameters for them. (A smaller robot: planar/robots.hpp.)
namespace planar_tasks {

using Eigen::Vector2d;
using mcplan::PlanarBody;
using mcplan::PlanarContact;
using mcplan::PlanarPhase;
using mcplan::PlanarRobot;
using mcplan::PlanarTask;

inline PlanarBody link(const std::string& name, int parent, const Vector2d& joint_P, double offset, double mass,
                       const Vector2d& com_B, double inertia, double from, double to, double torque) {
  PlanarBody out;
  out.name = name;
  out.parent = parent;
  out.joint_P = joint_P;
  out.offset = offset;
  out.mass = mass;
  out.com_B = com_B;
  out.inertia = inertia;
  out.position_min = from;
  out.position_max = to;
  out.velocity_max = 6.0;
  out.torque_max = torque;
  return out;
}

inline PlanarBody base(const std::string& name, double mass, const Vector2d& com_B, double inertia) {
  PlanarBody out;
  out.name = name;
  out.mass = mass;
  out.com_B = com_B;
  out.inertia = inertia;
  return out;
}

/// A hub with three equal limbs A, B, C of three joints; shins of different limbs must not touch.
inline PlanarRobot climber() {
  PlanarRobot robot;
  robot.name = "climber";
  robot.bodies = {base("hub", 8.0, {0.0, 0.0}, 0.08)};
  const double direction[] = {-M_PI / 3.0, M_PI / 3.0, M_PI}, bend[] = {-1.0, 1.0, 1.0};
  for (int limb = 0; limb < 3; ++limb) {
    const std::string name(1, static_cast<char>('A' + limb));
    const double a = direction[limb], sign = bend[limb];
    const int upper = static_cast<int>(robot.bodies.size());
    robot.bodies.push_back(link(name + "_upper", 0, {0.1 * std::sin(a), -0.1 * std::cos(a)}, a + sign * 0.35, 3.0,
                                {0.0, -0.2}, 0.04, -1.7, 1.7, 150.0));
    robot.bodies.push_back(link(name + "_lower", upper, {0.0, -0.4}, -sign * 0.7, 2.0, {0.0, -0.2}, 0.02666666666666667,
                                -2.2, 2.2, 150.0));
    robot.bodies.push_back(
        link(name + "_foot", upper + 1, {0.0, -0.4}, sign * 0.35, 0.5, {0.0, -0.03}, 0.002, -1.5, 1.5, 80.0));
    robot.bodies[upper + 1].capsules = {{{0.0, 0.0}, {0.0, -0.4}, 0.04}};
    robot.end_effectors.push_back({name, upper + 2, {0.0, -0.06}, 0.0, {-0.08, 0.08}});
  }
  robot.collision_pairs = {{2, 5}, {2, 8}, {5, 8}};
  return robot;
}

/// A biped seen from the side: two legs, a torso, two arms of one joint.
inline PlanarRobot walker() {
  PlanarRobot robot;
  robot.name = "walker";
  robot.bodies = {base("pelvis", 8.0, {0.0, 0.05}, 0.06)};
  for (const std::string side : {"left", "right"}) {
    const int thigh = static_cast<int>(robot.bodies.size());
    robot.bodies.push_back(link(side + "_thigh", 0, {0.0, 0.0}, 0.3, 5.0, {0.0, -0.2}, 0.07, -1.2, 1.2, 200.0));
    robot.bodies.push_back(link(side + "_shin", thigh, {0.0, -0.4}, -0.6, 3.5, {0.0, -0.2}, 0.05, -1.8, 0.55, 200.0));
    robot.bodies.push_back(
        link(side + "_foot", thigh + 1, {0.0, -0.4}, 0.3, 1.2, {0.03, -0.04}, 0.005, -0.9, 0.9, 120.0));
    robot.end_effectors.push_back({side + "_foot", thigh + 2, {0.0, -0.08}, 0.0, {-0.08, 0.14}});
  }
  robot.bodies.push_back(link("torso", 0, {0.0, 0.1}, 0.0, 16.0, {0.0, 0.25}, 0.5, -0.5, 0.8, 150.0));
  for (const std::string side : {"left", "right"})
    robot.bodies.push_back(link(side + "_arm", 7, {0.0, 0.45}, 0.0, 2.5, {0.0, -0.25}, 0.06, -1.5, 1.5, 50.0));
  return robot;
}

inline mcplan::PlanarSurface surface(const std::string& name, const Vector2d& origin_W, double angle) {
  mcplan::PlanarSurface out;
  out.name = name;
  out.origin_W = origin_W;
  out.angle = angle;
  out.friction = 2.0;
  return out;
}

/// A phase with these contacts: three intervals at the ends of a task, four between.
inline void add_phase(PlanarTask& task, std::vector<PlanarContact> contacts, int intervals = 4) {
  PlanarPhase phase;
  phase.intervals = intervals;
  phase.contacts = std::move(contacts);
  task.phases.push_back(phase);
}

/// Motion 1: limb A goes up, the robot wheels over limb B, limb C comes down.
inline PlanarTask cartwheel() {
  PlanarTask task;
  task.name = "cartwheel";
  task.robot = climber();
  task.surfaces = {surface("ground", {0.0, 0.0}, 0.0)};
  const PlanarContact a{0, 0, {0.0, 0.0}, 0.0}, b{1, 0, {0.7, 0.0}, 0.0}, c{2, 0, {1.4, 0.0}, 0.0};
  add_phase(task, {a, b}, 3);
  add_phase(task, {b});
  add_phase(task, {b, c}, 3);
  task.phases[1].clearances = {{0, 0, 0, -1, 0.0}, {2, 0, 0, -1, 0.0}};
  return task;
}

/// Motion 2: up a slope of 30 degrees with a wall behind; nine phases.
inline PlanarTask climbing() {
  PlanarTask task;
  task.name = "climbing";
  task.robot = climber();
  task.surfaces = {surface("slope", {0.0, 0.0}, M_PI / 6.0), surface("wall", {-0.45, 0.0}, -M_PI / 2.0)};
  const Vector2d up = task.surfaces[0].tangent_W();
  PlanarContact a{0, 0, {0.0, 0.0}, M_PI / 6.0}, b{1, 0, 0.6 * up, M_PI / 6.0};
  PlanarContact c{2, 1, {-0.45, 0.85}, 1.5 * M_PI};
  add_phase(task, {a, b, c}, 3);
  add_phase(task, {a, c});
  b.position_W = 0.85 * up;
  add_phase(task, {a, b, c});
  add_phase(task, {b, c});
  a.position_W = 0.3 * up;
  add_phase(task, {a, b, c});
  add_phase(task, {a, b});
  c.position_W.y() = 1.1;
  add_phase(task, {a, b, c});
  add_phase(task, {a, c});
  b.position_W = 1.1 * up;
  add_phase(task, {a, b, c}, 3);
  return task;
}

/// Motion 3: four steps of 0.30 m on level ground; nine phases.
inline PlanarTask walking() {
  PlanarTask task;
  task.name = "walking";
  task.robot = walker();
  task.surfaces = {surface("ground", {0.0, 0.0}, 0.0)};
  PlanarContact feet[] = {{0, 0, {0.0, 0.0}, 0.0}, {1, 0, {0.0, 0.0}, 0.0}};
  add_phase(task, {feet[0], feet[1]}, 3);
  for (int step = 0; step < 4; ++step) {
    PlanarContact &stands = feet[step % 2], &swings = feet[1 - step % 2];
    add_phase(task, {stands});
    task.phases.back().clearances = {{swings.end_effector, 0, 0, -1, 0.03}};
    swings.position_W.x() = 0.3 * (step + 1);
    add_phase(task, {feet[0], feet[1]}, step == 3 ? 3 : 4);
  }
  return task;
}

inline PlanarTask paper_task(int number) { return number == 1 ? cartwheel() : number == 2 ? climbing() : walking(); }

/// Parameters of no particular motion: postures about zero, intervals of 0.1 to 0.3 s, weights and forces of ordinary
/// size.
inline Eigen::VectorXd random_parameters(const PlanarTask& task, const mcplan::sip::Layout& layout, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Eigen::VectorXd x(layout.parameters);
  for (double& value : x) value = unit(random);
  x.head(layout.first_duration) *= 0.3;
  for (int p = 0; p < layout.durations; ++p) {
    const int intervals = layout.durations == 1 ? layout.intervals : task.phases[p].intervals;
    x[layout.first_duration + p] = intervals * (0.2 + 0.1 * unit(random));
  }
  for (int k = 0; k < layout.intervals; ++k) x.segment(layout.first_force[k], layout.forces[k]) *= 50.0;
  return x;
}

}  // namespace planar_tasks
