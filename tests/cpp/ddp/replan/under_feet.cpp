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
