#include "ddp/foothold_lattice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "plan/swing_lift.hpp"
#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;
using Eigen::Vector3d;

/// A floor, a block of this height across the way, and floor again, [m].
mcplan::Scene block(double height) {
  mcplan::Scene scene = scenes::flat();
  scene.surfaces = {scenes::rectangle("near", -1.0, 0.4, -1.0, 1.0, 0.0),
                    scenes::rectangle("block", 0.4, 0.9, -1.0, 1.0, height),
                    scenes::rectangle("far", 0.9, 3.0, -1.0, 1.0, 0.0)};
  scene.surfaces[1].thickness = height;
  scene.start.contacts = {{"foot", "near"}};
  scene.goal.contacts = {{"foot", "far"}};
  scene.goal.position_W = {1.5, 0.0, 0.0};
  return scene;
}

LatticePoint standing(const Problem& problem, double x_m, double y_m, int surface, double z_m = 0.0) {
  LatticePoint out;
  out.place = Vector3d(x_m, y_m, z_m) / problem.units.length;
  out.surface = surface;
  return out;
}

}  // namespace

TEST_CASE("footholds lie on their surfaces, inside of what their margins ask for, in order of their stations") {
  const Problem problem(block(0.1), scenes::humanoid44(), phases(18));
  const FootholdLattice lattice(problem, {0, 1});
  CHECK(lattice.length() == doctest::Approx(1.5 / problem.units.length));
  bool seen[3] = {};
  for (int foot : {0, 1}) {
    const auto [first, last] = lattice.between(foot, -1.0, 2.0 * lattice.length());
    REQUIRE(last - first > 100);
    for (int i = first; i < last; ++i) {
      const LatticePoint& at = lattice.at(foot, i);
      const mcplan::Polygon& polygon = problem.polygons[at.surface];
      CHECK(std::abs(polygon.height(at.place)) < 1e-12);
      for (int edge = 0; edge < polygon.edge_count(); ++edge)
        CHECK(polygon.overshoot(edge, at.place) < 1e-9 - problem.foothold_margin(foot, at.surface, edge));
      if (i > first) CHECK(at.station >= lattice.at(foot, i - 1).station);
      seen[at.surface] = true;
    }
    CHECK(lattice.at(foot, FootholdLattice::kStart)
              .place.isApprox(problem.start.segment<3>(problem.layout.end(foot)), 1e-12));
    const auto [some, few] = lattice.between(foot, 0.5, 0.7);
    CHECK((some > first && few < last && some < few));
    CHECK((lattice.at(foot, some).station >= 0.5 && lattice.at(foot, few).station >= 0.7));
  }
  CHECK((seen[0] && seen[1] && seen[2]));
}

TEST_CASE("a surface that is narrower than its margins has the foothold in its middle") {
  mcplan::Scene scene = block(0.1);
  scene.surfaces[1] = scenes::rectangle("block", 0.6, 0.78, -1.0, 1.0, 0.1);
  Options whole_soles = phases(18);
  whole_soles.sole_inside = 1.0;
  const Problem problem(scene, scenes::humanoid44(), whole_soles);
  const FootholdLattice lattice(problem, {0, 1});
  const auto [first, last] = lattice.between(0, -1.0, 10.0);
  int on = 0;
  for (int i = first; i < last; ++i) {
    if (lattice.at(0, i).surface != 1) continue;
    ++on;
    CHECK(problem.units.length * lattice.at(0, i).place.x() == doctest::Approx(0.69).epsilon(0.02));
  }
  CHECK(on > 0);
}

TEST_CASE("no foot stands where a solid stands up") {
  mcplan::Scene scene = scenes::flat();
  scene.surfaces = {scenes::rectangle("ground", -1.0, 3.0, -1.0, 1.0, 0.0)};
  scene.surfaces.push_back(scenes::rectangle("box", 0.5, 0.9, -0.5, 0.0, 0.3, "hand"));
  scene.surfaces[1].thickness = 0.3;
  scene.start.contacts = scene.goal.contacts = {{"foot", "ground"}};
  const Problem problem(scene, scenes::humanoid44(), phases(18));
  const FootholdLattice lattice(problem, {0, 1});
  for (int foot : {0, 1}) {
    const auto [first, last] = lattice.between(foot, -1.0, 10.0);
    for (int i = first; i < last; ++i) {
      const Vector3d at = problem.units.length * lattice.at(foot, i).place;
      // Half a sole is 0.1 m long and 0.05 m wide.
      CHECK(!(at.x() > 0.41 && at.x() < 0.99 && at.y() > -0.54 && at.y() < 0.04));
    }
  }
}

TEST_CASE("no foot stands where what hangs over it is in the way of the leg") {
  for (const double height : {0.3, 0.6, 1.2}) {
    mcplan::Scene scene = scenes::flat();
    scene.surfaces = {scenes::rectangle("ground", -1.0, 3.0, -1.0, 1.0, 0.0)};
    scene.surfaces.push_back(scenes::rectangle("shelf", 0.5, 0.9, -1.0, 1.0, height, "hand"));
    scene.surfaces[1].thickness = 0.05;
    scene.start.contacts = scene.goal.contacts = {{"foot", "ground"}};
    const Problem problem(scene, scenes::humanoid44(), phases(18));
    const FootholdLattice lattice(problem, {0, 1});
    const auto [first, last] = lattice.between(0, -1.0, 10.0);
    int below = 0;
    for (int i = first; i < last; ++i) {
      const double x = problem.units.length * lattice.at(0, i).place.x();
      below += lattice.at(0, i).surface == 0 && x > 0.5 && x < 0.9;
    }
    CHECK((below > 0) == (height > 1.0));
  }
}

TEST_CASE("a swing is lifted over what lies between, by what the shape of its lift says") {
  const double height = 0.12;
  const Problem problem(block(height), scenes::humanoid44(), phases(18));
  const FootholdLattice lattice(problem, {0, 1});
  const double unit = problem.units.length;
  CHECK(lattice.lift(0, standing(problem, 0.0, -0.1, 0), standing(problem, 0.2, -0.1, 0)) == 0.0);
  // Across the whole block: half way the sole is above its middle, and b(1/2) = 1.
  const double over = lattice.lift(0, standing(problem, 0.2, -0.1, 0), standing(problem, 1.1, -0.1, 2));
  CHECK(unit * over >= height);
  // The toe comes to the edge, 0.1 m ahead of the middle, when the quintic has gone 0.1 of 0.9 m.
  double needed = 0.0;
  for (int i = 1; i < 16; ++i) {
    const double s = i / 16.0, gone = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
    const double toe = 0.2 + 0.9 * gone + 0.1, heel = toe - 0.2;
    if (toe > 0.4 && heel < 0.9)
      needed = std::max(needed, (height + unit * problem.swing_room) / mcplan::SwingLift(s).value());
  }
  CHECK(unit * over == doctest::Approx(needed).epsilon(1e-9));
  // Up onto the block, and from further away by less.
  const double up = lattice.lift(0, standing(problem, 0.25, -0.1, 0), standing(problem, 0.65, -0.1, 1, height));
  const double from_afar = lattice.lift(0, standing(problem, 0.1, -0.1, 0), standing(problem, 0.65, -0.1, 1, height));
  CHECK((up > from_afar && from_afar > 0.0));
}

TEST_CASE("a foot passes below what is high, and lies on a slope as it does") {
  mcplan::Scene scene = scenes::flat();
  scene.surfaces = {scenes::rectangle("ground", -1.0, 3.0, -1.0, 1.0, 0.0)};
  scene.surfaces.push_back(scenes::rectangle("table", 0.3, 0.9, -0.5, 0.5, 0.8, "hand"));
  scene.surfaces[1].thickness = 0.05;
  scene.start.contacts = scene.goal.contacts = {{"foot", "ground"}};
  const Problem below(scene, scenes::humanoid44(), phases(18));
  CHECK(FootholdLattice(below, {0, 1}).lift(0, standing(below, 0.2, 0.0, 0), standing(below, 1.0, 0.0, 0)) == 0.0);

  scene.surfaces = {scenes::rectangle("ground", -1.0, 3.0, -1.0, 1.0, 0.0)};
  for (Vector3d& vertex : scene.surfaces[0].vertices_W) vertex.z() = 0.2 * vertex.x();
  scene.goal.position_W.z() = 0.2 * scene.goal.position_W.x();
  const Problem slope(scene, scenes::humanoid44(), phases(18));
  const FootholdLattice lattice(slope, {0, 1});
  CHECK(lattice.lift(0, standing(slope, 0.2, 0.0, 0, 0.04), standing(slope, 0.5, 0.0, 0, 0.1)) < 1e-9);
}
