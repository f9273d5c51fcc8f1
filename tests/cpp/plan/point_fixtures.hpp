#pragma once

#include "plan/clearance.hpp"
#include "plan/fixtures.hpp"
#include "plan/point_forces.hpp"
#include "plan/swings.hpp"

/// A plan with forces at the corners of the feet, made by hand.
namespace fixtures {

inline std::vector<Vector3d> corners(const mcplan::EndEffector& foot, const Vector3d& centre_W,
                                     const Vector3d& normal_W = Vector3d::UnitZ()) {
  const Eigen::Matrix3d sole = mcplan::sole_frame(normal_W, 0.0);
  std::vector<Vector3d> out;
  for (double x : {1.0, -1.0})
    for (double y : {1.0, -1.0})
      out.push_back(centre_W + sole * Vector3d(x * foot.half_size.x(), y * foot.half_size.y(), 0.0));
  return out;
}

/// CoM and angular momentum of every knot as they follow from the first and the forces.
inline void replay_knots(mcplan::Plan& plan) {
  for (std::size_t k = 0; k < plan.phases.size(); ++k) {
    const auto& from = plan.knots[k];
    const auto end = mcplan::integrate_phase(plan.phases[k], {from.com_W, from.com_velocity_W, from.angular_momentum_W},
                                             plan.phases[k].duration, plan.robot.mass, plan.scene.gravity);
    plan.knots[k + 1].com_W = end.com_W;
    plan.knots[k + 1].com_velocity_W = end.com_velocity_W;
    plan.knots[k + 1].angular_momentum_W = end.angular_momentum_W;
  }
}

/// The first step of a walk: both feet, the left foot swinging 0.1 m ahead, both feet again. The corners share the
/// weight, a little differently at every node, and push sideways with up to a fifth of what they carry. Forces are
/// linear in the first two phases and held in the last; the end is open.
inline mcplan::Plan step_on_corners() {
  mcplan::Plan plan;
  plan.scene = hall();
  plan.robot = biped();
  plan.planner = "by hand";
  plan.open_end = true;
  const double durations[] = {0.2, 0.3, 0.15};
  const int intervals[] = {4, 5, 3};
  mcplan::Knot knot;
  knot.com_W = {0.0, 0.0, kHeight};
  for (const auto& end : plan.robot.end_effectors) knot.end_effectors_W.push_back(knot.com_W + end.nominal_B);
  knot.end_effector_velocities_W.assign(4, Vector3d::Zero());
  plan.knots.assign(4, knot);
  for (int k : {2, 3}) {
    plan.knots[k].end_effectors_W[left_foot].x() = 0.1;
    plan.knots[k].base_rpy = {0.01, -0.02, 0.0};
  }
  plan.knots[1].base_rpy_rate = {0.05, 0.1, 0.0};
  for (int k = 0; k < 3; ++k) {
    mcplan::Phase phase;
    phase.duration = durations[k];
    phase.intervals = intervals[k];
    phase.law = mcplan::laws::Linear();
    if (k == 2) phase.law = mcplan::laws::Held();
    phase.contacts.resize(4);
    for (int foot : {left_foot, right_foot}) {
      if (k == 1 && foot == left_foot) continue;
      mcplan::Contact& contact = phase.contacts[foot];
      contact.surface = ground;
      contact.points_W = corners(plan.robot.end_effectors[foot], plan.knots[k].end_effectors_W[foot]);
      const double share = plan.robot.mass * kGravity / (k == 1 ? 4 : 8);
      for (int j = 0; j < phase.node_count(); ++j)
        for (int i = 0; i < 4; ++i) {
          const double wave = std::sin(1.0 + 2.0 * j + 3.0 * i + 5.0 * foot + 7.0 * k);
          contact.point_forces_W.push_back(share * (1.0 + 0.1 * wave) * Vector3d(0.15 * wave, -0.1 * wave, 1.0));
        }
    }
    plan.phases.push_back(phase);
  }
  plan.final_contacts = {ground, ground, -1, -1};
  replay_knots(plan);
  for (auto& end : plan.knots)
    for (int hand : {left_hand, right_hand})
      end.end_effectors_W[hand] = end.com_W + plan.robot.end_effectors[hand].nominal_B;
  mcplan::choose_swings(plan);
  return plan;
}

}  // namespace fixtures
