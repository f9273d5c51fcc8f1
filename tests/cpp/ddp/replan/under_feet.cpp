#include "ddp/replan/under_feet.hpp"

#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace mcplan;
using namespace mcplan::ddp;

TEST_CASE("ground is found nearest first, and only where the end-effector may stand") {
  Scene scene = scenes::gap();
  const Robot robot = scenes::humanoid44();
  const Eigen::Vector3d wanted_W(0.1, 0.1, 0.3);
  std::vector<Found> found = grounds_near(scene, robot.end_effectors[0], wanted_W);
  REQUIRE(found.size() == scene.surfaces.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK((found[i].place_W - wanted_W).norm() == doctest::Approx(found[i].distance));
    if (i > 0) CHECK(found[i - 1].distance <= found[i].distance);
  }
  const int nearest = found.front().surface;
  CHECK(ground_at(scene, robot.end_effectors[0], wanted_W).surface == nearest);
  scene.surfaces[nearest].end_effectors = {"nobody"};
  CHECK(ground_at(scene, robot.end_effectors[0], wanted_W).surface == found[1].surface);
  for (Surface& surface : scene.surfaces) surface.end_effectors = {"nobody"};
  CHECK(ground_at(scene, robot.end_effectors[0], wanted_W).surface == kFree);
}

TEST_CASE("the floor that goes on below a block is no ground") {
  const Robot robot = scenes::humanoid44();
  const EndEffector& foot = robot.end_effectors[0];
  Scene scene = scenes::flat();
  const int floor = 0, block = static_cast<int>(scene.surfaces.size());
  const auto at = [&](double x, double z) { return ground_at(scene, foot, Eigen::Vector3d(x, 0.0, z)); };
  const Found before = at(0.5, 0.0);
  REQUIRE(before.surface == floor);
  Surface top = scene.surfaces[floor];
  top.name = "block";
  top.vertices_W = {{0.4, -0.3, 0.1}, {0.8, -0.3, 0.1}, {0.8, 0.3, 0.1}, {0.4, 0.3, 0.1}};
  top.thickness = 0.1;
  scene.surfaces.push_back(top);
  CHECK(at(0.5, 0.0).surface == block);
  CHECK(at(0.5, 0.0).place_W.z() == doctest::Approx(0.1));
  CHECK(at(0.4 - 0.5 * foot.half_size.minCoeff(), 0.0).surface == block);  // half of a sole would be in it
  CHECK(at(0.4 - 2.0 * foot.half_size.minCoeff(), 0.0).surface == floor);
  for (Eigen::Vector3d& vertex_W : scene.surfaces[block].vertices_W) vertex_W.z() = 0.003;  // all but even with it
  CHECK(at(0.5, 0.0).surface == floor);
  for (Eigen::Vector3d& vertex_W : scene.surfaces[block].vertices_W) vertex_W.z() = 0.1;
  scene.surfaces[block].thickness = 0.05;  // a shelf with room below, as far as soles are concerned
  CHECK(at(0.5, 0.0).surface == floor);
}
