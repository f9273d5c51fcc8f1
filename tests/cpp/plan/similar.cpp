#include "plan/similar.hpp"

#include <doctest/doctest.h>

#include "mcplan/mcplan.hpp"
#include "mcplan/plan/checker.hpp"
#include "plan/fixtures.hpp"

namespace {

using Eigen::Vector3d;
using mcplan::CheckResult;
using mcplan::inverse;
using mcplan::Plan;
using mcplan::PlanState;
using mcplan::scaled;
using mcplan::Similarity;

const Similarity kSmaller{1.0 / 256.0, 1.0 / 16.0, 1.0 / 4096.0}, kLarger{16.0, 4.0, 32768.0}, kSlower{1.0, 2.0, 1.0};

Plan similar_walk(const Similarity& by, const Plan& plan) {
  Plan out = scaled_motion(plan, by);
  out.scene = scaled(plan.scene, by);
  out.robot = scaled(plan.robot, by);
  return out;
}

}  // namespace

TEST_CASE("there and back again is where one started, to the last bit") {
  const Plan plan = fixtures::walk();
  for (const Similarity& by : {kSmaller, kLarger, kSlower}) {
    const Plan back = similar_walk(inverse(by), similar_walk(by, plan));
    CHECK(back.robot.inertia == plan.robot.inertia);
    CHECK(back.robot.swing_height == plan.robot.swing_height);
    CHECK(back.scene.gravity == plan.scene.gravity);
    for (std::size_t k = 0; k < plan.phases.size(); ++k) {
      const PlanState here = plan.at_phase(k, 0.5 * plan.phases[k].duration);
      const PlanState there = back.at_phase(k, 0.5 * back.phases[k].duration);
      CHECK(here.com_W == there.com_W);
      for (std::size_t l = 0; l < here.end_effectors.size(); ++l) {
        CHECK(here.end_effectors[l].force_W == there.end_effectors[l].force_W);
        CHECK(here.end_effectors[l].position_W == there.end_effectors[l].position_W);
      }
    }
  }
}

TEST_CASE("all that a robot's fields say of lengths is scaled, of legs and trunk as well") {
  const mcplan::Robot robot = mcplan::load_robot("talos"), other = scaled(robot, kLarger);
  const double length = kLarger.length;
  REQUIRE(!robot.trunk.empty());
  for (std::size_t i = 0; i < robot.trunk.size(); ++i) {
    CHECK(other.trunk[i].radius == length * robot.trunk[i].radius);
    CHECK(other.trunk[i].from_B == length * robot.trunk[i].from_B);
    CHECK(other.trunk[i].to_B == length * robot.trunk[i].to_B);
  }
  const mcplan::EndEffector &foot = robot.end_effectors[0], &larger = other.end_effectors[0];
  CHECK(larger.usual_reach == length * foot.usual_reach);
  REQUIRE(foot.limb.radius > 0.0);
  for (double mcplan::LimbLimits::*member : {&mcplan::LimbLimits::upper, &mcplan::LimbLimits::lower,
                                             &mcplan::LimbLimits::radius, &mcplan::LimbLimits::beside})
    CHECK(larger.limb.*member == length * foot.limb.*member);
}

TEST_CASE("a similar motion has similar states and forces between its knots") {
  const Plan plan = fixtures::walk();
  for (const Similarity& by : {kSmaller, kLarger, kSlower}) {
    const Plan other = similar_walk(by, plan);
    for (double t : {0.1, 0.9, 1.7, 3.3}) {
      const PlanState a = plan.at(t), b = other.at(t * by.time);
      CHECK(b.com_W == a.com_W * by.length);
      CHECK(b.com_velocity_W == a.com_velocity_W * by.velocity());
      CHECK(b.angular_momentum_W == a.angular_momentum_W * by.angular_momentum());
      for (std::size_t l = 0; l < a.end_effectors.size(); ++l)
        CHECK(b.end_effectors[l].force_W == a.end_effectors[l].force_W * by.force());
    }
  }
}

TEST_CASE("a similar motion has a similar swing under way at its start") {
  Plan plan = fixtures::walk();
  plan.swings[0].first_phase = 0;
  plan.swings[0].elapsed_s = 0.25;
  for (const Similarity& by : {kSmaller, kLarger, kSlower}) {
    const Plan other = similar_walk(by, plan);
    const mcplan::EndEffectorState a = plan.at(0.3).end_effectors[fixtures::left_foot],
                                   b = other.at(0.3 * by.time).end_effectors[fixtures::left_foot];
    CHECK(b.position_W == a.position_W * by.length);
    CHECK(b.velocity_W == a.velocity_W * by.velocity());
  }
}

TEST_CASE("the checker measures a similar motion in the same parts of its tolerances") {
  Plan plan = fixtures::walk();
  for (int k = 8; k <= 9; ++k) plan.knots[k].end_effectors_W[fixtures::left_foot].x() += 0.002;
  const CheckResult here = check(plan, plan.scene, plan.robot);
  CHECK_FALSE(here.ok());
  for (const Similarity& by : {kSmaller, kLarger, kSlower}) {
    const Plan other = similar_walk(by, plan);
    const CheckResult there = check(other, other.scene, other.robot);
    REQUIRE(here.constraints.size() == there.constraints.size());
    for (std::size_t i = 0; i < here.constraints.size(); ++i) {
      const mcplan::Violation &a = here.constraints[i], &b = there.constraints[i];
      CAPTURE(a.name);
      CHECK(a.phase == b.phase);
      CHECK(a.unit == b.unit);
      if (a.tolerance > 0.0) CHECK(a.value / a.tolerance == b.value / b.tolerance);
    }
  }
}

TEST_CASE("the checker forgives a similar motion as much of its start") {
  Plan plan = fixtures::walk();
  plan.measured_start = true;
  plan.start_slack_s = 0.3;
  plan.knots[0].end_effectors_W[fixtures::right_hand].y() -= 0.23;
  const CheckResult here = check(plan, plan.scene, plan.robot);
  REQUIRE(here.start.size() == 1);
  for (const Similarity& by : {kSmaller, kLarger, kSlower}) {
    const Plan other = similar_walk(by, plan);
    const CheckResult there = check(other, other.scene, other.robot);
    REQUIRE(there.start.size() == 1);
    CHECK(there.start[0].value == here.start[0].value * by.length);
    CHECK(there.kept_until_s == here.kept_until_s * by.time);
    CHECK(there.worst().value / there.worst().tolerance == here.worst().value / here.worst().tolerance);
  }
}

TEST_CASE("swing heights and durations that nobody has set stay so") {
  const mcplan::Robot unset;
  CHECK(scaled(unset, kLarger).swing_height == unset.swing_height);
  CHECK(scaled(unset, kLarger).phase_duration == unset.phase_duration);
  mcplan::Robot set;
  set.phase_duration = {0.3, 0.6};
  CHECK(scaled(set, kLarger).phase_duration == Eigen::Vector2d(1.2, 2.4));
}
