#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "check_internal.hpp"
#include "mcplan/base/rotation.hpp"

namespace mcplan::checks {

using Eigen::Vector3d;

namespace {

/// Largest excess [m] of A x <= b.
double beyond_polytope(const Polytope& polytope, const Vector3d& x) {
  return (polytope.A * x - polytope.b).maxCoeff<Eigen::PropagateNaN>();
}

/// Reach box of an end-effector, in frame B about the CoM. Where polytopes decide on the contacts, a free
/// end-effector's box grows to hold where it lifts off and touches down, which the polytopes have admitted.
Eigen::AlignedBox3d reach_box(const Problem& problem, int phase, int l) {
  const EndEffector& limits = problem.robot.end_effectors[l];
  Eigen::AlignedBox3d box(limits.reach_min_B, limits.reach_max_B);
  if (!limits.com_reach.given()) return box;
  for (const FreeStretch& stretch : problem.stretches[l]) {
    if (phase < stretch.first_phase || phase >= stretch.end_phase) continue;
    for (int k : {stretch.first_phase, stretch.end_phase}) {
      const bool in_contact = k == stretch.first_phase ? k > 0 : problem.surface(k, l) >= 0;
      const Knot& knot = problem.plan.knots[k];
      if (in_contact) box.extend(rotation_from_rpy(knot.base_rpy).transpose() * (knot.end_effectors_W[l] - knot.com_W));
    }
  }
  return box;
}

/// A Rz(yaw)^T (p_m - p_l) <= b for every other end-effector in contact.
void check_partners(const Problem& problem, const Sample& sample, int l, const Eigen::Matrix3d& level,
                    Findings& findings) {
  for (const auto& [name, polytope] : problem.robot.end_effectors[l].partner_reach) {
    const int m = problem.robot.end_effector_index(name);
    if (m < 0 || m == l || !polytope.given() || problem.surface(sample.phase, m) < 0) continue;
    const Vector3d between = sample.at.end_effectors[m].position_W - sample.at.end_effectors[l].position_W;
    findings.offer(Constraint::reach, beyond_polytope(polytope, level.transpose() * between),
                   {sample.phase, l, sample.time_s});
  }
}

}  // namespace

/// reach_min <= R_WB^T (p_l - p) <= reach_max, for end-effectors in contact and free ones alike. In contact, and where
/// the robot says it finer, A Rz(yaw)^T (p - p_l) <= b takes the box's place, and the other end-effectors are held to
/// theirs.
void check_reach(const Problem& problem, const Sample& sample, Findings& findings) {
  const Eigen::Matrix3d level = rotation_from_rpy({0.0, 0.0, sample.replay.rpy.z()});
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const EndEffector& limits = problem.robot.end_effectors[l];
    const Vector3d offset = sample.at.end_effectors[l].position_W - sample.replay.com_W;
    const bool in_contact = problem.surface(sample.phase, l) >= 0;
    const Place place{sample.phase, l, sample.time_s};
    if (in_contact) check_partners(problem, sample, l, level, findings);
    if (in_contact && limits.com_reach.given()) {
      findings.offer(Constraint::reach, beyond_polytope(limits.com_reach, level.transpose() * -offset), place);
      continue;
    }
    const Eigen::AlignedBox3d box = reach_box(problem, sample.phase, l);
    const Vector3d relative = sample.r_WB.transpose() * offset;
    findings.offer(Constraint::reach, largest((box.min() - relative).cwiseMax(relative - box.max())), place);
  }
}

/// yaw_range: min <= yaw of the sole - yaw of the base <= max while in contact, modulo a turn.
void check_yaw_range(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const Eigen::Vector2d& range = problem.robot.end_effectors[l].yaw_range;
    if (problem.surface(sample.phase, l) < 0 || !range.allFinite()) continue;
    const double turned = std::remainder(sole_yaw(problem, sample, l) - sample.replay.rpy.z(), 2.0 * M_PI);
    findings.offer(Constraint::reach, std::max(range[0] - turned, turned - range[1]), {sample.phase, l, sample.time_s},
                   problem.tolerances.yaw, "rad");
  }
}

/// Depth inside the prism below any surface, for end-effectors that are free (clearance.hpp says which points count).
void check_clearance(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    if (problem.surface(sample.phase, l) >= 0) continue;
    for (const FreeStretch& stretch : problem.stretches[l]) {
      if (sample.phase < stretch.first_phase || sample.phase >= stretch.end_phase) continue;
      const double depth = clearance_depth(problem.solids, problem.robot.end_effectors[l], stretch,
                                           (sample.time_s - stretch.start_s) / stretch.duration_s,
                                           sample.at.end_effectors[l].position_W, sole_yaw(problem, sample, l));
      findings.offer(Constraint::clearance, depth, {sample.phase, l, sample.time_s});
    }
  }
}

}  // namespace mcplan::checks
