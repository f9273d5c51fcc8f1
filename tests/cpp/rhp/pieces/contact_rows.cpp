#include "rhp/pieces/contact_rows.hpp"

#include "rhp/pieces/support.hpp"

namespace mcplan::rhp::tests {
namespace {

/// Force of a point (variables 0-2, along t1, t2, n, in kForceUnit) under the rows that `add` makes.
template <typename Add>
nlp::Problem one_force(const Add& add) {
  nlp::Problem problem;
  problem.add_variables("force", 3, -nlp::kInfinity, nlp::kInfinity, {0, 0});
  problem.set_bounds(2, 0.0, nlp::kInfinity);
  add(problem, ContactPoint{0, Vector3d::Zero(), 0, {}});
  problem.finish();
  return problem;
}

bool holds(const nlp::Problem& problem, const VectorXd& x) { return violation(problem, x) <= 1e-12; }

}  // namespace

TEST_CASE("the acceleration is what the forces of all points leave of gravity") {
  Random random(1);
  const std::vector<Placement> placements{random_placement(random, 0), random_placement(random, 0)};
  std::vector<ContactPoint> points;
  for (int i = 0; i < 5; ++i) points.push_back({i % 2, random.three(), 3 + 3 * i, {}});
  points.back().edges_W = pyramid_edges(placements[0], 0.4, 6, false);  // the last one along edges
  nlp::Problem problem;
  problem.add_variables("acceleration", 3, -nlp::kInfinity, nlp::kInfinity, {0, 0});
  problem.add_variables("force", 18, -nlp::kInfinity, nlp::kInfinity, {0, 0});
  add_acceleration(problem, 0, placements, points, 95.0, 9.81);
  problem.finish();

  VectorXd x = random.vector(21, 5.0);
  Vector3d sum = Vector3d::Zero();
  for (const ContactPoint& point : points) sum += walkers::force_W(point, placements[point.placement], x);
  x.head<3>() = sum / 95.0 - Vector3d(0.0, 0.0, 9.81);
  CHECK(problem.equality_count() == 3);
  CHECK(violation(problem, x) < 1e-12);
  x[1] += 0.01;
  CHECK(violation(problem, x) == doctest::Approx(0.01 * 95.0 / kForceUnit));
  expect_derivatives(problem, 2);
}

TEST_CASE("the inner friction pyramid never leaves the circular cone and touches it at its edges") {
  constexpr double kMu = 0.3;
  for (int sides : {3, 4, 8, 13}) {
    CAPTURE(sides);
    const nlp::Problem problem =
        one_force([&](nlp::Problem& p, const ContactPoint& point) { add_friction(p, point, kMu, sides, false); });
    for (int i = 0; i < 720; ++i) {
      const double angle = M_PI * i / 360.0;
      const Vector3d on_cone = 4.0 * Vector3d(kMu * std::cos(angle), kMu * std::sin(angle), 1.0);
      CHECK_FALSE(holds(problem, Vector3d(1.0001 * on_cone.x(), 1.0001 * on_cone.y(), on_cone.z())));
      const double inside = 0.9999 * std::cos(M_PI / sides);  // the circle within the polygon
      CHECK(holds(problem, Vector3d(inside * on_cone.x(), inside * on_cone.y(), on_cone.z())));
    }
    for (int j = 0; j < sides; ++j) {
      const double angle = (2 * j + 1) * M_PI / sides;
      CHECK(holds(problem, 4.0 * Vector3d(kMu * std::cos(angle), kMu * std::sin(angle), 1.0)));
    }
    CHECK_FALSE(holds(problem, Vector3d(0.0, 0.0, -1.0)));
    expect_derivatives(problem, sides);
  }
}

TEST_CASE("the paper's friction pyramid is the square around the cone") {
  const nlp::Problem problem =
      one_force([](nlp::Problem& p, const ContactPoint& point) { add_friction(p, point, 0.3, 8, true); });
  Random random(3);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d f(random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(0.0, 3.0));
    const bool within = std::max(std::abs(f.x()), std::abs(f.y())) <= 0.3 * f.z();
    inside += within;
    CHECK(holds(problem, f) == within);
  }
  CHECK(inside > 100);
}

TEST_CASE("the edges of a pyramid span what its rows allow") {
  for (bool outer : {false, true})
    for (int sides : {4, 8}) {
      Random random(sides);
      const Placement placement = random_placement(random, 0);
      const Eigen::Matrix3Xd edges = pyramid_edges(placement, 0.3, sides, outer);
      const nlp::Problem rows = one_force(
          [&](nlp::Problem& p, const ContactPoint& point) { add_friction(p, point, 0.3, sides, outer, true); });
      const int count = static_cast<int>(edges.cols());
      REQUIRE(count == (outer ? 4 : sides));
      for (int j = 0; j < count; ++j) {
        const Vector3d edge = placement.axes_W.transpose() * edges.col(j);
        CHECK(edge.z() == doctest::Approx(1.0));
        CHECK(edge.head<2>().norm() == doctest::Approx(outer ? 0.3 * std::sqrt(2.0) : 0.3));
        for (int k = 0; k < j; ++k) CHECK((edges.col(j) - edges.col(k)).norm() > 0.05);
        // Sums of neighbours are as far out as a force may be.
        CHECK(violation(rows, edge) < 1e-12);
        const int next = j + 1 < count ? j + 1 : 0;
        const Vector3d between = 0.5 * (edge + placement.axes_W.transpose() * edges.col(next));
        CHECK(holds(rows, between));
        CHECK_FALSE(holds(rows, Vector3d(1.0001 * between.x(), 1.0001 * between.y(), between.z())));
      }
      for (int i = 0; i < 200; ++i) {
        const VectorXd share = (random.vector(count).array() + 1.0).matrix();
        const Vector3d f = placement.axes_W.transpose() * (edges * share);
        CHECK(f.head<2>().norm() <= (outer ? std::sqrt(2.0) : 1.0) * 0.3 * f.z() + 1e-12);
        CHECK(holds(rows, f));
      }
    }
}

TEST_CASE("the force box binds forces along the edges of the pyramid as it does those along the axes") {
  constexpr double kLimit = 400.0;
  int in = 0, out = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Placement placement = random_placement(random, 0);
    if (seed % 3 == 0) placement.axes_W = Eigen::AngleAxisd(random.in(-3.0, 3.0), Vector3d::UnitZ()).toRotationMatrix();
    if (seed % 3 == 1) placement.axes_W = random.rotation(1.2);
    const double friction = random.in(0.1, 1.5);
    ContactPoint point{0, Vector3d::Zero(), 0, pyramid_edges(placement, friction, 8, seed % 2 == 0)};
    const int count = static_cast<int>(point.edges_W.cols());
    nlp::Problem problem;
    problem.add_variables("force", count, 0.0, nlp::kInfinity, {0, 0});
    add_force_box(problem, placement, point, kLimit, friction);
    problem.finish();
    for (int i = 0; i < 200; ++i) {
      VectorXd x = random.vector(count).cwiseMax(0.0);
      if (i % 4 == 0) x = VectorXd::Unit(count, i / 4 % count);  // one edge alone, which may point downwards
      const double largest = walkers::force_W(point, placement, x).cwiseAbs().maxCoeff();
      if (largest < 1.0) continue;
      x *= random.in(0.8, 1.2) * kLimit / largest;
      const double component = walkers::force_W(point, placement, x).cwiseAbs().maxCoeff();
      ++(component < kLimit ? in : out);
      CHECK(holds(problem, x) == (component <= kLimit));
    }
  }
  CHECK(in > 2000);
  CHECK(out > 2000);
}

TEST_CASE("what the force box leaves out is implied: no force within the rows has a component beyond the limit") {
  constexpr double kLimit = 400.0;
  int at_limit = 0, left_out = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Placement placement = random_placement(random, 0);
    if (seed % 3 == 0) placement.axes_W = Eigen::AngleAxisd(random.in(-3.0, 3.0), Vector3d::UnitZ()).toRotationMatrix();
    if (seed % 3 == 1) placement.axes_W = random.rotation(1.2);  // up to walls
    const double friction = random.in(0.1, 1.5);
    const bool outer = seed % 2 == 0;
    const nlp::Problem problem = one_force([&](nlp::Problem& p, const ContactPoint& point) {
      add_friction(p, point, friction, 8, outer);
      add_force_box(p, placement, point, kLimit, friction);
    });
    left_out += 3 - (problem.row_count() - (outer ? 4 : 8));
    for (int i = 0; i < 400; ++i) {
      // In the pyramid, of the size at which the largest component is about the limit.
      Vector3d f = Vector3d(random.in(-friction, friction), random.in(-friction, friction), 1.0);
      if (!outer && f.head<2>().norm() > friction * std::cos(M_PI / 8)) continue;
      const double largest = (placement.axes_W * f).cwiseAbs().maxCoeff();
      f *= random.in(0.8, 1.2) * kLimit / kForceUnit / largest;
      const double component = kForceUnit * (placement.axes_W * f).cwiseAbs().maxCoeff();
      if (std::abs(component - kLimit) < 1e-6) continue;
      CHECK(holds(problem, f) == (component <= kLimit));
      ++at_limit;
    }
    expect_derivatives(problem, seed);
  }
  CHECK(at_limit > 5000);
  CHECK(left_out > 30);
}

}  // namespace mcplan::rhp::tests
