#include "mcplan/scene/polygon.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using Eigen::Matrix3d;
using Eigen::Vector3d;
using mcplan::Polygon;

namespace {

struct Random {
  std::mt19937 engine;
  std::uniform_real_distribution<double> unit{-1.0, 1.0};
  explicit Random(unsigned seed) : engine(seed) {}
  double operator()() { return unit(engine); }
  Vector3d vector(double scale) { return {scale * (*this)(), scale * (*this)(), scale * (*this)()}; }
};

struct Turned {
  Matrix3d r;
  Vector3d shift;
  Vector3d operator()(const Vector3d& p) const { return r * p + shift; }
};

Turned random_turn(Random& random) {
  const Vector3d axis = random.vector(1.0).normalized();
  return {Eigen::AngleAxisd(3.0 * random(), axis).toRotationMatrix(), random.vector(2.0)};
}

/// Corners at sorted random angles on an ellipse: convex and counter-clockwise about z.
std::vector<Vector3d> random_convex(Random& random) {
  const int n = 3 + static_cast<int>(2.5 * (1.0 + random()));
  std::vector<double> angles;
  for (int i = 0; i < n; ++i) angles.push_back(2.0 * M_PI * (i + 0.4 * random()) / n);
  std::vector<Vector3d> vertices;
  for (double a : angles) vertices.push_back({1.5 * std::cos(a), 0.8 * std::sin(a), 0.0});
  return vertices;
}

std::vector<Vector3d> map(const std::vector<Vector3d>& points, const Turned& turn) {
  std::vector<Vector3d> out;
  for (const Vector3d& p : points) out.push_back(turn(p));
  return out;
}

/// Points of the polygon: a fan of triangles from the first vertex, each filled with a barycentric grid.
template <typename Visit>
void sample(const std::vector<Vector3d>& v, Visit visit) {
  const int fine = 60;
  for (std::size_t i = 1; i + 1 < v.size(); ++i)
    for (int a = 0; a <= fine; ++a)
      for (int b = 0; a + b <= fine; ++b)
        visit(v[0] + (v[i] - v[0]) * a / double(fine) + (v[i + 1] - v[0]) * b / double(fine));
}

}  // namespace

TEST_CASE("the nearest point is as near as any sample of the polygon, and part of it") {
  Random random(2);
  for (int i = 0; i < 60; ++i) {
    CAPTURE(i);
    const Polygon polygon(map(random_convex(random), random_turn(random)));
    const Vector3d point = polygon.centroid_W() + random.vector(3.0);
    const Vector3d nearest = polygon.nearest(point);
    double sampled = std::numeric_limits<double>::infinity();
    sample(polygon.vertices_W(), [&](const Vector3d& p) { sampled = std::min(sampled, (p - point).norm()); });
    CHECK((nearest - point).norm() <= sampled + 1e-12);
    CHECK((nearest - point).norm() >= sampled - 0.05);  // the grid's width
    CHECK(std::abs(polygon.height(nearest)) < 1e-12);
    CHECK(polygon.outside(nearest) < 1e-12);
  }
}

TEST_CASE("everything turns with the polygon") {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    CAPTURE(i);
    const auto vertices = random_convex(random);
    const Turned turn = random_turn(random);
    const Polygon flat(vertices), turned(map(vertices, turn));
    const Vector3d point = random.vector(2.0);
    CHECK((turned.normal_W() - turn.r * Vector3d::UnitZ()).norm() < 1e-12);
    CHECK(turned.height(turn(point)) == doctest::Approx(point.z()).epsilon(1e-12));
    CHECK(turned.outside(turn(point)) == doctest::Approx(flat.outside(point)).epsilon(1e-12));
    CHECK((turned.nearest(turn(point)) - turn(flat.nearest(point))).norm() < 1e-12);
    CHECK((turned.centroid_W() - turn(flat.centroid_W())).norm() < 1e-12);
  }
}

TEST_CASE("a rectangle's distances are what one reads off it") {
  const Polygon polygon({{0, 0, 1}, {4, 0, 1}, {4, 2, 1}, {0, 2, 1}});
  CHECK(polygon.normal_W() == Vector3d(0, 0, 1));
  CHECK(polygon.centroid_W().isApprox(Vector3d(2, 1, 1)));
  CHECK(polygon.height({1, 1, 1.25}) == doctest::Approx(0.25));
  CHECK(polygon.outside({1, 1, 5}) == doctest::Approx(-1.0));
  CHECK(polygon.outside({4.5, 1, 0}) == doctest::Approx(0.5));
  CHECK(polygon.nearest({4.5, 3, 7}).isApprox(Vector3d(4, 2, 1)));
  CHECK(polygon.nearest({-1, 0.5, 7}).isApprox(Vector3d(0, 0.5, 1)));
  CHECK(polygon.edge_count() == 4);
  CHECK(polygon.edge_outward_W(1) == Vector3d(1, 0, 0));
  CHECK(polygon.overshoot(1, {3, 1, 0}) == doctest::Approx(-1.0));
}

TEST_CASE("the centroid weighs by area, not by corners") {
  // The corner cut off the unit square adds a vertex on one side; its triangle has area 1/8 and centroid (5/6, 5/6).
  const Polygon polygon({{0, 0, 0}, {1, 0, 0}, {1, 0.5, 0}, {0.5, 1, 0}, {0, 1, 0}});
  const double expected = (0.5 - 0.125 * 5.0 / 6.0) / 0.875;
  CHECK(polygon.centroid_W().isApprox(Vector3d(expected, expected, 0), 1e-14));
}

TEST_CASE("tangents and normal are a right-handed frame, the first along the world's x where it can be") {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    CAPTURE(i);
    const Polygon polygon(map(random_convex(random), random_turn(random)));
    CHECK((polygon.tangent_W(0).cross(polygon.tangent_W(1)) - polygon.normal_W()).norm() < 1e-12);
    CHECK(std::abs(polygon.tangent_W(0).dot(polygon.tangent_W(1))) < 1e-12);
    CHECK(polygon.tangent_W(0).norm() == doctest::Approx(1.0));
  }
  CHECK(Polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).tangent_W(0) == Vector3d::UnitX());
  // A wall across x: its plane has no x direction.
  CHECK(Polygon({{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}).tangent_W(0) == Vector3d::UnitY());
}
