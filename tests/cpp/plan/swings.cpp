#include "mcplan/plan/swings.hpp"

#include <doctest/doctest.h>

#include "mcplan/plan/clearance.hpp"
#include "plan/point_fixtures.hpp"

using namespace fixtures;

TEST_CASE("swings follow from the contact sequence") {
  mcplan::Plan plan = walk();
  plan.swings.push_back({left_foot, 0, 1, 0.5, {1, 0, 0}, {1, 0, 0}});  // to be replaced
  mcplan::choose_swings(plan);
  int feet = 0;
  for (const auto& swing : plan.swings) {
    for (int k = swing.first_phase; k < swing.end_phase; ++k)
      CHECK(plan.phases[k].contacts[swing.end_effector].surface == -1);
    feet += swing.end_effector == left_foot || swing.end_effector == right_foot;
    CHECK(swing.lift_normal_W == Vector3d::UnitZ());
  }
  CHECK(feet == 3);
  CHECK(plan.swings.size() == 3 + 3);  // the left hand before and after its rail, the right hand throughout
  CHECK(plan.swings.back().end_effector == right_hand);
  CHECK(plan.swings.back().height == 0.0);
}

TEST_CASE("a swing rises until it clears the scene") {
  mcplan::Plan plan = walk();
  const auto solids = mcplan::solids_of(plan.scene);
  const auto deepest = [&] {
    return mcplan::clearance_depth(plan, solids, left_foot, mcplan::free_stretches(plan, solids, left_foot)[0], 0.001);
  };
  plan.swings[0].height = 0.5 * plan.robot.swing_height;
  plan.robot.swing_height = 0.01;  // too low for the block of 0.02 m
  mcplan::choose_swings(plan);
  CHECK(plan.swings[0].height > 0.02);
  CHECK(deepest() == 0.0);
  plan.robot.swing_height = 0.08;  // high enough
  mcplan::choose_swings(plan);
  CHECK(plan.swings[0].height == 0.08);
}

TEST_CASE("a swing over a slope leaves and arrives along its normals") {
  mcplan::Plan plan = step_on_corners();
  plan.scene.surfaces.push_back(rectangle("slope", -1, 2, -1, 1, 0.0));
  for (int i : {1, 2}) plan.scene.surfaces.back().vertices_W[i].z() = 0.3;
  plan.phases[2].contacts[left_foot].surface = 5;
  mcplan::choose_swings(plan);
  REQUIRE(plan.swings[0].end_effector == left_foot);
  CHECK(plan.swings[0].lift_normal_W == Vector3d::UnitZ());
  CHECK((plan.swings[0].land_normal_W - Vector3d(-0.1, 0, 1).normalized()).norm() < 1e-12);
}
