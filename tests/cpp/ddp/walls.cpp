#include "ddp/walls.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "ddp/problem.hpp"
#include "support.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;
using mcplan::Polygon;

/// A strip of ground ahead of another one that ends at x = 1 m, at a height [m], and a gap between them [m].
std::vector<Polygon> strips(double height, double gap = 0.0) {
  std::vector<Polygon> out;
  for (const auto& [from, to, z] : {std::tuple{0.0, 1.0, 0.0}, {1.0 + gap, 2.0, height}})
    out.emplace_back(std::vector<Vector3d>{{from, -1.0, z}, {to, -1.0, z}, {to, 1.0, z}, {from, 1.0, z}});
  return out;
}

/// Heights of the walls beyond the edges of a strip, where there are any; none but that ahead may have one.
std::vector<double> walls_of(const std::vector<Polygon>& polygons, int surface, double thickness = 0.05) {
  const std::vector<double> thick(polygons.size(), thickness);
  const mcplan::ddp::Walls walls(polygons, thick, 1.0);
  std::vector<double> out;
  for (int edge = 0; edge < polygons[surface].edge_count(); ++edge)
    if (const double height = walls.beyond(surface, edge); height > 0.0) {
      CHECK(polygons[surface].edge_outward_W(edge).x() > 0.99);
      out.push_back(std::round(1e6 * height) * 1e-6);
    }
  return out;
}

const std::vector<double> kNone;

}  // namespace

TEST_CASE("ground that is higher beside an edge is a wall, for what stands below alone") {
  CHECK(walls_of(strips(0.12), 0) == std::vector<double>{0.12});
  CHECK(walls_of(strips(0.12), 1) == kNone);
  CHECK(walls_of(strips(0.04), 0) == std::vector<double>{0.04});
  CHECK(walls_of(strips(0.12, 0.05), 0) == std::vector<double>{0.12});
}

TEST_CASE("a low step, ground further away and what hangs high are none") {
  CHECK(walls_of(strips(0.02), 0) == kNone);
  CHECK(walls_of(strips(0.12, 0.1), 0) == kNone);
  CHECK(walls_of(strips(1.2), 0) == kNone);
  CHECK(walls_of(strips(1.2), 0, 1.3) == std::vector<double>{1.2});  // it stands on the ground
}

TEST_CASE("a patch that rises beside the edge is a wall where it does") {
  std::vector<Polygon> polygons = strips(0.0);
  polygons[1] = Polygon({{1.0, -1.0, -0.1}, {2.0, -1.0, -0.1}, {2.0, 1.0, 0.1}, {1.0, 1.0, 0.1}});
  const std::vector<double> walls = walls_of(polygons, 0);
  REQUIRE(walls.size() == 1);
  CHECK(walls.front() == doctest::Approx(0.096).epsilon(0.01));  // of the places that are looked at
}

TEST_CASE("footholds keep from walls behind and beside them, as far as narrow ground allows, not from those ahead") {
  for (const double length : {1.0, 0.26}) {
    CAPTURE(length);
    const auto margin = [&](double before, double beyond, double ahead) {
      const mcplan::Scene scene = scenes::made_of(
          "steps",
          {scenes::rectangle("near", -1, 1, -1, 1, before), scenes::rectangle("tread", 1, 1 + length, -1, 1, 0),
           scenes::rectangle("far", 1 + length, 3, -1, 1, beyond)},
          "near", "far", {2.0, 0.0, beyond});
      mcplan::ddp::Options options = phases(20);
      options.sole_inside = 1.0;
      const mcplan::ddp::Problem problem(scene, scenes::humanoid44(), options);
      const Polygon& tread = problem.polygons[1];
      for (int edge = 0; edge < tread.edge_count(); ++edge)
        if (ahead * tread.edge_outward_W(edge).x() > 0.99)
          return problem.foothold_margin(1, 1, edge) * problem.units.length / problem.similarity.length;
      return -1.0;
    };
    const double level = margin(0.0, 0.0, -1.0), more = margin(0.1, 0.0, -1.0) - level;
    CHECK(margin(0.04, 0.0, -1.0) - level == doctest::Approx(0.02));
    if (length > 0.5)
      CHECK(more == doctest::Approx(0.04 / 0.877 * 0.7));
    else
      CHECK((more > 0.0 && more < 0.04));
    CHECK(margin(0.0, 0.1, 1.0) == margin(0.0, 0.0, 1.0));
  }
}
