#include <doctest/doctest.h>

#include <cmath>

#include "ddp/impossible.hpp"
#include "support.hpp"

namespace {

using Eigen::Vector3d;
using mcplan::Robot;
using mcplan::Scene;
using mcplan::ddp::why_impossible;

}  // namespace

TEST_CASE("a goal at which the robot's trunk would be in a solid is told, by more than all that the checker allows") {
  // Depth within 5 mm, CoM within 10 mm, angles within 3 x 0.01 + 1 degree about a head 0.5 m above the CoM.
  const double allowed = 5e-3 + 0.01 + 2e-8 + (0.03 + M_PI / 180.0) * 0.5;
  Robot robot = scenes::humanoid44();
  robot.trunk = {{Vector3d(0, 0, 0), Vector3d(0, 0, 0.5), 0.07}};
  const auto told = [&](double bottom, double x) {
    Scene scene = scenes::flat(1.0);
    scene.surfaces.push_back(scenes::rectangle("ceiling", x - 0.3, x + 0.3, -1, 1, 2.0, "hand"));
    scene.surfaces.back().thickness = 2.0 - bottom;
    return why_impossible(scene, robot, false);
  };
  CHECK_FALSE(told(1.27 - allowed + 1e-6, 1.0));
  const auto found = told(1.27 - allowed - 1e-6, 1.0);
  REQUIRE(found);
  CHECK(found->message.rfind("goal: the trunk of humanoid44 would be ", 0) == 0);
  CHECK(found->violation.name == "trunk");
  CHECK(found->violation.surface == "ceiling");
  CHECK(found->violation.value == doctest::Approx(allowed));
  CHECK(told(1.1, 0.0));
  CHECK_FALSE(told(1.1, 0.5));  // between both
  robot.trunk.clear();
  CHECK_FALSE(told(1.1, 1.0));
}
