#include "ddp/replan/round_solids.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "scenes.hpp"

namespace {

using namespace mcplan;
using namespace mcplan::ddp;
using Eigen::Vector3d;

/// A floor with a fence across it at x = 0.9 to 1 that has a gap from y = 0.1 to 0.9.
Scene fence() {
  Scene scene = scenes::made_of(
      "fence",
      {scenes::rectangle("floor", -1, 3, -1.5, 1.5, 0), scenes::rectangle("right", 0.9, 1, -1.5, 0.1, 0.6),
       scenes::rectangle("left", 0.9, 1, 0.9, 1.5, 0.6)},
      "floor", "floor", {2.0, 0, 0});
  for (const int i : {1, 2}) scene.surfaces[i].thickness = 0.6;
  for (const int i : {1, 2}) scene.surfaces[i].end_effectors = {"nobody"};
  return scene;
}

/// Upright above this point.
ResolvedStance stance_at(const Scene& scene, const Robot& robot, double x, double y) {
  ResolvedStance out = resolve_stance(scene, robot, scene.goal, "goal");
  out.com_W = {x, y, robot.com_height};
  return out;
}

double inside_fence(const Vector3d& at) {
  const double y = std::max(0.1 - at.y(), at.y() - 0.9);  // how far beside the gap
  return at.x() > 0.9 && at.x() < 1.0 ? y : -1.0;
}

}  // namespace

TEST_CASE("a way round a fence leads through its gap, also from where a push has left a robot close to it") {
  const Scene scene = fence();
  const Robot robot = scenes::humanoid44();
  const ResolvedStance goal = resolve_stance(scene, robot, scene.goal, "goal");
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {0.5, -0.4}, {0.75, 0.0}, {0.8, -0.1}}) {
    CAPTURE(x);
    const RoundSolids round(scene, robot, stance_at(scene, robot, x, y), goal);
    REQUIRE(!round.routes().empty());
    const Route& route = round.routes().front();
    CHECK((route.front() - Vector3d(x, y, 0)).norm() < 1e-9);
    CHECK((route.back() - Vector3d(2, 0, 0)).norm() < 1e-9);
    for (int i = 0; i <= 100; ++i) CHECK(inside_fence(point_on(route, i / 100.0)) < 0.0);
    CHECK(round.is_free({x, y, 0}));
    CHECK(!round.is_free({0.95, -0.5, 0}));
    CHECK(round.is_free({0.95, 0.5, 0}));
  }
}

TEST_CASE("where it leads straight on there is no way round, and where nothing leads on neither") {
  Scene scene = fence();
  const Robot robot = scenes::humanoid44();
  const ResolvedStance goal = resolve_stance(scene, robot, scene.goal, "goal");
  CHECK(RoundSolids(scene, robot, stance_at(scene, robot, 1.5, 0.3), goal).routes().empty());
  scene.surfaces[1].vertices_W = scenes::rectangle("right", 0.9, 1, -1.5, 0.9, 0.6).vertices_W;
  CHECK(RoundSolids(scene, robot, stance_at(scene, robot, 0.0, 0.0), goal).routes().empty());
}

TEST_CASE("what is left of a route falls to nothing along it, and is at least its length") {
  const Route route{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}};
  const double yaw = 0.3;
  const AlongRoute along(route, yaw, 0.05);
  double left = 1e9;
  for (int i = 0; i <= 50; ++i) {
    const AlongRoute::Point& here = along.nearest(point_on(route, i / 50.0));
    CHECK(here.left.sum() <= left);
    CHECK(here.left.sum() >= (route.back() - here.at_W).norm() - 1e-9);
    left = here.left.sum();
  }
  CHECK(left == 0.0);
  CHECK(along.nearest(route.front()).yaw == doctest::Approx(yaw));
  CHECK(along.nearest(route.back()).yaw == doctest::Approx(yaw));
}
