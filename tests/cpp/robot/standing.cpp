#include "mcplan/robot/standing.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "mcplan/base/error.hpp"
#include "mcplan/ddp/plan.hpp"
#include "mcplan/robot/robot_files.hpp"
#include "mcplan/scene/scene_files.hpp"

namespace {

using Eigen::Vector3d;

/// A unit square whose normal is at an angle to the vertical.
mcplan::Surface tilted(double angle_deg, double friction, bool grasp) {
  const double angle = angle_deg * std::acos(-1.0) / 180.0, s = std::sin(angle), c = std::cos(angle);
  const Vector3d across(c, 0, -s), along(0, 1, 0);  // across x along = the normal (s, 0, c)
  mcplan::Surface surface;
  surface.name = "a";
  surface.vertices_W = {Vector3d::Zero(), across, across + along, along};
  surface.friction = friction;
  surface.grasp = grasp;
  return surface;
}

/// What is refused of a change of the scene flat for humanoid44, or "".
template <class Change>
std::string refused(const Change& change) {
  mcplan::Scene scene = mcplan::load_scene("flat");
  mcplan::Surface ceiling = scene.surfaces.front();
  ceiling.name = "ceiling";
  ceiling.vertices_W.assign(scene.surfaces.front().vertices_W.rbegin(), scene.surfaces.front().vertices_W.rend());
  for (Vector3d& vertex : ceiling.vertices_W) vertex.z() += 0.01;
  scene.surfaces.front().name = "ground";
  scene.surfaces = {scene.surfaces.front(), ceiling};
  scene.start.contacts = scene.goal.contacts = {{"foot", "ground"}};
  change(scene);
  try {
    mcplan::require_standing(scene, mcplan::load_robot("humanoid44"));
  } catch (const mcplan::InvalidScene& found) {
    return found.what();
  }
  return "";
}

TEST_CASE("a surface holds up what its friction cone can") {
  // The cone of a normal at this angle to the vertical reaches above the horizon up to 90 degrees + atan(friction).
  struct Case {
    double angle_deg, friction;
    bool grasp, expected;
  };
  for (const Case& each : {Case{0, 0.1, false, true}, Case{89, 0.1, false, true}, Case{91, 0.1, false, true},
                           Case{97, 0.1, false, false}, Case{180, 2.0, false, false}, Case{180, 0.1, true, true}}) {
    CAPTURE(each.angle_deg);
    CHECK(mcplan::holds_up(tilted(each.angle_deg, each.friction, each.grasp)) == each.expected);
  }
}

TEST_CASE("a stance that cannot stand is refused by name, and both stances in one go") {
  CHECK(refused([](mcplan::Scene&) {}) == "");
  const std::string down = "must hold the robot up: corners of ground run counter-clockwise seen from above, got ";
  CHECK(refused([](mcplan::Scene& scene) {
          scene.start.contacts = {{"foot", "ceiling"}};
        }) == "start.contacts: " + down + "\"ceiling\" faces down");
  const std::string both = refused([](mcplan::Scene& scene) {
    scene.start.contacts = {{"left_foot", "ceiling"}, {"right_foot", "ceiling"}};
    scene.goal.position_W.z() += 2.0;
  });
  CHECK(both.find("start.contacts: " + down +
                  "\"ceiling\" faces down\ngoal.position: must be where humanoid44 reaches") == 0);
  CHECK(both.find("_foot would stand 2 m off \"ground\"") != both.npos);
  // A hand may press from below while feet stand.
  CHECK(refused([](mcplan::Scene& scene) { scene.start.contacts["left_hand"] = "ceiling"; }).find(down) ==
        std::string::npos);
}

TEST_CASE("a plan is refused where the robot cannot stand, and data that are not valid are no crash") {
  mcplan::Scene scene = mcplan::load_scene("flat");
  const mcplan::Robot robot = mcplan::load_robot("humanoid44");
  scene.goal.position_W.z() += 2.0;
  CHECK_THROWS_AS(mcplan::ddp::plan(scene, robot), mcplan::InvalidScene);
  scene.start.contacts = {{"foot", "nowhere"}};
  CHECK_THROWS_AS(mcplan::require_standing(scene, robot), mcplan::InvalidScene);
  CHECK_THROWS_AS(mcplan::require_standing(mcplan::load_scene("flat"), mcplan::Robot()), mcplan::InvalidRobot);
}

}  // namespace
