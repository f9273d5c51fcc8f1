#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <string>
#include <vector>

#include "mcplan/plan/plan.hpp"

/// A biped with hands and two plans for it, made by hand: a walk of three steps and a stance that holds a rail.
namespace fixtures {

using Eigen::Vector3d;

constexpr double kHeight = 0.7, kGravity = 9.81, kPhase = 0.4;
enum End { left_foot, right_foot, left_hand, right_hand };
enum Ground { ground, rail, block, patch, hand_patch };

inline mcplan::Robot biped() {
  mcplan::Robot robot;
  robot.name = "biped";
  robot.mass = 40.0;
  robot.inertia = {2.0, 2.5, 3.0};
  robot.com_height = kHeight;
  robot.swing_height = 0.08;
  for (double side : {1.0, -1.0}) {
    mcplan::EndEffector foot;
    foot.name = side > 0 ? "left_foot" : "right_foot";
    foot.half_size = {0.10, 0.05};
    foot.nominal_B = {0.0, 0.10 * side, -kHeight};
    foot.reach_min_B = {-0.3, side > 0 ? 0.02 : -0.2, -0.75};
    foot.reach_max_B = {0.3, side > 0 ? 0.2 : -0.02, -0.55};
    foot.max_force = 800.0;
    foot.max_moment = {60.0, 60.0, 1.0};
    robot.end_effectors.push_back(foot);
  }
  for (double side : {1.0, -1.0}) {
    mcplan::EndEffector hand;
    hand.name = side > 0 ? "left_hand" : "right_hand";
    hand.kind = "hand";
    hand.nominal_B = {0.0, 0.3 * side, 0.05};
    hand.reach_min_B = {-0.3, side > 0 ? 0.1 : -0.5, -0.4};
    hand.reach_max_B = {0.3, side > 0 ? 0.5 : -0.1, 0.4};
    hand.max_force = 300.0;
    robot.end_effectors.push_back(hand);
  }
  return robot;
}

inline mcplan::Surface rectangle(const std::string& name, double x0, double x1, double y0, double y1, double z) {
  mcplan::Surface surface;
  surface.name = name;
  surface.vertices_W = {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
  return surface;
}

/// Ground, a rail for the hands beside it, a low block under the left foot's first step, and two patches that lie on
/// the ground: one for all, one for hands.
inline mcplan::Scene hall() {
  mcplan::Scene scene;
  scene.name = "hall";
  scene.gravity = kGravity;
  scene.surfaces = {rectangle("ground", -1, 2, -1, 1, 0), rectangle("rail", -0.5, 1, 0.25, 0.35, kHeight),
                    rectangle("block", 0.05, 0.07, 0.09, 0.11, 0.02), rectangle("patch", -1, 2, -1, 1, 0),
                    rectangle("hand_patch", -1, 2, -1, 1, 0)};
  scene.surfaces[rail].grasp = true;
  scene.surfaces[rail].end_effectors = {"hand"};
  scene.surfaces[hand_patch].end_effectors = {"hand"};
  scene.start.contacts = {{"foot", "ground"}};
  scene.goal = scene.start;
  scene.goal.position_W.x() = 0.24;
  return scene;
}

/// Left foot, right foot and left foot again, with double support between; the left hand touches the rail before,
/// without load. CoM at constant height: sum_l mu_l = omega^2 = g / height, so that x'' = omega^2 (x - c) with the
/// centre of pressure c under the stance foot or between the feet. The smallest changes of c that end the walk at rest
/// above the goal follow from a linear system, the knots from the hyperbolic solution of the pendulum.
inline mcplan::Plan walk() {
  const std::string swings = "...l..r..l..";  // the foot that swings in each phase
  const int n = static_cast<int>(swings.size());
  const double omega = std::sqrt(kGravity / kHeight), ch = std::cosh(omega * kPhase), sh = std::sinh(omega * kPhase);
  Eigen::Matrix2d step;
  step << ch, sh / omega, omega * sh, ch;
  const Eigen::Vector2d push(1.0 - ch, -omega * sh);

  mcplan::Plan plan;
  plan.scene = hall();
  plan.robot = biped();
  plan.planner = "by hand";
  const double y[2] = {0.1, -0.1}, landings[3] = {0.12, 0.24, 0.24};
  std::vector<Eigen::Vector2d> feet_x(1, Eigen::Vector2d::Zero());  // per knot
  Eigen::MatrixXd centre(n, 2);                                     // of pressure, per phase
  for (int k = 0, steps = 0; k < n; ++k) {
    const Eigen::Vector2d x = feet_x.back();
    const int stance = swings[k] == 'l' ? right_foot : left_foot;
    centre.row(k) << (swings[k] == '.' ? x.mean() : x[stance]), (swings[k] == '.' ? 0.0 : y[stance]);
    feet_x.push_back(x);
    if (swings[k] != '.') feet_x.back()[1 - stance] = landings[steps++];
  }

  Eigen::MatrixXd effect(2, n);  // of each centre on the final CoM and velocity, split into growing and decaying motion
  Eigen::Matrix2d power = Eigen::Matrix2d::Identity();
  Eigen::Matrix2d split;
  split << 1.0, 1.0 / omega, 1.0, -1.0 / omega;
  for (int k = n - 1; k >= 0; --k) {
    effect.col(k) = split * power * push;
    power = power * step;
  }
  const Eigen::Vector2d goal[2] = {{0.24, 0.0}, {0.0, 0.0}};
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d missing = split * goal[axis] - effect * centre.col(axis);
    const Eigen::Matrix2d gram = effect * effect.transpose();
    centre.col(axis) += effect.transpose() * gram.inverse() * missing;  // the smallest change
  }

  plan.knots.resize(n + 1);
  plan.phases.resize(n);
  Eigen::Matrix2d state = Eigen::Matrix2d::Zero();  // columns x, y; rows CoM, velocity
  const double torques[] = {0.5, -0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.5, 0.5};
  double yaw = 0.0, yaw_rate = 0.0;
  for (int k = 0; k <= n; ++k) {
    mcplan::Knot& knot = plan.knots[k];
    knot.com_W = {state(0, 0), state(0, 1), kHeight};
    knot.com_velocity_W = {state(1, 0), state(1, 1), 0.0};
    knot.base_rpy.z() = yaw;
    knot.base_rpy_rate.z() = yaw_rate;
    for (int foot : {left_foot, right_foot}) knot.end_effectors_W.push_back({feet_x[k][foot], y[foot], 0.0});
    for (int hand : {left_hand, right_hand})
      knot.end_effectors_W.push_back(knot.com_W + plan.robot.end_effectors[hand].nominal_B);
    if (k == 1 || k == 2) knot.end_effectors_W[left_hand] = {0.0, 0.3, kHeight};
    knot.end_effector_velocities_W.assign(4, Vector3d::Zero());
    if (k == n) break;

    mcplan::Phase& phase = plan.phases[k];
    phase.duration = kPhase;
    phase.contacts.resize(4);
    const Eigen::Vector2d c = centre.row(k);
    const double left_share = swings[k] == 'l' ? 0.0 : swings[k] == 'r' ? 1.0 : (c.y() - y[1]) / (y[0] - y[1]);
    const Eigen::Vector2d between(left_share * feet_x[k][0] + (1 - left_share) * feet_x[k][1],
                                  left_share * y[0] + (1 - left_share) * y[1]);
    for (int foot : {left_foot, right_foot}) {
      if (swings[k] == (foot == left_foot ? 'l' : 'r')) {
        plan.swings.push_back({foot, k, k + 1, 0.08, Vector3d::UnitZ(), Vector3d::UnitZ()});
        continue;
      }
      mcplan::Contact& contact = phase.contacts[foot];
      contact.surface = ground;
      contact.stiffness = omega * omega * (foot == left_foot ? left_share : 1 - left_share);
      contact.anchor_W = knot.end_effectors_W[foot];
      contact.anchor_W.head<2>() += c - between;
    }
    if (k == 1) {
      phase.contacts[left_hand].surface = rail;
      phase.contacts[left_hand].anchor_W = knot.end_effectors_W[left_hand];
    }
    phase.contacts[left_foot].moment_W.z() = torques[k];
    yaw += kPhase * yaw_rate + 0.5 * kPhase * kPhase * torques[k] / plan.robot.inertia.z();
    yaw_rate += kPhase * torques[k] / plan.robot.inertia.z();
    for (int axis = 0; axis < 2; ++axis) state.col(axis) = (step * state.col(axis) + push * c[axis]).eval();
  }
  plan.final_contacts = {ground, ground, -1, -1};
  return plan;
}

/// Three phases at rest with both feet on the ground and both hands on rails at `rail_height`, each hand holding with
/// stiffness `hold` [1/s^2]. Equilibrium: sum_l mu_l (height - s_l,z) = g, the rest by symmetry.
inline mcplan::Plan stand_at_rails(double rail_height, double hold) {
  mcplan::Plan plan;
  plan.scene = hall();
  plan.robot = biped();
  plan.scene.surfaces = {rectangle("ground", -1, 2, -1, 1, 0), rectangle("left_rail", -0.5, 1, 0.25, 0.35, rail_height),
                         rectangle("right_rail", -0.5, 1, -0.35, -0.25, rail_height)};
  for (int i : {1, 2}) plan.scene.surfaces[i].grasp = true;
  plan.scene.start.contacts = {{"foot", "ground"}, {"left_hand", "left_rail"}, {"right_hand", "right_rail"}};
  plan.scene.goal = plan.scene.start;
  mcplan::Knot knot;
  knot.com_W.z() = kHeight;
  knot.end_effectors_W = {{0, 0.1, 0}, {0, -0.1, 0}, {0, 0.3, rail_height}, {0, -0.3, rail_height}};
  knot.end_effector_velocities_W.assign(4, Vector3d::Zero());
  mcplan::Phase phase;
  phase.duration = kPhase;
  phase.contacts.resize(4);
  const int surfaces[] = {0, 0, 1, 2};
  const double feet = 0.5 * (kGravity - 2 * hold * (kHeight - rail_height)) / kHeight;
  for (int l = 0; l < 4; ++l) {
    phase.contacts[l].surface = surfaces[l];
    phase.contacts[l].stiffness = l < 2 ? feet : hold;
    phase.contacts[l].anchor_W = knot.end_effectors_W[l];
  }
  plan.knots.assign(4, knot);
  plan.phases.assign(3, phase);
  plan.final_contacts = {0, 0, 1, 2};
  return plan;
}

/// One phase of free flight, all four end-effectors free.
inline mcplan::Plan flight() {
  mcplan::Plan plan = walk();
  plan.phases.resize(1);
  plan.knots.resize(2);
  plan.phases[0].contacts.assign(4, {});
  plan.knots[0].com_velocity_W = {1.0, -0.2, 1.5};
  plan.knots[1] = plan.knots[0];
  plan.swings.clear();
  plan.final_contacts.assign(4, -1);
  return plan;
}

}  // namespace fixtures
