#include "plan/swings.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "mcplan/robot/similarity.hpp"
#include "plan/depths.hpp"
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
    return fixtures::deepest(plan, solids, left_foot, mcplan::free_stretches(plan, solids, left_foot)[0], 0.001);
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

TEST_CASE("of six heights the first that clears the scene, or the one that goes in least, as the whole path says") {
  for (double usual : {0.001, 0.004, 0.006, 0.011, 0.03}) {
    CAPTURE(usual);
    mcplan::Plan plan = walk();
    plan.robot.swing_height = usual;
    const auto solids = mcplan::solids_of(plan.scene);
    const double sample_s = 0.01 * mcplan::similarity_of(plan.robot, plan.scene.gravity).time;
    mcplan::choose_swings(plan);
    const mcplan::Plan chosen = plan;
    mcplan::choose_swings(plan, false);
    for (std::size_t i = 0; i < plan.swings.size(); ++i) {
      mcplan::Swing& swing = plan.swings[i];
      const double height = swing.height;
      CHECK((height == usual || height == 0.0));
      double best = height, least = std::numeric_limits<double>::infinity();
      for (double factor : {1.0, 1.5, 2.0, 3.0, 4.0, 0.5}) {
        swing.height = factor * height;
        for (const auto& stretch : mcplan::free_stretches(plan, solids, swing.end_effector)) {
          if (stretch.first_phase != swing.first_phase || least <= 0.0) continue;
          const double depth = deepest(plan, solids, swing.end_effector, stretch, sample_s);
          if (depth >= least) continue;
          least = depth;
          best = swing.height;
        }
      }
      swing.height = height;
      CHECK(chosen.swings[i].height == best);
    }
  }
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
