#include <doctest/doctest.h>

#include <string>

#include "ddp/impossible.hpp"
#include "support.hpp"

namespace {

using namespace mcplan::ddp;
using mcplan::Robot;
using mcplan::Scene;

}  // namespace

TEST_CASE("a goal, or a start, whose soles would be in a solid is told, one beside it or on top of it is not") {
  const Robot robot = scenes::humanoid44();
  const auto in_box = [&](double x, double height, const std::string& who) {
    Scene scene =
        scenes::made_of("ground", {scenes::rectangle("ground", -3, 3, -3, 3, 0)}, "ground", "ground", {1.5, 0, 0});
    scene.surfaces.push_back(scenes::rectangle("box", x - 0.6, x + 0.6, -0.8, 0.8, height, who));
    scene.surfaces.back().thickness = height;
    return scene;
  };
  const auto told = sole_in_solid(in_box(1.5, 0.1, "hand"), robot, true);
  REQUIRE(told);
  CHECK(told->violation.name == "clearance");
  CHECK(told->violation.surface == "box");
  CHECK(told->message.find("inside the solid of \"box\"") != std::string::npos);
  CHECK(sole_in_solid(in_box(0.0, 0.1, "hand"), robot, false));
  CHECK_FALSE(sole_in_solid(in_box(0.0, 0.1, "hand"), robot, true));
  CHECK_FALSE(sole_in_solid(in_box(2.3, 0.1, "hand"), robot, true));    // in front of it there is ground in reach
  CHECK_FALSE(sole_in_solid(in_box(1.5, 0.025, "hand"), robot, true));  // no deeper than the checker takes
  Scene above = in_box(1.5, 0.6, "hand");
  above.surfaces.back().thickness = 0.1;  // a table: feet stand below it
  CHECK_FALSE(sole_in_solid(above, robot, true));
  Scene on_top = in_box(1.5, 0.1, "foot");
  on_top.goal.contacts = {{"foot", "box"}};
  on_top.goal.position_W.z() = 0.1;
  CHECK_FALSE(sole_in_solid(on_top, robot, true));
}
