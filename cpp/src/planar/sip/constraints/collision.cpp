#include <algorithm>
#include <cmath>

#include "planar/sip/constraints.hpp"

namespace mcplan::sip {
namespace {

struct Disc {
  int body;
  Eigen::Vector2d centre_B;
  double radius;
};

/// Discs along a capsule, a radius apart at most, large enough to cover it: at the middle between two centres d apart a
/// disc reaches the capsule's side if its radius is sqrt(r^2 + d^2 / 4).
void cover(int body, const Capsule& capsule, std::vector<Disc>& out) {
  const Eigen::Vector2d along = capsule.to_B - capsule.from_B;
  if (along.norm() == 0.0) {
    out.push_back({body, capsule.from_B, capsule.radius});
    return;
  }
  const int gaps = std::max(1, static_cast<int>(std::ceil(along.norm() / (2.0 * capsule.radius))));
  const double spacing = along.norm() / gaps;
  const double radius = std::hypot(capsule.radius, 0.5 * spacing);
  for (int i = 0; i <= gaps; ++i)
    out.push_back({body, capsule.from_B + along * (i / static_cast<double>(gaps)), radius});
}

std::vector<Disc> discs_of(const PlanarRobot& robot, int body) {
  std::vector<Disc> out;
  for (const Capsule& capsule : robot.bodies[body].capsules) cover(body, capsule, out);
  return out;
}

}  // namespace

void add_close_discs(const PlanarPlan& plan, CloseDiscs& close) {
  constexpr int kInstants = 9;
  constexpr double kMargin_m = 0.01;
  const PlanarRobot& robot = plan.task.robot;
  for (int k = 0; k < plan.task.interval_count(); ++k) {
    const int phase = plan.task.phase_of(k);
    const double length = plan.durations[phase] / plan.task.phases[phase].intervals;
    const double begin = (k - plan.task.first_interval(phase)) * length;
    for (int i = 0; i < kInstants; ++i) {
      const double since = std::min(begin + length * i / (kInstants - 1), plan.durations[phase]);
      const auto frames = planar_kinematics(robot, plan.at_phase(phase, since).configuration);
      for (std::size_t pair = 0; pair < robot.collision_pairs.size(); ++pair) {
        const auto [a, b] = robot.collision_pairs[pair];
        const std::vector<Disc> first = discs_of(robot, a), second = discs_of(robot, b);
        for (std::size_t m = 0; m < first.size(); ++m)
          for (std::size_t n = 0; n < second.size(); ++n) {
            const Eigen::Vector2d p = planar_point(frames[a], first[m].centre_B).position_W;
            const Eigen::Vector2d q = planar_point(frames[b], second[n].centre_B).position_W;
            if ((p - q).norm() < first[m].radius + second[n].radius + kMargin_m)
              close.insert({k, static_cast<int>(pair), static_cast<int>(m), static_cast<int>(n)});
          }
      }
    }
  }
}

// |x_a - x_b|^2 >= (r_a + r_b)^2 for discs that cover the capsules of two bodies. The distance of two segments is not
// smooth; this is, at the price of discs up to 1.4 times as wide as the capsule.
void keep_apart(IntervalMotion& motion, const CloseDiscs* close, std::vector<Limited>& out) {
  const PlanarRobot& robot = motion.task.robot;
  TaylorGraph& graph = motion.graph;
  const int order = motion.options.order;
  for (std::size_t pair = 0; pair < robot.collision_pairs.size(); ++pair) {
    const auto [a, b] = robot.collision_pairs[pair];
    const std::vector<Disc> first = discs_of(robot, a), second = discs_of(robot, b);
    for (std::size_t m = 0; m < first.size(); ++m)
      for (std::size_t n = 0; n < second.size(); ++n) {
        if (close && close->count({motion.local.interval, static_cast<int>(pair), static_cast<int>(m),
                                   static_cast<int>(n)}) == 0)
          continue;
        const IntervalMotion::Point p = motion.point(a, first[m].centre_B), q = motion.point(b, second[n].centre_B);
        const TaylorGraph::Node x = graph.linear({{1.0, p.x}, {-1.0, q.x}}, 0.0, order);
        const TaylorGraph::Node y = graph.linear({{1.0, p.y}, {-1.0, q.y}}, 0.0, order);
        const TaylorGraph::Node squared =
            graph.linear({{1.0, graph.product(x, x, order)}, {1.0, graph.product(y, y, order)}});
        const double min_distance = first[m].radius + second[n].radius;
        out.push_back({"collision of " + robot.bodies[a].name + " and " + robot.bodies[b].name, squared,
                       min_distance * min_distance, INFINITY, 1.0 / (min_distance * min_distance)});
      }
  }
}

}  // namespace mcplan::sip
