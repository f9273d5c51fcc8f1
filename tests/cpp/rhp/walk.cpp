#include "mcplan/rhp/walk.hpp"

#include <doctest/doctest.h>

#include "mcplan/plan/checker.hpp"
#include "mcplan/plan/plan_files.hpp"
#include "rhp/walkers.hpp"

TEST_CASE("a walk over a scene's steps is that of the planner behind it") {
  const mcplan::Scene scene = walkers::uneven();
  const mcplan::Robot robot = walkers::robot();
  const mcplan::rhp::Options options = walkers::quick(mcplan::rhp::Fidelity::point);
  const mcplan::rhp::Walk walk = mcplan::rhp::walk(scene, robot, options);
  CHECK(walk.success);
  CHECK(walk.plan == mcplan::rhp::RecedingHorizon(scene, robot, options).walk().plan);
}

TEST_CASE("the report of a walk has what the checker warns of") {
  mcplan::Scene scene = walkers::uneven();
  mcplan::Surface beam;
  beam.name = "beam";
  beam.thickness = 0.2;
  for (const auto& corner : {Eigen::Vector2d(0.1, -2.0), {0.2, -2.0}, {0.2, 2.0}, {0.1, 2.0}})
    beam.vertices_W.emplace_back(corner.x(), corner.y(), 0.6);
  scene.surfaces.push_back(beam);
  mcplan::rhp::Options options = walkers::quick(mcplan::rhp::Fidelity::point);
  options.cycles = 2;
  const mcplan::rhp::Walk walk = mcplan::rhp::walk(scene, walkers::robot(), options);
  REQUIRE(walk.success);
  const std::vector<mcplan::Violation> warnings = check(walk.plan, scene, walk.plan.robot).warnings;
  REQUIRE(warnings.size() == 1);
  REQUIRE(walk.report.warnings.size() == 1);
  CHECK(walk.report.warnings.front().surface == "beam");
  CHECK(walk.report.warnings.front().to_string() == warnings.front().to_string());
}
