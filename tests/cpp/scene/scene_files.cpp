#include "mcplan/scene/scene_files.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <fstream>

#include "mcplan/base/error.hpp"
#include "mcplan/model/data.hpp"

using namespace mcplan;
namespace fs = std::filesystem;

TEST_CASE("every built-in scene is valid and survives a file") {
  const fs::path file = fs::temp_directory_path() / ("mcplan_scene_" + std::to_string(getpid()) + ".toml");
  const std::vector<std::string> names = built_in("scenes");
  CHECK(names.size() > 15);
  for (const std::string& name : names) {
    CAPTURE(name);
    const Scene scene = load_scene(name);
    CHECK(scene.name == name);
    CHECK_NOTHROW(scene.validate());
    save_scene(scene, file);
    CHECK(load_scene(file.string()) == scene);
    Scene other = scene;
    other.surfaces.back().vertices_W.back().x() += 1e-15;
    CHECK(other != scene);
  }
  fs::remove(file);
}

TEST_CASE("an unknown name lists those that exist") {
  try {
    load_scene("stares");
    FAIL("it was found");
  } catch (const UnknownScene& found) {
    CHECK(std::string(found.what()).rfind("no scene 'stares' and no file of that name. Did you mean 'stairs'? ", 0) ==
          0);
    CHECK(found.legal() == built_in("scenes"));
  }
}

TEST_CASE("one reading says all that is wrong with a file") {
  const fs::path file = fs::temp_directory_path() / ("mcplan_bad_scene_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file)
      << "gravity = 'heavy'\ncolour = 1\n[start]\nposition = [0, 0, 0]\ncontacts = { foot = 'a' }\n"
      << "[goal]\nposition = [0, 0, 0]\nyaw = 7.0\ncontacts = { foot = 'b' }\n[[surfaces]]\nname = 'a'\n"
      << "vertices = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]\nfriction = -1\n";
  try {
    read_scene(file);
    FAIL("it was read");
  } catch (const InvalidScene& found) {
    std::vector<std::string> fields = {found.field()};
    for (const InvalidInput& other : found.others()) fields.push_back(other.field());
    CHECK(fields == std::vector<std::string>{"gravity", "surfaces[0].friction", "colour", "surfaces[0].vertices",
                                             "goal.yaw", "goal.contacts.foot"});
    CHECK(std::string(found.what()).rfind(file.string() + ": gravity: must be a number, got \"heavy\"\n", 0) == 0);
  }
  fs::remove(file);
}
