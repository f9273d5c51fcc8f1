#include "mcplan/scene/scene.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "mcplan/base/error.hpp"

namespace {

using Eigen::Vector3d;
using mcplan::Scene;
using mcplan::Surface;

Scene two_slabs() {
  Scene scene;
  scene.name = "two slabs";
  for (double x : {0.0, 2.0}) {
    Surface slab;
    slab.name = x > 0 ? "far" : "near";
    slab.vertices_W = {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}};
    scene.surfaces.push_back(slab);
  }
  scene.start.contacts = {{"foot", "near"}};
  scene.goal.contacts = {{"foot", "far"}};
  return scene;
}

/// Field that a change of the valid scene makes validate() name, "accepted" when it names none.
std::string field(const std::function<void(Scene&)>& mutate) {
  Scene scene = two_slabs();
  mutate(scene);
  try {
    scene.validate();
  } catch (const mcplan::InvalidScene& error) {
    return error.field();
  }
  return "accepted";
}

std::string vertices(const std::vector<Vector3d>& points) {
  return field([&](Scene& s) { s.surfaces[1].vertices_W = points; });
}

}  // namespace

TEST_CASE("a valid scene is accepted, surfaces of any orientation too") {
  CHECK(field([](Scene&) {}) == "accepted");
  CHECK(vertices({{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 0}}) == "accepted");  // slope
  CHECK(vertices({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}}) == "accepted");             // wall
  CHECK(vertices({{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}) == "accepted");  // ceiling
}

TEST_CASE("degenerate polygons are named") {
  const std::string all = "surfaces[1].vertices";
  CHECK(vertices({}) == all);
  CHECK(vertices({{0, 0, 0}, {1, 0, 0}}) == all);
  CHECK(vertices({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}) == all);                         // no area
  CHECK(vertices({{0, 0, 0}, {1, 0, 0}, {0.5, 1e-6, 0}}) == all);                    // 5e-7 m^2
  CHECK(vertices({{0, 0, 0}, {1e-3, 0, 0}, {5e-4, 5e-10, 0}}) == all);               // the same, smaller
  CHECK(vertices({{0, 0, 0}, {1e-3, 0, 0}, {0, 1e-3, 0}}) == "accepted");            // small ground of a small robot
  CHECK(vertices({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}) == all + "[2]");      // a point twice
  CHECK(vertices({{0, 0, 0}, {1, 0, 0}, {0.2, 0.2, 0}, {0, 1, 0}}) == all + "[2]");  // dented
  CHECK(vertices({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}}) == all + "[1]");      // a corner of 180 degrees
  CHECK(vertices({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {0, 1, 0}}).find(all + "[") == 0);  // warped
  CHECK(vertices({{0, 0, 0}, {1, 0, 0}, {1, std::nan(""), 0}}) == all + "[2][1]");
  CHECK(vertices({{0, 0, 0}, {INFINITY, 0, 0}, {1, 1, 0}}) == all + "[1][0]");
  CHECK(vertices({{0, 0, 0}, {1e5, 0, 0}, {1, 1, 0}}) == all + "[1]");
}

TEST_CASE("polygons that cross themselves are named") {
  std::vector<Vector3d> star, twice;
  for (int i = 0; i < 5; ++i) star.push_back({std::cos(4 * M_PI * i / 5), std::sin(4 * M_PI * i / 5), 0});
  for (int i = 0; i < 6; ++i) twice.push_back({std::cos(4 * M_PI * i / 6), std::sin(4 * M_PI * i / 6), 0});
  CHECK(vertices(star) == "surfaces[1].vertices");
  CHECK(vertices(twice) == "surfaces[1].vertices");
  CHECK(vertices({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1.5, 0}}).find("surfaces[1].vertices") == 0);  // a bow tie
}

TEST_CASE("numbers of surfaces out of range are named") {
  for (double bad : {0.0, -0.1, std::nan(""), HUGE_VAL}) {
    CAPTURE(bad);
    CHECK(field([&](Scene& s) { s.gravity = bad; }) == "gravity");
    CHECK(field([&](Scene& s) { s.surfaces[0].friction = bad; }) == "surfaces[0].friction");
    CHECK(field([&](Scene& s) { s.surfaces[1].thickness = bad; }) == "surfaces[1].thickness");
  }
}

TEST_CASE("names that are missing, doubled or unknown are named") {
  CHECK(field([](Scene& s) { s.surfaces.clear(); }) == "surfaces");
  CHECK(field([](Scene& s) { s.surfaces[1].name = ""; }) == "surfaces[1].name");
  CHECK(field([](Scene& s) { s.surfaces[1].name = "near"; }) == "surfaces[1].name");
  CHECK(field([](Scene& s) { s.start.contacts["hand"] = "moon"; }) == "start.contacts.hand");
  CHECK(field([](Scene& s) { s.goal.contacts.clear(); }) == "goal.contacts");
  CHECK(field([](Scene& s) { s.rules = {{{}, {"hand"}}}; }) == "rules[0].when_free");
  CHECK(field([](Scene& s) { s.rules = {{{"foot"}, {"hand"}}, {{"foot"}, {}}}; }) == "rules[1].require");
}

TEST_CASE("steps name surfaces that exist") {
  CHECK(field([](Scene& s) { s.steps = {{"left_foot", "near"}, {"right_foot", "far"}}; }) == "accepted");
  CHECK(field([](Scene& s) { s.steps = {{"left_foot", "near"}, {"right_foot", "moon"}}; }) == "steps[1].surface");
  CHECK(field([](Scene& s) { s.steps = {{"", "near"}}; }) == "steps[0].end_effector");
}

TEST_CASE("stances out of range are named") {
  CHECK(field([](Scene& s) { s.goal.position_W.y() = std::nan(""); }) == "goal.position[1]");
  CHECK(field([](Scene& s) { s.start.yaw = INFINITY; }) == "start.yaw");
  CHECK(field([](Scene& s) { s.start.yaw = 7.0; }) == "start.yaw");
}

TEST_CASE("surfaces are found by name") {
  CHECK(two_slabs().surface_index("far") == 1);
  CHECK(two_slabs().surface_index("moon") == -1);
}
