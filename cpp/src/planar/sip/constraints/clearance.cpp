#include "planar/sip/constraints.hpp"
#include "planar/sip/constraints/swing_lines.hpp"

namespace mcplan::sip {
namespace {

/// n . (x - point) of the points x of an end-effector.
std::vector<TaylorGraph::Node> heights(IntervalMotion& motion, int end_effector, const Eigen::Vector2d& point_W,
                                       const Eigen::Vector2d& n) {
  const PlanarEndEffector& foot = motion.task.robot.end_effectors[end_effector];
  const Eigen::Vector2d tau(std::cos(foot.angle_B), std::sin(foot.angle_B));
  const double offset = n.dot(motion.origin_W - point_W);
  std::vector<TaylorGraph::Node> out;
  for (double along : foot.points) {
    const IntervalMotion::Point point = motion.point(foot.body, foot.position_B + along * tau);
    out.push_back(motion.graph.linear({{n.x(), point.x}, {n.y(), point.y}}, offset, motion.options.order));
  }
  return out;
}

}  // namespace

// n . (x - origin) >= clearance_m for the points x of a swinging end-effector: of the surfaces that the task names over
// the intervals that it names, and >= middle_height at the begin of the middle interval; then of the lines that keep it
// out of all other solids.
void keep_clear(IntervalMotion& motion, std::vector<Limited>& out) {
  const PlanarTask& task = motion.task;
  const PlanarPhase& phase = task.phases[motion.local.phase];
  const int interval = motion.local.interval - task.first_interval(motion.local.phase);
  const auto row = [&](int end_effector, TaylorGraph::Node height) {
    const std::string& name = task.robot.end_effectors[end_effector].name;
    return Limited{"clearance of " + name, height, motion.options.clearance_m, INFINITY};
  };
  for (const PlanarClearance& clearance : phase.clearances) {
    const PlanarSurface& surface = task.surfaces[clearance.surface];
    const int end = clearance.end_interval < 0 ? phase.intervals : clearance.end_interval;
    const bool held = interval >= clearance.first_interval && interval < end;
    const bool middle = interval == phase.intervals / 2 && std::isfinite(clearance.middle_height);
    if (!held && !middle) continue;
    for (TaylorGraph::Node height : heights(motion, clearance.end_effector, surface.origin_W, surface.normal_W())) {
      Limited limited = row(clearance.end_effector, height);
      if (held) out.push_back(limited);
      if (!middle) continue;
      limited.when = Limited::When::instant;
      limited.at = -1.0;
      limited.lower = clearance.middle_height;
      out.push_back(limited);
    }
  }
  for (const SwingLine& line : swing_lines(task, motion.local.phase, interval))
    for (TaylorGraph::Node height : heights(motion, line.end_effector, line.point_W, line.normal_W))
      out.push_back(row(line.end_effector, height));
}

}  // namespace mcplan::sip
