#include "rhp/pieces/momentum_rate.hpp"

#include <algorithm>

#include "rhp/pieces/contact_rows.hpp"
#include "rhp/pieces/support.hpp"

namespace mcplan::rhp::tests {
namespace {

/// Two feet on two tilted surfaces, four corners each, the second placement listed first. Variables: R 0-2, c 3-5,
/// footholds 6-7 and 8-9, forces from 10 on.
struct Feet {
  std::vector<Placement> placements;
  std::vector<ContactPoint> points;

  explicit Feet(unsigned seed, bool edges) {
    Random random(seed);
    placements = {random_placement(random, 6), random_placement(random, 8)};
    int next = 10;
    for (int placement : {1, 0})
      for (double s1 : {1.0, -1.0})
        for (double s2 : {1.0, -1.0}) {
          points.push_back({placement, placements[placement].axes_W * Vector3d(0.11 * s1, 0.06 * s2, 0.0), next, {}});
          if (edges) points.back().edges_W = pyramid_edges(placements[placement], 0.3, 5, false);
          next += edges ? 5 : 3;
        }
  }
};

}  // namespace

TEST_CASE("the rate of the angular momentum is the sum of cross products about the CoM") {
  for (unsigned seed = 0; seed < 10; ++seed) {
    CAPTURE(seed);
    const Feet feet(seed, seed % 2 == 0);
    const MomentumRate piece(0, 3, feet.placements, feet.points);
    Random random(seed + 100);
    const VectorXd all = random.vector(50);  // by the problem's indices
    VectorXd x(piece.size());
    for (int i = 0; i < piece.size(); ++i) x[i] = all[piece.variables()[i]];

    Vector3d torque = Vector3d::Zero();
    for (const ContactPoint& point : feet.points) {
      const Placement& foot = feet.placements[point.placement];
      const Vector3d t1 = foot.axes_W.col(0), t2 = foot.axes_W.col(1);
      const Vector3d where = foot.origin_W + all[foot.variable] * t1 + all[foot.variable + 1] * t2 + point.offset_W;
      torque += (where - all.segment<3>(3)).cross(walkers::force_W(point, foot, all));
    }
    CHECK((values(piece, x) - (all.head<3>() - torque)).norm() < 1e-10);
  }
}

TEST_CASE("a piece of momentum names no variable twice, though four points share a foothold") {
  const Feet feet(3, false);
  std::vector<int> variables = MomentumRate(0, 3, feet.placements, feet.points).variables();
  std::sort(variables.begin(), variables.end());
  CHECK(variables.size() == 34);
  CHECK(std::adjacent_find(variables.begin(), variables.end()) == variables.end());
}

TEST_CASE("derivatives of the rate of the angular momentum") {
  for (unsigned seed : {5u, 6u}) {
    const Feet feet(seed, seed % 2 == 0);
    expect_derivatives(MomentumRate(0, 3, feet.placements, feet.points), seed);
  }
}

}  // namespace mcplan::rhp::tests
