#include <doctest/doctest.h>

#include "mcplan/planar/robot_files.hpp"

using namespace mcplan;

TEST_CASE("a gravity of millimetres is suspicious beside limbs of metres, and not beside limbs of millimetres") {
  for (const std::string& name : built_in("planar_robots")) {
    CAPTURE(name);
    PlanarRobot robot = load_planar_robot(name);
    CHECK(suspicious_geometry(robot).empty());
    robot.gravity *= 1000.0;
    const auto found = suspicious_geometry(robot);
    REQUIRE(found.size() == 1);
    CHECK(found[0].field == "gravity");
    for (PlanarBody& body : robot.bodies) body.joint_P *= 1000.0;
    CHECK(suspicious_geometry(robot).empty());
  }
}
