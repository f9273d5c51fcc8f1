#include "mcplan/planar/robot_files.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <fstream>

#include "mcplan/base/error.hpp"
#include "planar/robots.hpp"

using namespace mcplan;
namespace fs = std::filesystem;

TEST_CASE("every planar robot survives a file to the last bit") {
  const fs::path file = fs::temp_directory_path() / ("mcplan_planar_robot_" + std::to_string(getpid()) + ".toml");
  const std::vector<std::string> names = built_in("planar_robots");
  CHECK(names == std::vector<std::string>{"climber9", "walker9"});
  std::vector<PlanarRobot> robots = {planar::stander()};
  for (const std::string& name : names) {
    robots.push_back(load_planar_robot(name));
    CHECK(robots.back().name == name);
  }
  for (const PlanarRobot& robot : robots) {
    CAPTURE(robot.name);
    save_planar_robot(robot, file);
    CHECK(load_planar_robot(file.string()) == robot);
    PlanarRobot other = robot;
    other.bodies.back().com_B.x() += 1e-17;
    CHECK(other != robot);
  }
  fs::remove(file);
}

TEST_CASE("an unknown planar robot lists those that exist") {
  try {
    load_planar_robot("climber");
    FAIL("it was found");
  } catch (const UnknownRobot& found) {
    CHECK(
        std::string(found.what()).rfind("no robot 'climber' and no file of that name. Did you mean 'climber9'? ", 0) ==
        0);
    CHECK(found.legal() == built_in("planar_robots"));
  }
}

TEST_CASE("one reading says all that is wrong with a planar robot") {
  const fs::path file = fs::temp_directory_path() / ("mcplan_bad_planar_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << "gravity = 0\ncolour = 1\ncollision_pairs = [['hip', 'leg'], ['leg', 'arm']]\n"
                      << "[[bodies]]\nname = 'hip'\nmass = 1\ninertia = 1\nparent = 'leg'\n"
                      << "[[bodies]]\nname = 'leg'\nmass = -1\ninertia = 1\nposition_min = 1\nposition_max = 0\n"
                      << "[[bodies]]\nname = 'foot'\nparent = 'lge'\nmass = 1\ninertia = 1\n"
                      << "[[end_effectors]]\nname = 'sole'\nbody = 'foto'\npoints = [0.1, 0.1]\n";
  try {
    read_planar_robot(file);
    FAIL("it was read");
  } catch (const InvalidRobot& found) {
    std::vector<std::string> fields = {found.field()};
    for (const InvalidInput& other : found.others()) fields.push_back(other.field());
    CHECK(fields == std::vector<std::string>{"gravity", "bodies[1].mass", "end_effectors[0].body",
                                             "collision_pairs[1][1]", "colour", "bodies[0].parent", "bodies[1].parent",
                                             "bodies[2].parent", "bodies[1].position_max", "end_effectors[0].points",
                                             "collision_pairs[0]"});
    CHECK(std::string(found.what()).rfind(file.string() + ": gravity: must be a positive number, got 0\n", 0) == 0);
  }
  fs::remove(file);
}
