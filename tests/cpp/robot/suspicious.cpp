#include <doctest/doctest.h>

#include "mcplan/base/error.hpp"
#include "mcplan/robot/robot_files.hpp"

using namespace mcplan;

TEST_CASE("built-in robots are meant") {
  for (const std::string& name : built_in("robots")) {
    CAPTURE(name);
    CHECK(suspicious_geometry(load_robot(name)).empty());
  }
}

TEST_CASE("numbers of a robot in other units, and an inertia that no body has, are suspicious one by one") {
  const struct {
    const char* field;
    void (*spoil)(Robot&);
  } cases[] = {
      {"mass", [](Robot& robot) { robot.mass *= 1e3; }},
      {"phase_duration", [](Robot& robot) { robot.phase_duration *= 1e3; }},
      {"inertia",
       [](Robot& robot) {
         robot.inertia = {1.0, 1.0, 2.1};
       }},
      {"swing_height", [](Robot& robot) { robot.swing_height = 100.0; }},
      {"end_effectors[1].half_size",
       [](Robot& robot) {
         robot.end_effectors[1].half_size = {100.0, 50.0};
       }},
      {"end_effectors[0].reach_cut.b",
       [](Robot& robot) {
         robot.end_effectors[0].reach_cut.A = Eigen::RowVector3d(0.0, 0.0, 1.0);
         robot.end_effectors[0].reach_cut.b = Eigen::VectorXd::Constant(1, 449.0);
       }},
      {"end_effectors[0].yaw_range",
       [](Robot& robot) {
         robot.end_effectors[0].yaw_range = {-45.0, 45.0};
       }},
  };
  for (const auto& each : cases) {
    CAPTURE(each.field);
    Robot robot = load_robot("humanoid44");
    each.spoil(robot);
    const auto found = suspicious_geometry(robot);
    REQUIRE(found.size() == 1);
    CHECK(found[0].field == each.field);
  }
}

TEST_CASE("a robot in millimetres is told of once, by its height") {
  Robot robot = load_robot("humanoid44");
  robot.com_height *= 1e3;
  for (EndEffector& end : robot.end_effectors) {
    end.nominal_B *= 1e3;
    end.reach_min_B *= 1e3;
    end.reach_max_B *= 1e3;
  }
  const auto found = suspicious_geometry(robot);
  REQUIRE(found.size() == 1);
  CHECK(found[0].field == "com_height");
  CHECK_THROWS_AS(suspicious_geometry(Robot()), InvalidRobot);
}
