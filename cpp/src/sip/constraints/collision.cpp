#include <algorithm>
#include <cmath>

#include "mcplan/sip/constraints.hpp"

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

}  // namespace

// |x_a - x_b|^2 >= (r_a + r_b)^2 for discs that cover the capsules of two bodies. The distance of two segments is not
// smooth; this is, at the price of discs up to 1.4 times as wide as the capsule.
void keep_apart(IntervalMotion& motion, std::vector<Limited>& out) {
  const PlanarRobot& robot = motion.motion.robot;
  TaylorGraph& graph = motion.graph;
  const int order = motion.options.order;
  for (const auto& [a, b] : robot.collision_pairs) {
    std::vector<Disc> first, second;
    for (const Capsule& capsule : robot.bodies[a].capsules) cover(a, capsule, first);
    for (const Capsule& capsule : robot.bodies[b].capsules) cover(b, capsule, second);
    for (const Disc& one : first)
      for (const Disc& other : second) {
        const IntervalMotion::Point p = motion.point(a, one.centre_B), q = motion.point(b, other.centre_B);
        const TaylorGraph::Node x = graph.linear({{1.0, p.x}, {-1.0, q.x}}, 0.0, order);
        const TaylorGraph::Node y = graph.linear({{1.0, p.y}, {-1.0, q.y}}, 0.0, order);
        const TaylorGraph::Node squared =
            graph.linear({{1.0, graph.product(x, x, order)}, {1.0, graph.product(y, y, order)}});
        const double least = one.radius + other.radius;
        out.push_back({"collision of " + robot.bodies[a].name + " and " + robot.bodies[b].name, squared, least * least,
                       INFINITY, 1.0 / (least * least)});
      }
  }
}

}  // namespace mcplan::sip
