#include "mcplan/plan/friction_use.hpp"

#include <doctest/doctest.h>

#include "plan/wrench_fixtures.hpp"

using namespace fixtures;

TEST_CASE("vertical forces use no friction, and feet that push opposite ways as much as they push") {
  mcplan::Plan plan = stand_on_wrenches();
  auto use = mcplan::friction_use(plan, 5e-3);
  CHECK(use.size() == 2);
  CHECK(use.at("left_foot") == doctest::Approx(0.0));
  const double weight = plan.robot.mass * kGravity, push = 30.0;
  for (int foot : {left_foot, right_foot}) {
    auto& contact = plan.phases[1].contacts[foot];
    contact.anchor_W.x() += (foot == left_foot ? -push : push) / (plan.robot.mass * contact.stiffness);
  }
  use = mcplan::friction_use(plan, 5e-3);
  for (const char* foot : {"left_foot", "right_foot"}) CHECK(use.at(foot) == doctest::Approx(push / (0.5 * weight)));
}

TEST_CASE("a contact that pulls uses infinite friction, though it may hold") {
  mcplan::Plan rails = stand_at_rails(0.8, 2.0);
  give_wrenches(rails);
  CHECK(std::isinf(mcplan::friction_use(rails, 5e-3).at("left_hand")));
}
