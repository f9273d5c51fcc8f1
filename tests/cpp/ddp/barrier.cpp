#include "ddp/barrier.hpp"

#include <doctest/doctest.h>

#include <string>

#include "mcplan/ddp/switched_ddp.hpp"
#include "support.hpp"

namespace {

using mcplan::Scene;

std::string what_bars(const Scene& scene, const mcplan::Robot& robot) {
  const mcplan::ddp::Routes routes = mcplan::ddp::find_routes(scene, robot);
  return routes.barrier ? text_of(*routes.barrier, scene, robot.name) : "";
}

/// A floor from -2 to 4 m with a solid from wall to wall, or up to `end`.
Scene barred(double bottom, double top, double end = 2.0, double depth = 0.1) {
  Scene scene = scenes::made_of(
      "barred", {scenes::rectangle("floor", -2, 4, -2, 2, 0), scenes::rectangle("bar", 0.9, 0.9 + depth, -2, end, top)},
      "floor", "floor", {2.0, 0.0, 0.0});
  scene.surfaces[1].thickness = top - bottom;
  scene.surfaces[1].end_effectors = {"hand"};
  return scene;
}

Scene with_step(double height) {
  Scene scene = scenes::made_of(
      "step", {scenes::rectangle("low", -1, 0.3, -1, 1, 0), scenes::rectangle("high", 0.3, 2.5, -1, 1, height)}, "low",
      "high", {0.9, 0.0, height});
  scene.surfaces[1].thickness = height;
  return scene;
}

}  // namespace

TEST_CASE("a fence from wall to wall that no foot comes over is named, with its height and the robot's") {
  CHECK(what_bars(barred(0.0, 0.6), scenes::humanoid44()) ==
        "\"bar\" stands 0.6 m above \"floor\" across the way to the goal, and no way round it was found: without hands "
        "or a jump a level humanoid44 puts no foot more than 0.2 m above the other");
  CHECK(what_bars(barred(0.0, 0.19), scenes::humanoid44()).empty());      // it is stepped over
  CHECK(what_bars(barred(0.0, 0.6, 0.4), scenes::humanoid44()).empty());  // its end is walked round
  CHECK(what_bars(scenes::flat(), scenes::humanoid44()).empty());
}

TEST_CASE("what is too low to pass below is named, what hangs above is not") {
  CHECK(what_bars(barred(0.5, 0.9), scenes::humanoid44()) ==
        "\"bar\", 0.5 m above \"floor\", leaves no room for the trunk on the way to the goal, and no way round it was "
        "found");
  CHECK(what_bars(barred(1.6, 2.0), scenes::humanoid44()).empty());
}

TEST_CASE("steps up and down that are too high are named") {
  CHECK(what_bars(with_step(0.15), scenes::humanoid44()).empty());
  // As high as the robot steps: 0.8 - 0.6 is more than 0.2 by rounding.
  Scene level = with_step(0.8);
  level.surfaces[1].thickness = 0.2;
  for (auto& v : level.surfaces[0].vertices_W) v.z() = 0.6;
  level.start.position_W.z() = 0.6;
  CHECK(what_bars(level, scenes::humanoid44()).empty());
  CHECK(what_bars(with_step(0.3), scenes::humanoid44()).find("\"high\" stands 0.3 m above \"low\"") == 0);
  Scene down = with_step(0.0);
  for (auto& v : down.surfaces[0].vertices_W) v.z() = 0.4;
  down.start.position_W.z() = 0.4;
  const std::string said = what_bars(down, scenes::humanoid44());
  CHECK(said.find("on the way to the goal the ground falls by 0.4 m from \"low\" to \"high\"") == 0);
}

TEST_CASE("what can be walked round is not named for what cannot") {
  Scene scene = barred(0.0, 0.6);
  scene.surfaces.insert(scene.surfaces.begin(), scenes::rectangle("post", 0.3, 0.35, -0.05, 0.05, 1.4, "hand"));
  scene.surfaces[0].thickness = 1.4;
  CHECK(what_bars(scene, scenes::humanoid44()).find("\"bar\" stands 0.6 m above \"floor\"") == 0);
  Scene gap =
      scenes::made_of("gap", {scenes::rectangle("a", -1, 1.2, -2, 2, 0), scenes::rectangle("b", 2.2, 4, -2, 2, 0)}, "a",
                      "b", {2.8, 0.0, 0.0});
  gap.surfaces.push_back(scene.surfaces[0]);
  CHECK(what_bars(gap, scenes::humanoid44()).empty());
}

TEST_CASE("a search that fails before a wall says what bars the way") {
  mcplan::ddp::Options options;
  options.max_iterations = 1;
  const mcplan::PlanResult result = mcplan::ddp::SwitchedDdp(barred(0.0, 0.6), scenes::humanoid44(), options).solve();
  CHECK(result.report.status != mcplan::Status::solved);
  CHECK(result.report.message.find("; \"bar\" stands 0.6 m above \"floor\"") != std::string::npos);
}
