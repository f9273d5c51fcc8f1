#include "plan/sole_depth.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "mcplan/base/rotation.hpp"

namespace {

using namespace mcplan;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kHeight = 0.02;  ///< of a foot [m]

/// A box with its top at `top`, turned and shifted like the frame.
Solid box(double length, double width, double top, double thickness, const Matrix3d& frame = Matrix3d::Identity(),
          const Vector3d& shift = Vector3d::Zero()) {
  std::vector<Vector3d> corners;
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    corners.push_back(shift + frame * Vector3d(0.5 * x * length, 0.5 * y * width, top));
  return {Polygon(corners), thickness};
}

EndEffector foot(double half_x, double half_y) {
  EndEffector out;
  out.half_size = {half_x, half_y};
  return out;
}

/// Whether any of many points of a sole is within a solid by more than a little.
bool sampled_inside(const Solid& solid, const EndEffector& end, const Vector3d& place, const Matrix3d& sole) {
  constexpr int kPoints = 60;
  for (int i = 0; i <= kPoints; ++i)
    for (int j = 0; j <= kPoints; ++j) {
      const Vector3d p = place + (2.0 * i / kPoints - 1.0) * end.half_size.x() * sole.col(0) +
                         (2.0 * j / kPoints - 1.0) * end.half_size.y() * sole.col(1);
      const double height = solid.polygon.height(p);
      if (height < 0.0 && height > -solid.thickness && solid.polygon.outside(p) < 0.0) return true;
    }
  return false;
}

}  // namespace

TEST_CASE("a sole is inside of a solid by the shorter of the ways up and to a side") {
  const EndEffector sole = foot(0.1, 0.05);
  const Matrix3d level = Matrix3d::Identity();
  const std::vector<Solid> solids{box(10, 10, 0.0, 0.3), box(0.05, 4, 0.1, 0.1)};
  const auto depth = [&](double x, double z = 0.0) { return sole_depth(solids, 0, sole, kHeight, {x, 0, z}, level); };
  CHECK(depth(0.0) == doctest::Approx(0.1));         // astride: up
  CHECK(depth(0.11) == doctest::Approx(0.015));      // the heel on it: ahead
  CHECK(depth(-0.12) == doctest::Approx(0.005));     // the toe
  CHECK(depth(0.126) == 0.0);                        // beside
  CHECK(depth(0.0, 0.07) == doctest::Approx(0.03));  // up, from higher
  CHECK(depth(0.0, 0.1) == doctest::Approx(0.0));    // on it
  CHECK(sole_depth(solids, 1, sole, kHeight, {0, 0, 0.1}, level) == 0.0);
  CHECK(sole_depth(solids, 1, sole, kHeight, {0, 0, -0.01}, level) == doctest::Approx(0.01));  // in the floor
  CHECK(sole_depth(solids, 0, foot(0.0, 0.0), kHeight, {0.01, 0, 0.05}, level) == doctest::Approx(0.015));  // a point
}

TEST_CASE("what lies over a sole is not in its way, what stands on the floor is") {
  const EndEffector sole = foot(0.1, 0.05);
  const auto depth = [&](double top, double thickness) {
    return sole_depth({box(2, 2, top, thickness)}, -1, sole, kHeight, Vector3d::Zero(), Matrix3d::Identity());
  };
  CHECK(depth(0.7, 0.05) == 0.0);                    // a table
  CHECK(depth(0.17, 0.04) == 0.0);                   // the next tread's nosing
  CHECK(depth(0.1, 0.1) == doctest::Approx(0.1));    // a block
  CHECK(depth(0.1, 0.085) == doctest::Approx(0.1));  // one that hangs lower than a foot is high
}

TEST_CASE("soles that stand at any angle to a solid are inside where one of their points is") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const EndEffector sole = foot(0.12, 0.06);
  int inside = 0, outside = 0;
  for (int i = 0; i < 4000; ++i) {
    const Matrix3d frame = rotation_from_rpy({0.5 * unit(random), 0.5 * unit(random), 3.0 * unit(random)});
    const Solid solid = box(0.3, 0.2, 0.0, 0.4, frame, {20.0, -7.0, 1.0});
    const Matrix3d turned = rotation_from_rpy({0.5 * unit(random), 0.5 * unit(random), 3.0 * unit(random)});
    const Vector3d place =
        Vector3d(20.0, -7.0, 1.0) + Vector3d(0.3 * unit(random), 0.25 * unit(random), 0.15 * unit(random) - 0.05);
    const double depth = sole_depth({solid}, -1, sole, kHeight, place, turned);
    CAPTURE(i);
    if (depth == 0.0) {
      ++outside;
      CHECK_FALSE(sampled_inside(solid, sole, place, turned));
    } else if (depth > 5e-3) {
      ++inside;
      CHECK(sampled_inside(solid, sole, place, turned));
    }
  }
  CHECK(inside > 500);
  CHECK(outside > 500);
}
