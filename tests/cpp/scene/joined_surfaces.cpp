#include "scene/joined_surfaces.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "mcplan/base/rotation.hpp"
#include "mcplan/scene/polygon.hpp"
#include "scenes.hpp"

namespace {

using mcplan::JoinedSurfaces;
using mcplan::Polygon;
using mcplan::Scene;
using mcplan::Surface;

Scene made_of(std::vector<Surface> surfaces) {
  Scene scene;
  scene.surfaces = std::move(surfaces);
  return scene;
}

Scene tiles(int along, int across, double size = 0.25, double apart = 0.0) {
  Scene scene;
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j)
      scene.surfaces.push_back(scenes::rectangle("t" + std::to_string(i) + "_" + std::to_string(j), i * size,
                                                 (i + 1) * size - apart, j * size, (j + 1) * size - apart, 0));
  return scene;
}

double area(const Surface& surface) {
  const Polygon polygon(surface.vertices_W);
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < surface.vertices_W.size(); ++i)
    twice += polygon.normal_W().dot(
        (surface.vertices_W[i] - surface.vertices_W[0]).cross(surface.vertices_W[i + 1] - surface.vertices_W[0]));
  return 0.5 * twice;
}

std::size_t count(const Scene& scene) { return join_surfaces(scene).scene.surfaces.size(); }

}  // namespace

TEST_CASE("a floor of tiles is one rectangle, wherever it lies and in whatever order they come") {
  Scene scene = tiles(7, 5);
  const Eigen::Matrix3d turned = mcplan::rotation_from_rpy({0.2, -0.1, 0.7});
  for (Surface& surface : scene.surfaces)
    for (Eigen::Vector3d& vertex : surface.vertices_W) vertex = turned * vertex + Eigen::Vector3d(3.0, -2.0, 1.0);
  std::mt19937_64 random(1);
  for (int shuffle = 0; shuffle < 5; ++shuffle) {
    const JoinedSurfaces joined = join_surfaces(scene);
    REQUIRE(joined.scene.surfaces.size() == 1);
    CHECK(joined.any());
    CHECK(joined.index == std::vector<int>(35, 0));
    CHECK(joined.scene.surfaces[0].name == scene.surfaces[0].name);
    CHECK(joined.scene.surfaces[0].vertices_W.size() == 4);
    CHECK(std::abs(area(joined.scene.surfaces[0]) - 35 * 0.0625) < 1e-9);
    const Polygon whole(joined.scene.surfaces[0].vertices_W);
    for (const Surface& tile : scene.surfaces)
      for (const Eigen::Vector3d& vertex : tile.vertices_W) {
        CHECK(whole.outside(vertex) < 1e-9);
        CHECK(std::abs(whole.height(vertex)) < 1e-9);
      }
    for (std::size_t i = scene.surfaces.size(); i > 1; --i)
      std::swap(scene.surfaces[i - 1], scene.surfaces[random() % i]);
  }
}

TEST_CASE("what is not ground does not become any: an L stays in two pieces, a hole in the floor open") {
  Scene corner = made_of({scenes::rectangle("a", 0, 2, 0, 1, 0), scenes::rectangle("b", 1, 2, 1, 3, 0)});
  CHECK(count(corner) == 2);
  Scene hole = tiles(5, 5);
  hole.surfaces.erase(hole.surfaces.begin() + 12);
  const JoinedSurfaces joined = join_surfaces(hole);
  CHECK(joined.scene.surfaces.size() < 24);
  double sum = 0.0;
  for (const Surface& surface : joined.scene.surfaces) {
    sum += area(surface);
    CHECK(Polygon(surface.vertices_W).outside({0.625, 0.625, 0.0}) > 0.12);
  }
  CHECK(std::abs(sum - 24 * 0.0625) < 1e-9);
}

TEST_CASE("duplicates and pieces that overlap are one where that is convex") {
  const Surface floor = scenes::rectangle("floor", 0, 2, 0, 1, 0);
  CHECK(count(made_of({floor, scenes::rectangle("again", 0, 2, 0, 1, 0),
                       scenes::rectangle("within", 1, 1.5, 0.2, 0.4, 0)})) == 1);
  const JoinedSurfaces longer = join_surfaces(made_of({floor, scenes::rectangle("further", 1.5, 4, 0, 1, 0)}));
  REQUIRE(longer.scene.surfaces.size() == 1);
  CHECK(std::abs(area(longer.scene.surfaces[0]) - 4.0) < 1e-9);
  CHECK(count(made_of({floor, scenes::rectangle("aside", 1.5, 4, 0.1, 1.1, 0)})) == 2);
}

TEST_CASE("steps, slits, slopes, other friction, thickness or end-effectors, and what may be held part surfaces") {
  const Surface one = scenes::rectangle("one", 0, 1, 0, 1, 0);
  const auto beside = [&](const auto& change) {
    Surface other = scenes::rectangle("other", 1, 2, 0, 1, 0);
    change(other);
    return count(made_of({one, other}));
  };
  CHECK(beside([](Surface&) {}) == 1);
  CHECK(beside([](Surface& s) { s = scenes::rectangle("other", 1, 2, 0, 1, 5e-5); }) == 1);
  CHECK(beside([](Surface& s) { s = scenes::rectangle("other", 1, 2, 0, 1, 0.001); }) == 2);
  CHECK(beside([](Surface& s) { s = scenes::rectangle("other", 1.001, 2, 0, 1, 0); }) == 1);
  CHECK(beside([](Surface& s) { s = scenes::rectangle("other", 1.01, 2, 0, 1, 0); }) == 2);
  CHECK(beside([](Surface& s) { s.vertices_W[1].z() = s.vertices_W[2].z() = 0.05; }) == 2);
  CHECK(beside([](Surface& s) { s.friction = 0.5; }) == 2);
  CHECK(beside([](Surface& s) { s.thickness = 0.5; }) == 2);
  CHECK(beside([](Surface& s) { s.end_effectors = {"hand"}; }) == 2);
  CHECK(beside([](Surface& s) { s.grasp = true; }) == 2);
  CHECK(beside([](Surface& s) { std::reverse(s.vertices_W.begin(), s.vertices_W.end()); }) == 2);  // it faces down
}

TEST_CASE("stances and steps name whole surfaces, and a scene without pieces stays as it is") {
  Scene scene = tiles(3, 3);
  scene.start.contacts = {{"foot", "t1_1"}};
  scene.goal.contacts = {{"left_foot", "t2_2"}, {"right_foot", "t0_2"}};
  scene.steps = {{"left_foot", "t2_0"}};
  const JoinedSurfaces joined = join_surfaces(scene);
  CHECK(joined.scene.start.contacts.at("foot") == "t0_0");
  CHECK(joined.scene.goal.contacts.at("left_foot") == "t0_0");
  CHECK(joined.scene.steps[0].surface == "t0_0");
  const JoinedSurfaces again = join_surfaces(joined.scene);
  CHECK(!again.any());
  CHECK(again.scene.surfaces[0].vertices_W == joined.scene.surfaces[0].vertices_W);
  CHECK(join_surfaces(Scene()).scene.surfaces.empty());
}
