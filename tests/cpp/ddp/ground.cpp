#include "ddp/ground.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "support.hpp"

namespace {

using mcplan::Robot;
using mcplan::Scene;
using mcplan::ddp::Ground;
using mcplan::ddp::Place;

Ground ground_of(const Scene& scene, const Robot& robot, double sole_inside = -1.0) {
  return Ground(scene, robot, resolve_stance(scene, robot, scene.start, "start"),
                resolve_stance(scene, robot, scene.goal, "goal"), sole_inside);
}

}  // namespace

TEST_CASE("places are where every foot has ground within 0.4 strides, the looser the farther it is") {
  const Scene scene = scenes::gap();  // ends at 0.5, goes on at 1.3
  const Ground ground = ground_of(scene, scenes::humanoid44());
  CHECK(ground.stride() == doctest::Approx(0.6));
  CHECK(ground.gap() == doctest::Approx(0.24));
  const auto on = ground.places({0.3, 0.0});
  REQUIRE(on.size() == 1);
  CHECK(on[0].height == 0.0);
  CHECK(on[0].looseness == 0.0);
  const auto off = ground.places({0.5 + 0.12, 0.0});
  REQUIRE(off.size() == 1);
  CHECK(off[0].looseness == doctest::Approx(0.5));
  CHECK(ground.places({0.9, 0.0}).empty());
  // Soles that stay on their surface reach less far.
  CHECK(ground_of(scene, scenes::humanoid44(), 1.0).gap() == doctest::Approx(0.14));
}

TEST_CASE("stairs have two places near a riser, and solids that stand are where a trunk cannot be") {
  Scene scene = scenes::stairs();
  const Ground stairs = ground_of(scene, scenes::humanoid44());
  std::vector<double> heights;
  for (const Place& place : stairs.places({0.2, 0.0})) heights.push_back(place.height);
  CHECK(heights.size() >= 1);
  CHECK(std::is_sorted(heights.rbegin(), heights.rend()));
  scene = scenes::flat();
  mcplan::Surface post = scenes::rectangle("post", 0.9, 1.0, -0.05, 0.05, 1.4, "hand");
  post.thickness = 1.4;
  scene.surfaces.push_back(post);
  mcplan::Surface kerb = scenes::rectangle("kerb", 0.4, 0.5, -0.05, 0.05, 0.1, "hand");
  kerb.thickness = 0.1;
  scene.surfaces.push_back(kerb);
  mcplan::Surface beam = scenes::rectangle("beam", 0.0, 0.1, -1, 1, 2.0, "hand");
  scene.surfaces.push_back(beam);
  const Ground ground = ground_of(scene, scenes::humanoid44());
  const auto blocked = [&](double x, double y) {
    const auto places = ground.places({x, y});
    REQUIRE(places.size() == 1);
    return places[0].solid >= 0;
  };
  CHECK(blocked(0.95, 0.0));
  CHECK(blocked(0.95, 0.2));
  CHECK_FALSE(blocked(0.95, 0.3));
  CHECK_FALSE(blocked(0.45, 0.0));  // lower than a step
  CHECK_FALSE(blocked(0.05, 0.0));  // above the head
}

TEST_CASE("what a robot has above its CoM passes no place that is lower or narrower, but for what it ducks") {
  Scene scene = scenes::flat();
  Robot robot = scenes::humanoid44();  // CoM at 0.7 m: what is above 0.91 m is out of the way of its trunk
  robot.trunk = {{{0, 0, 0}, {0, 0, 0.5}, 0.06}, {{0, -0.3, 0.4}, {0, 0.3, 0.4}, 0.05}};
  const auto blocked = [&](double bottom, double y) {
    scene = scenes::flat();
    mcplan::Surface beam = scenes::rectangle("beam", 0.5, 0.6, 0.0, 1.0, 2.0, "hand");
    beam.thickness = 2.0 - bottom;
    scene.surfaces.push_back(beam);
    const auto places = ground_of(scene, robot).places({0.55, y});
    REQUIRE(places.size() == 1);
    return places[0].solid >= 0;
  };
  CHECK(blocked(1.17, 0.2));  // ducked by 0.084 m the head is 1.176 m above the ground
  CHECK_FALSE(blocked(1.18, 0.2));
  CHECK(blocked(1.0, -0.3));  // a shoulder, 0.35 m and 0.035 m wide
  CHECK_FALSE(blocked(1.0, -0.4));
  CHECK_FALSE(blocked(1.08, -0.3));  // above the shoulders
  CHECK(blocked(1.08, -0.05));
  // Hands hang beside it: there is a way, but little room.
  robot.end_effectors[2].nominal_B.y() = -0.4;
  scene.surfaces.back().thickness = 2.0 - 0.6;
  const auto beside = ground_of(scene, robot).places({0.55, -0.45});
  REQUIRE(beside.size() == 1);
  CHECK(beside[0].solid < 0);
  CHECK(beside[0].tight);
  CHECK_FALSE(ground_of(scene, robot).places({0.55, -0.6})[0].tight);
  robot.trunk.clear();
  CHECK_FALSE(blocked(1.0, 0.2));
}
