#include "mcplan/rhp/walk.hpp"

#include <doctest/doctest.h>

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
