#pragma once

#include <cmath>
#include <string>

#include "mcplan/planar/plan.hpp"
#include "mcplan/planar/robot.hpp"
#include "mcplan/planar/task.hpp"

/// A planar robot of two straight legs and an arm, symmetric about its middle, and a plan in which it stands still.
namespace planar {

using Eigen::Vector2d;

constexpr double kSplay = 0.3, kLeg = 0.8, kAnkle = 0.05, kHalfSole = 0.1;
enum Body { trunk, left_leg, left_sole, right_leg, right_sole, arm };
enum End { left_foot, right_foot, hand };

inline double foot_x() { return kLeg * std::sin(kSplay); }
inline double hip_height() { return kLeg * std::cos(kSplay) + kAnkle; }

inline mcplan::PlanarBody body(const std::string& name, int parent, const Vector2d& joint_P, double offset, double mass,
                               const Vector2d& com_B, double inertia) {
  mcplan::PlanarBody out;
  out.name = name;
  out.parent = parent;
  out.joint_P = joint_P;
  out.offset = offset;
  out.mass = mass;
  out.com_B = com_B;
  out.inertia = inertia;
  if (parent >= 0) {
    out.position_min = -1.5;
    out.position_max = 1.5;
    out.velocity_max = 5.0;
    out.torque_max = 200.0;
  }
  return out;
}

inline mcplan::PlanarRobot stander() {
  mcplan::PlanarRobot robot;
  robot.name = "stander";
  robot.bodies.push_back(body("trunk", -1, {0.0, 0.0}, 0.0, 20.0, {0.0, 0.1}, 0.4));
  for (double side : {-1.0, 1.0}) {
    const std::string name = side < 0.0 ? "left" : "right";
    const int hip = static_cast<int>(robot.bodies.size());
    robot.bodies.push_back(body(name + "_leg", trunk, {0.0, 0.0}, side * kSplay, 5.0, {0.0, -0.4}, 0.2));
    robot.bodies.push_back(body(name + "_sole", hip, {0.0, -kLeg}, -side * kSplay, 1.0, {0.0, -0.03}, 0.01));
    robot.bodies[hip].capsules = {{{0.0, 0.0}, {0.0, -kLeg}, 0.05}};
    robot.end_effectors.push_back({name + "_foot", hip + 1, {0.0, -kAnkle}, 0.0, {-kHalfSole, kHalfSole}});
  }
  robot.bodies.push_back(body("arm", trunk, {0.0, 0.4}, 0.0, 2.0, {0.0, -0.1}, 0.02));
  robot.bodies[arm].capsules = {{{0.0, 0.0}, {0.0, -0.2}, 0.03}};
  robot.end_effectors.push_back({"hand", arm, {0.0, -0.2}, 0.0, {0.0}});
  robot.collision_pairs = {{left_leg, arm}};
  return robot;
}

/// Three phases with both feet on level ground, the hand to stay above it.
inline mcplan::PlanarTask standing() {
  mcplan::PlanarTask task;
  task.name = "standing";
  task.robot = stander();
  mcplan::PlanarSurface ground;
  ground.name = "ground";
  ground.friction = 0.8;
  task.surfaces.push_back(ground);
  mcplan::PlanarPhase phase;
  phase.intervals = 4;
  phase.contacts = {{left_foot, 0, {-foot_x(), 0.0}, 0.0}, {right_foot, 0, {foot_x(), 0.0}, 0.0}};
  phase.clearances = {{hand, 0, 1, 3, 0.5}};
  mcplan::PlanarPose pose;
  pose.body = trunk;
  pose.fraction = 0.3;
  pose.min = {-0.01, hip_height() - 0.01, -0.01};
  pose.max = {0.01, hip_height() + 0.01, 0.01};
  phase.poses = {pose};
  task.phases = {phase, phase, phase};
  return task;
}

/// At rest in the zero posture.
inline mcplan::PlanarPlan standing_plan() {
  mcplan::PlanarPlan plan;
  plan.task = standing();
  plan.planner = "by hand";
  plan.durations = {0.3, 0.4, 0.5};
  plan.control_points = Eigen::MatrixXd::Zero(plan.task.robot.joint_count(), plan.task.interval_count() + 3);
  plan.weights.assign(3, Eigen::VectorXd::Ones(4));
  return plan;
}

}  // namespace planar
