#include "ddp/routes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support.hpp"

namespace {

using namespace mcplan::ddp;
using Eigen::Vector3d;
using mcplan::Scene;

/// Two floors with a hole of `width` between them, and bridges over it at these y.
Scene hole(double width, const std::vector<double>& bridges) {
  Scene scene = scenes::made_of(
      "hole", {scenes::rectangle("a", -1, 0.5, -2, 2, 0), scenes::rectangle("b", 0.5 + width, 4, -2, 2, 0)}, "a", "b",
      {width + 1.0, 0, 0});
  for (std::size_t i = 0; i < bridges.size(); ++i)
    scene.surfaces.push_back(
        scenes::rectangle("bridge" + std::to_string(i), 0.5, 0.5 + width, bridges[i] - 0.3, bridges[i] + 0.3, 0));
  return scene;
}

double length_of(const Route& route) {
  double length = 0.0;
  for (std::size_t i = 1; i < route.size(); ++i) length += (route[i] - route[i - 1]).norm();
  return length;
}

}  // namespace

TEST_CASE("the straight way needs no detour where steps lead along it: the paper's scenes but those with a gap") {
  for (const Scene& scene : scenes::all_four()) {
    const Routes routes = find_routes(scene, scenes::humanoid44());
    CAPTURE(scene.name);
    CHECK(routes.straight == (scene.name == "flat" || scene.name == "stairs"));
    CHECK_FALSE(routes.obstructed);
    CHECK(routes.detours.empty());
  }
  CHECK(find_routes(hole(0.3, {}), scenes::humanoid44()).straight);
}

TEST_CASE("round a hole lead as many routes as there are bridges, the shorter one first, each over its bridge") {
  for (const std::vector<double>& bridges : {std::vector<double>{}, {0.7}, {0.7, -1.2}}) {
    const Scene scene = hole(1.6, bridges);
    const Routes routes = find_routes(scene, scenes::humanoid44());
    CHECK_FALSE(routes.straight);
    REQUIRE(routes.detours.size() == bridges.size());
    for (std::size_t i = 0; i < bridges.size(); ++i) {
      const Route& route = routes.detours[i];
      CHECK((route.front() - Vector3d(0, 0, 0)).norm() < 1e-9);
      CHECK((route.back() - Vector3d(2.6, 0, 0)).norm() < 1e-9);
      // By the nearest edge of the bridge, on which both feet stand, and not much longer than that.
      const double y = std::abs(bridges[i]) - 0.3, least = 2.0 * std::hypot(0.5, y) + 1.6;
      CHECK(length_of(route) > least - 0.3);
      CHECK(length_of(route) < 1.3 * least);
      for (double share : {0.4, 0.5, 0.6}) CHECK(std::abs(point_on(route, share).y() - bridges[i]) < 0.45);
    }
  }
}

TEST_CASE("a post is passed on either side, a fence from wall to wall on none") {
  Scene scene = scenes::flat();
  mcplan::Surface post = scenes::rectangle("post", 0.9, 1.0, -0.05, 0.05, 1.4, "hand");
  post.thickness = 1.4;
  scene.surfaces.push_back(post);
  Routes routes = find_routes(scene, scenes::humanoid44());
  CHECK(routes.obstructed);
  CHECK_FALSE(routes.straight);
  REQUIRE(routes.detours.size() == 2);
  for (const Route& route : routes.detours)
    for (int s = 0; s <= 50; ++s) {
      const Vector3d at = point_on(route, s / 50.0);
      CHECK((at.head<2>() - at.head<2>().cwiseMax(Eigen::Vector2d(0.9, -0.05)).cwiseMin(Eigen::Vector2d(1.0, 0.05)))
                .norm() > 0.15);
    }
  CHECK(point_on(routes.detours[0], 0.5).y() * point_on(routes.detours[1], 0.5).y() < 0.0);
  scene.surfaces.back() = scenes::rectangle("fence", 0.9, 1.0, -20, 20, 0.6, "hand");
  scene.surfaces.back().thickness = 0.35;
  routes = find_routes(scene, scenes::humanoid44());
  CHECK(routes.obstructed);
  CHECK(routes.detours.empty());
}

TEST_CASE("points of a route go by its length from end to end, with its corners rounded") {
  const Route route{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}};
  CHECK((point_on(route, 0.0) - route.front()).norm() < 1e-12);
  CHECK((point_on(route, 1.0) - route.back()).norm() < 1e-12);
  const double total = 1.0 + std::sqrt(1.25);
  CHECK((point_on(route, 0.5 / total) - Vector3d(0.5, 0, 0)).norm() < 1e-9);
  const Vector3d corner = point_on(route, 1.0 / total);
  CHECK((corner - route[1]).norm() > 0.005);
  CHECK((corner - route[1]).norm() < 0.05);
}

TEST_CASE("scenes where nothing stands at both ends are straight") {
  Scene scene = scenes::flat();
  scene.start.contacts = {{"right_foot", "ground"}};
  scene.goal.contacts = {{"left_foot", "ground"}};
  if (scene.surface_index("ground") >= 0) CHECK(find_routes(scene, scenes::humanoid44()).straight);
}

TEST_CASE("the base turns with a route: to its left where that goes left, back again, and not at the ends") {
  const Route left = {{0, 0, 0}, {1, 1, 0}, {3, 1, 0}, {4, 0, 0}};
  CHECK(turn_on(left, 0.0) == 0.0);
  CHECK(turn_on(left, 1.0) == 0.0);
  CHECK(turn_on(left, 0.2) > 0.3);
  CHECK(std::abs(turn_on(left, 0.5)) < 1e-9);
  CHECK(turn_on(left, 0.8) < -0.3);
  CHECK(turn_on({}, 0.5) == 0.0);
  const Route hardly = {{0, 0, 0}, {1, 0.15, 0}, {3, -0.15, 0}, {4, 0, 0}};
  for (int i = 0; i <= 50; ++i) CHECK(turn_on(hardly, i / 50.0) == 0.0);
  CHECK(turn_on({{0, 0, 0}, {1, 0, 0}}, 0.5) == 0.0);
  // A route that comes back turns the base by a quarter at most; one in a turned world turns it as much.
  const Route hook = {{0, 0, 0}, {0, 3, 0}, {-2, 3, 0}, {-2, 5, 0}, {1, 5, 0}};
  for (int i = 0; i <= 50; ++i) CHECK(std::abs(turn_on(hook, i / 50.0)) <= 0.5 * M_PI + 1e-12);
  Route turned;
  for (const Vector3d& at : left) turned.emplace_back(-at.y(), at.x(), at.z());
  for (int i = 0; i <= 50; ++i) CHECK(std::abs(turn_on(turned, i / 50.0) - turn_on(left, i / 50.0)) < 1e-9);
}

TEST_CASE("a block that a foot is set on is gone round as well, one that is hardly higher than the ground is not") {
  for (const double height : {0.15, 0.04}) {
    Scene scene = scenes::flat();
    scene.surfaces.push_back(scenes::rectangle("block", 0.7, 1.3, -0.3, 0.3, height));
    scene.surfaces.back().thickness = height;
    const Routes routes = find_routes(scene, scenes::humanoid44());
    CHECK(routes.straight);
    CHECK(routes.detours.size() == (height > 0.1 ? 2 : 0));
    for (const Route& route : routes.detours) {
      CHECK(std::abs(point_on(route, 0.5).y()) > 0.3);
      for (const Vector3d& at : route) CHECK(at.z() == 0.0);
    }
  }
}

TEST_CASE("the end of a wall is found far from the straight line, and whether there is none") {
  mcplan::Robot robot = scenes::humanoid44();
  for (mcplan::EndEffector& end : robot.end_effectors)  // strides of 0.3 m: five of them end at the wall
    end.reach_min_B.x() = -(end.reach_max_B.x() = end.nominal_B.x() + 0.15);
  Scene scene = scenes::flat();
  scene.surfaces[0] = scenes::rectangle("ground", -8, 10, -8, 8, 0);
  for (const double half : {2.5, 8.0}) {
    scene.surfaces.resize(1);
    scene.surfaces.push_back(scenes::rectangle("wall", 0.9, 1.0, -half, half, 1.5, "hand"));
    scene.surfaces.back().thickness = 1.5;
    const Routes routes = find_routes(scene, robot);
    CHECK(routes.obstructed);
    CHECK(routes.detours.empty() == (half > 5.0));
    CHECK(routes.barrier.has_value() == (half > 5.0));
  }
}

TEST_CASE("a route has room to turn on the spot where that costs little") {
  Scene scene = scenes::flat(3.0);
  scene.surfaces[0] = scenes::rectangle("ground", -2, 6, -5, 5, 0);
  scene.surfaces.push_back(scenes::rectangle("fence", 1.4, 1.5, -1, 1, 1.0, "hand"));
  scene.surfaces.back().thickness = 1.0;
  mcplan::Robot robot = scenes::humanoid44();
  double ahead = 0.4, radius = 0.0;
  for (mcplan::EndEffector& end : robot.end_effectors) {
    if (end.kind != "foot") continue;
    end.nominal_B.x() += ahead;
    end.reach_min_B.x() += ahead;
    end.reach_max_B.x() += ahead;
    radius = std::max(radius, end.nominal_B.head<2>().norm());
    ahead = -ahead;
  }
  const Routes routes = find_routes(scene, robot);
  REQUIRE_FALSE(routes.detours.empty());
  for (int s = 0; s <= 100; ++s) {
    const Eigen::Vector2d at = point_on(routes.detours[0], s / 100.0).head<2>();
    CHECK((at - at.cwiseMax(Eigen::Vector2d(1.4, -1)).cwiseMin(Eigen::Vector2d(1.5, 1))).norm() > 0.9 * radius);
  }
}
