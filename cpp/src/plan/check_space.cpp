#include <algorithm>

#include "check_internal.hpp"

namespace mcplan::checks {

using Eigen::Vector3d;

/// reach_min <= R_WB^T (p_l - p) <= reach_max, for end-effectors in contact and free ones alike.
void check_reach(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const EndEffector& limits = problem.robot.end_effectors[l];
    const Vector3d relative = sample.r_WB.transpose() * (sample.at.end_effectors[l].position_W - sample.replay.com_W);
    const double beyond = largest((limits.reach_min_B - relative).cwiseMax(relative - limits.reach_max_B));
    findings.offer(Constraint::reach, beyond, {sample.phase, l, sample.time_s});
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
                                           sample.at.end_effectors[l].position_W, sample.replay.rpy.z());
      findings.offer(Constraint::clearance, depth, {sample.phase, l, sample.time_s});
    }
  }
}

}  // namespace mcplan::checks
