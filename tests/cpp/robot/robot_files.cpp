#include "mcplan/robot/robot_files.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <fstream>

#include "mcplan/base/error.hpp"
#include "mcplan/model/data.hpp"

using namespace mcplan;
namespace fs = std::filesystem;

TEST_CASE("every built-in robot is valid and survives a file, its polytopes with it") {
  const fs::path file = fs::temp_directory_path() / ("mcplan_robot_" + std::to_string(getpid()) + ".toml");
  for (const std::string& name : built_in("robots")) {
    CAPTURE(name);
    const Robot robot = load_robot(name);
    CHECK(robot.name == name);
    CHECK_NOTHROW(robot.validate());
    save_robot(robot, file);
    CHECK(load_robot(file.string()) == robot);
    Robot other = robot;
    other.end_effectors[0].yaw_range = {-0.5, 0.25};
    CHECK(other != robot);
  }
  CHECK(load_robot("talos_wang").end_effectors[0].com_reach.given());
  fs::remove(file);
}

TEST_CASE("names of robots that are none say so") {
  CHECK_THROWS_AS(load_robot("talus"), UnknownRobot);
  try {
    load_robot("walker9");
  } catch (const UnknownRobot& found) {
    CHECK(std::string(found.what()).find("is a planar robot") != std::string::npos);
  }
}

TEST_CASE("a robot whose file names another elsewhere is refused") {
  const fs::path file = fs::temp_directory_path() / ("mcplan_bad_robot_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << "mass = 1.0\ninertia = [1, 1, 1]\ncom_height = 0.5\n[[end_effectors]]\nname = 'leg'\n"
                      << "nominal = [0, 0, -0.5]\nreach_min = [-1, -1, -1]\nreach_max = [1, 1, 1]\n"
                      << "com_reach = { file = '/etc/passwd', name = 'x' }\n";
  try {
    read_robot(file);
    FAIL("it was read");
  } catch (const InvalidRobot& found) {
    CHECK(found.field() == "end_effectors[0].com_reach.file");
    CHECK(found.source() == file.string());
  }
  fs::remove(file);
}
