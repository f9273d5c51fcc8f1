#include <algorithm>
#include <cmath>

#include "planar/sip/constraints.hpp"

namespace mcplan::sip {

// min <= (x, y, angle) of a body <= max at an instant of the phase (z_k of eq. 2)
void pass_poses(IntervalMotion& motion, std::vector<Limited>& out) {
  const PlanarTask& task = motion.task;
  const PlanarPhase& phase = task.phases[motion.local.phase];
  const int interval = motion.local.interval - task.first_interval(motion.local.phase);
  for (const PlanarPose& pose : phase.poses) {
    const double at = pose.fraction * phase.intervals;
    if (std::min(static_cast<int>(at), phase.intervals - 1) != interval) continue;
    const IntervalMotion::Body& body = motion.bodies[pose.body];
    const std::array<TaylorGraph::Node, 3> nodes{body.joint.x, body.joint.y, body.angle};
    const Eigen::Vector3d origin(motion.origin_W.x(), motion.origin_W.y(), 0.0);
    for (int i = 0; i < 3; ++i) {
      if (std::isinf(pose.min[i]) && std::isinf(pose.max[i])) continue;
      Limited row{"pose of " + task.robot.bodies[pose.body].name, nodes[i], pose.min[i] - origin[i],
                  pose.max[i] - origin[i]};
      row.when = Limited::When::instant;
      row.at = 2.0 * (at - interval) - 1.0;
      out.push_back(row);
    }
  }
}

}  // namespace mcplan::sip
