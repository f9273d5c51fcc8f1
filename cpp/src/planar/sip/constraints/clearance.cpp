#include "planar/sip/constraints.hpp"

namespace mcplan::sip {

// n . (x - origin) >= clearance_m for the points x of a swinging end-effector, over the intervals that the task
// names, and >= middle_height at the begin of the middle interval.
void keep_clear(IntervalMotion& motion, std::vector<Limited>& out) {
  const PlanarTask& task = motion.task;
  const PlanarPhase& phase = task.phases[motion.local.phase];
  const int interval = motion.local.interval - task.first_interval(motion.local.phase);
  for (const PlanarClearance& clearance : phase.clearances) {
    const PlanarEndEffector& foot = task.robot.end_effectors[clearance.end_effector];
    const PlanarSurface& surface = task.surfaces[clearance.surface];
    const Eigen::Vector2d n = surface.normal_W();
    const int end = clearance.end_interval < 0 ? phase.intervals : clearance.end_interval;
    const bool held = interval >= clearance.first_interval && interval < end;
    const bool middle = interval == phase.intervals / 2 && std::isfinite(clearance.middle_height);
    if (!held && !middle) continue;
    for (double along : foot.points) {
      const Eigen::Vector2d tau(std::cos(foot.angle_B), std::sin(foot.angle_B));
      const IntervalMotion::Point point = motion.point(foot.body, foot.position_B + along * tau);
      const double offset = n.dot(motion.origin_W - surface.origin_W);
      const TaylorGraph::Node height =
          motion.graph.linear({{n.x(), point.x}, {n.y(), point.y}}, offset, motion.options.order);
      Limited row{"clearance of " + foot.name, height, motion.options.clearance_m, INFINITY};
      if (held) out.push_back(row);
      if (!middle) continue;
      row.when = Limited::When::instant;
      row.at = -1.0;
      row.lower = clearance.middle_height;
      out.push_back(row);
    }
  }
}

}  // namespace mcplan::sip
