#include "rhp/pieces/reach_rows.hpp"

#include <algorithm>

#include "rhp/pieces/support.hpp"
#include "rhp/polytopes.hpp"

namespace mcplan::rhp::tests {
namespace {

using walkers::com_over_left;
using walkers::left_beside_right;

/// CoM 0-2, two footholds 3-4 and 5-6.
nlp::Problem com_and_feet() {
  nlp::Problem problem;
  problem.add_variables("com", 3, -nlp::kInfinity, nlp::kInfinity, {0, 0});
  problem.add_variables("foothold", 4, -nlp::kInfinity, nlp::kInfinity, {0, 0});
  return problem;
}

/// x turned back by the heading, and how far the worst row is exceeded.
double excess(const Polytope& polytope, double heading, const Vector3d& d_W) {
  const double c = std::cos(heading), s = std::sin(heading);
  const Vector3d d(c * d_W.x() + s * d_W.y(), -s * d_W.x() + c * d_W.y(), d_W.z());
  double worst = -1e9;
  for (int i = 0; i < polytope.A.rows(); ++i) worst = std::max(worst, polytope.A.row(i).dot(d) - polytope.b[i]);
  return worst;
}

Matrix3d about_z(double angle) { return Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix(); }

/// A convex polygon on an ellipse, tilted, and a foot's frame in its plane.
struct Ground {
  Polygon polygon;
  Placement foot;

  explicit Ground(unsigned seed) {
    Random random(seed);
    foot = random_placement(random, 0);
    std::vector<double> angles;
    const int corners = 3 + static_cast<int>(seed % 6);
    for (int i = 0; i < corners; ++i) angles.push_back(2.0 * M_PI * (i + random.in(0.0, 0.7)) / corners);
    const double turn = random.in(-M_PI, M_PI), a = random.in(0.25, 0.6), b = random.in(0.2, 0.5);
    std::vector<Vector3d> vertices;
    for (double angle : angles)
      vertices.push_back(foot.origin_W +
                         foot.axes_W * about_z(turn) * Vector3d(a * std::cos(angle), b * std::sin(angle), 0.0));
    polygon = Polygon(vertices);
    foot.origin_W += foot.axes_W.leftCols<2>() * random.vector(2, 0.3);
  }

  /// Distance by which a point is inside, from the vertices alone; negative outside.
  double inside(const Vector3d& p) const {
    double least = 1e9;
    const auto& v = polygon.vertices_W();
    for (std::size_t j = 0; j < v.size(); ++j) {
      const Vector3d edge = (v[(j + 1) % v.size()] - v[j]).normalized();
      least = std::min(least, edge.cross(p - v[j]).dot(foot.axes_W.col(2)));
    }
    return least;
  }
};

}  // namespace

TEST_CASE("the rows of a foothold hold exactly where all four corners of the sole are on the polygon") {
  const Vector2d half(0.11, 0.06);
  int in = 0, out = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    const Ground ground(seed);
    nlp::Problem problem;
    problem.add_variables("foothold", 2, -nlp::kInfinity, nlp::kInfinity, {0, 0});
    add_foothold(problem, ground.foot, ground.polygon, half);
    problem.finish();
    expect_derivatives(problem, seed);
    Random random(seed + 1000);
    for (int i = 0; i < 200; ++i) {
      const Vector2d w = random.vector(2, 0.7);
      const Vector3d centre =
          ground.foot.origin_W + w[0] * ground.foot.axes_W.col(0) + w[1] * ground.foot.axes_W.col(1);
      double least = 1e9;
      for (double s1 : {1.0, -1.0})
        for (double s2 : {1.0, -1.0})
          least =
              std::min(least, ground.inside(centre + ground.foot.axes_W * Vector3d(s1 * half[0], s2 * half[1], 0.0)));
      ++(least > 0.0 ? in : out);
      // Not only the sign: the violation of the worst row is how far the worst corner is out.
      CHECK(violation(problem, w) == doctest::Approx(std::max(-least, 0.0)).epsilon(1e-9));
    }
  }
  CHECK(in > 300);
  CHECK(out > 300);
}

TEST_CASE("the reach of the CoM turns with the heading and does not tilt with the surface") {
  int in = 0, out = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const double heading = random.in(-M_PI, M_PI);
    const Placement foot = random_placement(random, 3);
    nlp::Problem problem = com_and_feet();
    add_com_reach(problem, 0, foot, rotated(com_over_left(), about_z(heading)));
    problem.finish();
    expect_derivatives(problem, seed);
    for (int i = 0; i < 100; ++i) {
      VectorXd x = random.vector(7, 0.5);
      const Vector3d p = foot.origin_W + x[3] * foot.axes_W.col(0) + x[4] * foot.axes_W.col(1);
      x.head<3>() = p + about_z(heading) * (Vector3d(-0.05, -0.15, 0.8) + random.three(0.45));
      const double over = excess(com_over_left(), heading, x.head<3>() - p);
      ++(over < 0.0 ? in : out);
      CHECK(violation(problem, x) == doctest::Approx(std::max(over, 0.0)).epsilon(1e-9));
    }
  }
  CHECK(in > 200);
  CHECK(out > 200);
}

TEST_CASE("the reach between feet is of the other foot relative to this one, turned with the heading") {
  int in = 0, out = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const double heading = random.in(-M_PI, M_PI);
    const Placement foot = random_placement(random, 3);
    Placement other = random_placement(random, 5);
    other.origin_W = foot.origin_W + about_z(heading) * Vector3d(0.0, 0.4, 0.0);
    nlp::Problem problem = com_and_feet();
    add_foot_reach(problem, foot, other, rotated(left_beside_right(), about_z(heading)));
    problem.finish();
    expect_derivatives(problem, seed);
    for (int i = 0; i < 100; ++i) {
      const VectorXd x = random.vector(7, 0.3);
      const Vector3d d = other.origin_W + x[5] * other.axes_W.col(0) + x[6] * other.axes_W.col(1) - foot.origin_W -
                         x[3] * foot.axes_W.col(0) - x[4] * foot.axes_W.col(1);
      const double over = excess(left_beside_right(), heading, d);
      ++(over < 0.0 ? in : out);
      CHECK(violation(problem, x) == doctest::Approx(std::max(over, 0.0)).epsilon(1e-9));
    }
  }
  CHECK(in > 200);
  CHECK(out > 200);
}

TEST_CASE("the height of the CoM counts from the foothold, which lies on a slope") {
  Random random(1);
  const Placement foot = random_placement(random, 3);
  nlp::Problem problem = com_and_feet();
  add_com_height(problem, 0, foot, {0.65, 0.80});
  problem.finish();
  expect_derivatives(problem, 1);
  VectorXd x = random.vector(7);
  const double ground = foot.origin_W.z() + x[3] * foot.axes_W(2, 0) + x[4] * foot.axes_W(2, 1);
  for (double height : {0.60, 0.66, 0.79, 0.85}) {
    x[2] = ground + height;
    CHECK(violation(problem, x) == doctest::Approx(std::max({0.65 - height, height - 0.80, 0.0})));
  }
}

}  // namespace mcplan::rhp::tests
