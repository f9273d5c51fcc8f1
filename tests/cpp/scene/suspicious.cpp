#include <doctest/doctest.h>

#include <algorithm>

#include "mcplan/base/error.hpp"
#include "mcplan/scene/scene_files.hpp"

using namespace mcplan;

namespace {

double farthest_m(const Scene& scene) {
  double out = 0.0;
  for (const Surface& surface : scene.surfaces)
    for (const Eigen::Vector3d& vertex : surface.vertices_W) out = std::max(out, vertex.norm());
  return out;
}

void scale(Scene& scene, double factor) {
  for (Surface& surface : scene.surfaces) {
    for (Eigen::Vector3d& vertex : surface.vertices_W) vertex *= factor;
    surface.thickness *= factor;
  }
  scene.start.position_W *= factor;
  scene.goal.position_W *= factor;
}

}  // namespace

TEST_CASE("built-in scenes are meant; in millimetres they are not, unless their gravity agrees") {
  int counted = 0;
  for (const std::string& name : built_in("scenes")) {
    CAPTURE(name);
    Scene scene = load_scene(name);
    CHECK(suspicious_geometry(scene).empty());
    if (farthest_m(scene) > 9.0) continue;  // scenes end 10 km from the origin
    ++counted;
    scale(scene, 1000.0);
    const auto found = suspicious_geometry(scene);
    REQUIRE(found.size() == 1);
    CHECK(found[0].to_string().find(
              "surfaces: lengths are in metres, and these look like millimetres, got a scene of ") == 0);
    scene.gravity *= 1000.0;
    CHECK(suspicious_geometry(scene).empty());
    scale(scene, 1e-3);
    REQUIRE(suspicious_geometry(scene).size() == 1);
    CHECK(suspicious_geometry(scene)[0].field == "gravity");
  }
  CHECK(counted > 10);
}

TEST_CASE("ground that faces down is suspicious where the robot stands on it, and a ceiling is not") {
  Scene scene = load_scene("flat");
  auto& vertices_W = scene.surfaces[0].vertices_W;
  std::reverse(vertices_W.begin(), vertices_W.end());
  const auto found = suspicious_geometry(scene);
  REQUIRE(found.size() == 2);
  CHECK(found[0].field == "surfaces[0].vertices");
  CHECK(found[0].rule.find("stands on it at the start") != std::string::npos);
  CHECK(found[1].rule.find("stands on it at the goal") != std::string::npos);
  CHECK(found[0].value == "normal [0, 0, -1]");
  for (Eigen::Vector3d& vertex : vertices_W) vertex.z() += 3.0;
  CHECK(suspicious_geometry(scene).empty());
}

TEST_CASE("a scene that is not valid is refused, not suspected") {
  Scene scene = load_scene("flat");
  scene.start.contacts = {{"foot", "nowhere"}};
  CHECK_THROWS_AS(suspicious_geometry(scene), InvalidScene);
}
