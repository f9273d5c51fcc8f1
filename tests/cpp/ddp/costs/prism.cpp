#include "ddp/costs/prism.hpp"

#include <doctest/doctest.h>

#include "ddp/support.hpp"
#include "mcplan/base/rotation.hpp"
#include "plan/convex_min.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

struct Line {
  mcplan::Polygon polygon;
  double thickness;
  Vector3d from, along;
  double distance(double s) const { return ddp::outside_solid(polygon, thickness, from + s * along).distance; }
};

/// A tilted polygon of three to six vertices above a line that may pass beside it, cross it or lie within.
Line any_line(Random& random) {
  const Eigen::Matrix3d tilt = mcplan::rotation_from_rpy(noise(random, 3, 0.6));
  const int count = 3 + static_cast<int>(random() % 4);
  std::vector<Vector3d> vertices;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * 3.14159265358979 * (i + uniform(random, -0.2, 0.2)) / count;
    vertices.push_back(tilt * Vector3d(0.5 * std::cos(angle), 0.3 * std::sin(angle), 0.0));
  }
  const Vector3d from = noise(random, 3, 0.6), to = noise(random, 3, 0.6);
  return {mcplan::Polygon(vertices), uniform(random, 0.05, 0.6), from, to - from};
}

}  // namespace

TEST_CASE("where on a line a solid is nearest: as the golden section finds it") {
  Random random(3);
  int inside = 0, between = 0;
  for (int i = 0; i < 2000; ++i) {
    const Line line = any_line(random);
    const auto distance = [&](double s) { return line.distance(s); };
    const double golden = std::min({distance(0.0), distance(1.0), distance(mcplan::convex_min(distance))});
    const ddp::NearestOnLine found = ddp::nearest_on_line(line.polygon, line.thickness, line.from, line.along);
    CHECK(found.outside.distance < golden + 1e-9);
    CHECK(found.outside.distance > golden - 3e-8);  // which looks for the place within 1e-8
    CHECK(std::abs(found.outside.distance - distance(found.s)) < 1e-12);
    inside += golden < 0.0;
    between += found.s > 0.0 && found.s < 1.0;
  }
  CHECK(inside > 100);
  CHECK(between > 500);
}

TEST_CASE("where on a line a solid is nearest: further off than is of interest, it is told as some place that is") {
  Random random(4);
  int nearer = 0;
  for (int i = 0; i < 2000; ++i) {
    const Line line = any_line(random);
    const double room = uniform(random, 0.0, 0.4);
    const double least = ddp::nearest_on_line(line.polygon, line.thickness, line.from, line.along).outside.distance;
    const auto found = ddp::nearest_on_line(line.polygon, line.thickness, line.from, line.along, room).outside;
    nearer += least < room;
    if (least < room)
      CHECK(std::abs(found.distance - least) < 1e-9);
    else
      CHECK(found.distance >= room);
  }
  CHECK(nearer > 200);
  CHECK(nearer < 1800);
}

TEST_CASE("where on a line a solid is nearest: a point is a line, too") {
  Random random(5);
  const Line line = any_line(random);
  const ddp::NearestOnLine found = ddp::nearest_on_line(line.polygon, line.thickness, line.from, Vector3d::Zero(), 0.1);
  CHECK(std::abs(found.outside.distance - line.distance(0.0)) < 1e-12);
}
