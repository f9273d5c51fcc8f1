#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "plan/clearance.hpp"

namespace fixtures {

/// Largest depth [m] of an end-effector over a stretch in which it is free, in steps of a phase no longer than
/// `sample_s` [s], of the way that the plan says.
inline double deepest(const mcplan::Plan& plan, const std::vector<mcplan::Solid>& solids, int end_effector,
                      const mcplan::FreeStretch& stretch, double sample_s) {
  double worst = 0.0, before = 0.0;
  for (int k = stretch.first_phase; k < stretch.end_phase; ++k) {
    const double duration = plan.phases[k].duration;
    const int samples = std::max(1, static_cast<int>(std::ceil(duration / sample_s)));
    for (int i = 0; i <= samples; ++i) {
      const double tau = duration * i / samples;
      const auto end = plan.at_phase(k, tau).end_effectors[end_effector];
      worst = std::max(worst, mcplan::clearance_depth(solids, plan.robot.end_effectors[end_effector], stretch,
                                                      stretch.ratio(before + tau), end.position_W, end.yaw));
    }
    before += duration;
  }
  return worst;
}

}  // namespace fixtures
