#include "mcplan/planar/task_files.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "mcplan/base/error.hpp"
#include "mcplan/planar/robot_files.hpp"
#include "planar/robots.hpp"

using namespace mcplan;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> fields_of(const InvalidInput& found) {
  std::vector<std::string> fields = {found.field()};
  for (const InvalidInput& other : found.others()) fields.push_back(other.field());
  return fields;
}

constexpr const char* ground = "[[surfaces]]\nname = 'ground'\n";
constexpr const char* standing_phase =
    "[[phases]]\ncontacts = [{ end_effector = 'A', surface = 'ground', at = 0.0 },"
    " { end_effector = 'B', surface = 'ground', at = 0.7 }]\n";

}  // namespace

TEST_CASE("every planar task survives a file to the last bit") {
  const fs::path file = fs::temp_directory_path() / ("mcplan_planar_task_" + std::to_string(getpid()) + ".toml");
  const std::vector<std::string> names = built_in("planar_tasks");
  CHECK(names.size() >= 6);
  std::vector<PlanarTask> tasks = {planar::standing()};
  for (const std::string& name : names) {
    tasks.push_back(load_planar_task(name));
    CHECK(tasks.back().name == name);
  }
  tasks.push_back(load_planar_task("chimney"));
  tasks.back().surfaces[0].to = 3.5;  // the other end stays open
  for (PlanarPhase& phase : tasks.back().phases)
    for (PlanarContact& contact : phase.contacts) contact.position_W += 1e-9 * Eigen::Vector2d(1.0, 1.0 / 3.0);
  for (const PlanarTask& task : tasks) {
    CAPTURE(task.name);
    CHECK_NOTHROW(task.validate());
    save_planar_task(task, file);
    CHECK(load_planar_task(file.string()) == task);
    PlanarTask other = task;
    other.phases.back().contacts.back().position_W.x() += 1e-12;
    CHECK(other != task);
  }
  fs::remove(file);
}

TEST_CASE("an unknown planar task lists those that exist") {
  try {
    load_planar_task("cartwheels");
    FAIL("it was found");
  } catch (const UnknownPlanarTask& found) {
    const std::string begin = "no planar task 'cartwheels' and no file of that name. Did you mean 'cartwheel'? ";
    CHECK(std::string(found.what()).rfind(begin, 0) == 0);
    CHECK(found.legal() == built_in("planar_tasks"));
  }
}

TEST_CASE("a planar task finds its robot beside it, from any working directory") {
  const fs::path folder = fs::temp_directory_path() / ("mcplan_task_folder_" + std::to_string(getpid()));
  fs::create_directories(folder / "sub");
  save_planar_robot(load_planar_robot("climber9"), folder / "sub" / "mine.toml");
  std::ofstream(folder / "task.toml") << "robot = 'sub/mine.toml'\n" << ground << standing_phase;
  const PlanarTask task = load_planar_task((folder / "task.toml").string());
  CHECK(task.robot == load_planar_robot("climber9"));
  CHECK(task.name == "task");
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  CHECK(load_planar_task("task.toml") == task);
  fs::current_path(before);

  std::ofstream(folder / "sub" / "up.toml") << "robot = '../task.toml'\n" << ground << standing_phase;
  try {
    read_planar_task(folder / "sub" / "up.toml");
    FAIL("it was read");
  } catch (const InvalidPlanarTask& found) {
    CHECK(fields_of(found) == std::vector<std::string>{"robot"});
    CHECK(found.rule() == "must lie in the folder of the file that names it, or below");
  }
  std::ofstream(folder / "none.toml") << "robot = 'nobody'\n" << ground << standing_phase;
  try {
    read_planar_task(folder / "none.toml");
    FAIL("it was read");
  } catch (const UnknownRobot& found) {
    CHECK(std::string(found.what()).find("none.toml: robot: no robot 'nobody'") != std::string::npos);
    CHECK(found.name() == "nobody");
  }
  fs::remove_all(folder);
}

TEST_CASE("one reading says all that is wrong with a planar task") {
  const fs::path file = fs::temp_directory_path() / ("mcplan_bad_task_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << "robot = 'climber9'\ncolour = 1\n"
                      << ground << "[[surfaces]]\nname = 'wall'\nfriction = -1\nextent = [2.0, 1.0]\n"
                      << standing_phase << "[[phases]]\nlift = ['C']\nmin_duration = 'long'\n"
                      << "[[phases]]\nlift = ['D']\nintervals = 0\n"
                      << "[[phases]]\nposes = [{ body = 'hub', fraction = 2, x = [1, 0] }]\n"
                      << "contacts = [{ end_effector = 'A', surface = 'grnd', at = 0.0 }]\n"
                      << "[[phases]]\ncontacts = [{ end_effector = 'A', surface = 'ground' }]\nplace = []\n";
  try {
    read_planar_task(file);
    FAIL("it was read");
  } catch (const InvalidPlanarTask& found) {
    CHECK(fields_of(found) == std::vector<std::string>{
                                  "surfaces[1].friction", "phases[1].min_duration", "phases[2].lift[0]",
                                  "phases[2].intervals", "phases[3].contacts[0].surface", "phases[3].poses[0].fraction",
                                  "colour", "phases[3].poses[0].x", "phases[4].contacts[0].at", "surfaces[1].extent"});
  }
  fs::remove(file);
}

TEST_CASE("what is wrong with a robot inside of a task stands under its place, and comes with the rest") {
  const fs::path file = fs::temp_directory_path() / ("mcplan_bad_inline_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << "surfaces = []\n"
                      << standing_phase << "[robot]\ngravity = 'down'\nend_effectors = []\n"
                      << "bodies = [{ name = 'hub', mass = -1.0, inertia = 1.0 }]\n";
  try {
    read_planar_task(file);
    FAIL("it was read");
  } catch (const InvalidRobot& found) {
    CHECK(fields_of(found) ==
          std::vector<std::string>{"robot.gravity", "robot.bodies[0].mass", "robot.end_effectors", "surfaces"});
    CHECK(found.source() == file.string());
  }
  fs::remove(file);
}

TEST_CASE("a place along a surface is the same number whatever the instruction set") {
  const PlanarTask task = load_planar_task("climbing");
  int checked = 0;
  for (const PlanarPhase& phase : task.phases)
    for (const PlanarContact& contact : phase.contacts) {
      const PlanarSurface& surface = task.surfaces[static_cast<std::size_t>(contact.surface)];
      const double at = std::round(1e6 * surface.tangent_W().dot(contact.position_W - surface.origin_W)) / 1e6;
      const volatile double x = at * std::cos(surface.angle), y = at * std::sin(surface.angle);  // without fma
      CHECK(contact.position_W == Eigen::Vector2d(surface.origin_W.x() + x, surface.origin_W.y() + y));
      ++checked;
    }
  CHECK(checked > 10);
}
