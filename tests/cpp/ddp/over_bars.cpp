#include "ddp/over_bars.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "support.hpp"

namespace {

using namespace mcplan::ddp;
using mcplan::Scene;
using mcplan::Surface;

/// A bar of this height across a floor of two by six metres, that hands may touch.
Scene with_bar(double from, double to, double height, const std::string& who = "hand") {
  Scene scene =
      scenes::made_of("bar", {scenes::rectangle("floor", -2, 4, -1, 1, 0, "foot")}, "floor", "floor", {2.0, 0, 0});
  Surface bar = scenes::rectangle("bar", from, to, -1, 1, height, who);
  bar.thickness = height;
  scene.surfaces.push_back(bar);
  return scene;
}

std::vector<Bar> bars_of(const Scene& scene) { return bars_across(scene, scenes::humanoid44(), -1.0); }

double area_of(const Surface& surface) {
  double twice = 0.0;
  const auto& v = surface.vertices_W;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto &a = v[i], &b = v[(i + 1) % v.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

}  // namespace

TEST_CASE("a bar is what stands low across the way, and where the straight line passes it") {
  const std::vector<Bar> bars = bars_of(with_bar(0.9, 1.0, 0.1));
  REQUIRE(bars.size() == 1);
  CHECK(bars[0].solid == 1);
  CHECK(bars[0].near == doctest::Approx(0.9));
  CHECK(bars[0].far == doctest::Approx(1.0));
  CHECK(bars[0].middle.x() == doctest::Approx(0.95));
  CHECK(bars[0].near_outward.x() == doctest::Approx(-1.0));
  CHECK(bars[0].far_outward.x() == doctest::Approx(1.0));
}

TEST_CASE("no bar: what is too high, too thick, stepped on, beside the way, or at the feet of start or goal") {
  CHECK(bars_of(with_bar(0.9, 1.0, 0.5)).empty());
  CHECK(bars_of(with_bar(0.6, 1.4, 0.1)).empty());
  CHECK(bars_of(with_bar(0.9, 1.0, 0.1, "foot")).empty());
  CHECK(bars_of(with_bar(0.02, 0.12, 0.1)).empty());
  CHECK(bars_of(with_bar(1.9, 1.97, 0.1)).empty());
  CHECK(bars_of(with_bar(2.5, 2.6, 0.1)).empty());
  Scene beside = with_bar(0.9, 1.0, 0.1);
  for (auto& vertex : beside.surfaces[1].vertices_W) vertex.y() += 1.5;
  CHECK(bars_of(beside).empty());
}

TEST_CASE("ground is cut into what is before a bar and what is behind, each called as the whole was") {
  Scene scene = with_bar(0.9, 1.0, 0.1);
  Surface second = scene.surfaces[1];
  second.name = "second";
  for (auto& vertex : second.vertices_W) vertex.x() += 0.5;
  scene.surfaces.push_back(second);
  const std::vector<Bar> bars = bars_of(scene);
  REQUIRE(bars.size() == 2);
  std::vector<int> surfaces{4, 7, 9};
  Scene cut = scene;
  cut_at(bars, scenes::humanoid44(), cut, surfaces);
  cut.validate();
  REQUIRE(cut.surfaces.size() == 5);
  CHECK(surfaces == std::vector<int>{4, 4, 4, 7, 9});
  CHECK(area_of(cut.surfaces[0]) == doctest::Approx(2.9 * 2.0));
  CHECK(area_of(cut.surfaces[1]) == doctest::Approx(0.4 * 2.0));
  CHECK(area_of(cut.surfaces[2]) == doctest::Approx(2.5 * 2.0));
  CHECK(cut.start.contacts.at("foot") == "floor");
  CHECK(cut.goal.contacts.at("foot") == cut.surfaces[2].name);
}

TEST_CASE("a piece has a name of its own, whatever surfaces are called, and room for a sole") {
  Scene scene = with_bar(0.9, 1.0, 0.1);
  scene.surfaces[1].name = "floor, behind";
  std::vector<int> surfaces{0, 1};
  Scene cut = scene;
  cut_at(bars_of(scene), scenes::humanoid44(), cut, surfaces);
  cut.validate();
  CHECK(cut.surfaces.size() == 3);
  // Behind the bar the floor ends before a sole does.
  scene.surfaces[0].vertices_W[1].x() = scene.surfaces[0].vertices_W[2].x() = 1.1;
  scene.surfaces.push_back(scenes::rectangle("next", 1.1, 4, -1, 1, 0, "foot"));
  scene.goal.contacts["foot"] = "next";
  surfaces = {0, 1, 2};
  cut = scene;
  cut_at(bars_of(scene), scenes::humanoid44(), cut, surfaces);
  CHECK(surfaces == std::vector<int>{0, 1, 2});
}

TEST_CASE("a motion over the whole ground comes to name the pieces that its feet are on") {
  const Scene scene = with_bar(0.9, 1.0, 0.1);
  const mcplan::Robot robot = scenes::humanoid44();
  std::vector<int> surfaces{0, 1};
  Scene cut = scene;
  cut_at(bars_of(scene), robot, cut, surfaces);
  const Problem problem(cut, robot, support::phases(6));
  Incumbent motion;
  motion.trajectory = problem.initial_guess({});
  motion.sequence.assign(motion.trajectory.x.size(), ContactState(problem.layout.end_effector_count(), kFree));
  std::vector<double> at;
  for (std::size_t k = 0; k < motion.sequence.size(); ++k) {
    motion.sequence[k][0] = 0;
    at.push_back(motion.trajectory.x[k][problem.layout.end(0)] * problem.units.length);
  }
  name_pieces(problem, surfaces, motion);
  for (std::size_t k = 0; k < motion.sequence.size(); ++k) {
    CHECK(motion.sequence[k][0] == (at[k] < 0.95 ? 0 : 1));
    CHECK(motion.sequence[k][1] == kFree);
  }
  CHECK(at.front() < 0.9);
  CHECK(at.back() > 1.0);
}
