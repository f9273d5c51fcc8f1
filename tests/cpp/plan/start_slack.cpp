#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "mcplan/base/error.hpp"
#include "plan/checker_case.hpp"
#include "plan/clearance.hpp"
#include "plan/wrench_fixtures.hpp"

using namespace checker_case;
using mcplan::Violation;

namespace {

constexpr double kOut = 0.03, kSlack_s = 0.4;

/// The walk from a measured state in which the right hand is `out` beyond its box of reach, and moves with `inward`
/// [m/s] back to where the walk has it, from knot `back` on.
Case out_of_reach(double slack_s, double out = kOut, double inward = 0.25, int back = 1) {
  Case c;
  c.plan.measured_start = true;
  c.plan.start_slack_s = slack_s;
  const double side = c.robot.end_effectors[right_hand].reach_min_B.y();
  for (int k = 0; k < back; ++k) {
    auto& knot = c.plan.knots[k];
    knot.end_effectors_W[right_hand] = knot.com_W + Vector3d(0.0, side - out, 0.05);
    knot.end_effector_velocities_W[right_hand] = {0.0, k == 0 ? inward : 0.0, 0.0};
  }
  return c;
}

/// How far the right hand is outside its box of reach at t [m].
double beyond_reach(const Case& c, double t) {
  const auto state = c.plan.at(t);
  const auto& end = c.robot.end_effectors[right_hand];
  const double yaw = state.base_rpy.z();  // the walk's base turns about z alone
  Vector3d offset = state.end_effectors[right_hand].position_W - state.com_W;
  offset.head<2>() = Eigen::Rotation2Dd(-yaw) * offset.head<2>();
  return std::max((end.reach_min_B - offset).maxCoeff(), (offset - end.reach_max_B).maxCoeff());
}

double decay(double t, double slack_s) { return std::max(0.0, 1.0 - t * t / (slack_s * slack_s)); }

/// Largest value(t) - v_0 max(0, 1 - (t / T)^2) at the instants that the checker looks at.
template <class Value>
double largest_beyond(const Case& c, double excess, Value value) {
  double largest = -1e9;
  for (std::size_t k = 0; k < c.plan.phases.size(); ++k)
    for (int i = 0; i <= 400; ++i) {
      const double t = c.plan.knot_times()[k] + kPhase * i / 400;
      largest = std::max(
          largest, value(std::min(t, c.plan.duration())) - excess * decay(t, std::max(c.plan.start_slack_s, 1e-9)));
    }
  return largest;
}

/// A surface coplanar with the ground, on which the left foot stands at the start, 8 mm beyond the edge.
Case beyond_the_edge(double slack_s) {
  Case c;
  c.scene.surfaces.push_back(rectangle("ledge", -1, 2, -1, 0.092, 0));
  c.plan.scene = c.scene;
  c.plan.measured_start = true;
  c.plan.start_slack_s = slack_s;
  for (int k = 0; k < 3; ++k) c.plan.phases[k].contacts[left_foot].surface = hand_patch + 1;
  return c;
}

}  // namespace

TEST_CASE("a measured start 3 cm out of reach that comes back in 0.2 s is accepted with slack alone, and named apart") {
  const Case with = out_of_reach(kSlack_s);
  for (double t = 0.2; t < with.plan.duration(); t += 0.01) REQUIRE(beyond_reach(with, t) < 0.0);
  const CheckResult result = with.check();
  INFO(result.to_string());
  CHECK(result.ok());
  REQUIRE(result.start.size() == 1);
  const Violation& start = result.start.front();
  CHECK(start.name == "reach");
  CHECK(start.end_effector == "right_hand");
  CHECK(start.phase == 0);
  CHECK(start.time_s == 0.0);
  CHECK(start.unit == "m");
  CHECK(start.value == doctest::Approx(kOut).epsilon(1e-9));
  CHECK(start.tolerance == mcplan::Tolerances().reach);
  CHECK(result.to_string() ==
        "ok\nat the start: reach at right_hand in phase 0 (t = 0 s): 0.03 m over (made good within 0.4 s)");
  CHECK(result.kept_until_s == with.plan.duration());
  CHECK(result.start_slack_s == kSlack_s);

  const CheckResult without = out_of_reach(0.0).check();
  CHECK(names(without) == Names{"reach"});
  CHECK(without.start.empty());
  CHECK(without.kept_until_s == 0.0);
  CHECK(without.violations().front().value == doctest::Approx(kOut).epsilon(1e-9));
}

TEST_CASE("what is beyond the slack is the value less the decaying excess of the start") {
  for (const double slack_s : {0.05, 0.1, 0.2, 0.4, 3.0})
    for (const double inward : {-0.3, 0.0, 0.25, 0.6}) {
      CAPTURE(slack_s);
      CAPTURE(inward);
      const Case c = out_of_reach(slack_s, kOut, inward);
      const double beyond = largest_beyond(c, kOut, [&](double t) { return beyond_reach(c, t); });
      const CheckResult result = c.check();
      if (beyond > 0.0) CHECK(find(result, "reach").value == doctest::Approx(beyond).epsilon(1e-6));
      CHECK(result.ok() == (beyond <= mcplan::Tolerances().reach));
      CHECK(result.start.size() == 1);
    }
}

TEST_CASE("a measured start that stays out of reach longer than the slack is rejected by name") {
  const CheckResult result = out_of_reach(kSlack_s, kOut, 0.0, 4).check();
  CHECK(names(result) == Names{"reach"});
  CHECK(result.violations().front().end_effector == "right_hand");
  CHECK(result.to_string().find("(to be made good within 0.4 s)") != std::string::npos);
  CHECK(result.kept_until_s > 0.0);
  CHECK(result.kept_until_s < kSlack_s);
}

TEST_CASE("a measured start that goes farther out than it is, is rejected") {
  const CheckResult result = out_of_reach(3.0, kOut, -0.3).check();
  CHECK(names(result) == Names{"reach"});
}

TEST_CASE("slack forgives neither other constraints nor other end-effectors") {
  const auto broken_too = [](const std::function<void(Case&)>& mutate) {
    return broken(mutate, out_of_reach(kSlack_s));
  };
  CHECK(broken_too([](Case& c) { c.plan.knots[1].com_W.x() += 1e-7; }) == Names{"dynamics"});
  CHECK(broken_too([](Case& c) { c.scene.surfaces[ground].friction = 0.01; }).count("friction") == 1);
  CHECK(broken_too([](Case& c) { c.robot.end_effectors[left_foot].max_force = 100.0; }) == Names{"force_cap"});
  CHECK(broken_too([](Case& c) { shift_foothold(c.plan, left_foot, 1, 3, {0.003, 0, 0}); }).count("slip") == 1);
  CHECK(broken_too([](Case& c) { c.robot.max_com_speed = 0.05; }) == Names{"com_speed"});
  Case other = out_of_reach(kSlack_s);
  other.plan.knots[0].end_effector_velocities_W[left_hand].y() = 4.0;
  const CheckResult result = other.check();
  CHECK(names(result) == Names{"reach"});
  CHECK(result.violations().front().end_effector == "left_hand");
  CHECK(result.violations().front().time_s < kSlack_s);
  CHECK(result.start.size() == 1);
}

TEST_CASE("a start within its limits has no slack, however long it may last") {
  const auto same = [](Case c) {
    c.plan.measured_start = true;
    const CheckResult without = c.check();
    c.plan.start_slack_s = 10.0;
    const CheckResult with = c.check();
    CHECK(with.start.empty());
    CHECK(with.kept_until_s == without.kept_until_s);
    REQUIRE(with.constraints.size() == without.constraints.size());
    for (std::size_t i = 0; i < with.constraints.size(); ++i) {
      CHECK(with.constraints[i].to_string() == without.constraints[i].to_string());
      CHECK(with.constraints[i].value == without.constraints[i].value);
    }
  };
  same({});
  Case later;
  later.plan.knots[6].end_effectors_W[right_hand].y() -= 0.25;
  later.robot.max_com_speed = 0.05;
  same(later);
}

TEST_CASE("a sole beyond its polygon's edge is forgiven as long as it stands, and no longer") {
  CHECK(names(beyond_the_edge(0.0).check()) == Names{"contact_polygon"});
  const CheckResult result = beyond_the_edge(0.01).check();
  INFO(result.to_string());
  CHECK(result.ok());
  REQUIRE(result.start.size() == 1);
  CHECK(result.start.front().name == "contact_polygon");
  CHECK(result.start.front().end_effector == "left_foot");
  CHECK(result.start.front().value == doctest::Approx(0.008).epsilon(1e-9));
  CHECK(result.to_string().find("0.008 m over (as long as it stands)") != std::string::npos);

  Case again = beyond_the_edge(10.0);  // it comes down on the same surface, as far beyond the edge
  for (std::size_t k = 4; k < 6; ++k) again.plan.phases[k].contacts[left_foot].surface = hand_patch + 1;
  CHECK(names(again.check()).count("contact_polygon") == 1);
}

TEST_CASE("a sole off its plane is forgiven as long as it stands") {
  Case c = beyond_the_edge(0.01);
  c.scene.surfaces.back() = rectangle("ledge", -1, 2, -1, 1, -0.004);
  c.plan.scene = c.scene;
  const CheckResult result = c.check();
  INFO(result.to_string());
  CHECK(result.ok());
  REQUIRE(result.start.size() == 1);
  CHECK(result.start.front().name == "contact_distance");
  CHECK(result.start.front().value == doctest::Approx(0.004).epsilon(1e-9));
}

TEST_CASE("a free end-effector inside a bump is forgiven while it comes out") {
  Case c;
  c.plan.measured_start = true;
  c.plan.start_slack_s = kSlack_s;
  auto& knot = c.plan.knots[0];
  const Vector3d hand = knot.end_effectors_W[right_hand];
  knot.end_effector_velocities_W[right_hand] = {0.0, -0.3, 0.3};
  c.scene.surfaces.push_back(
      rectangle("bump", hand.x() - 0.05, hand.x() + 0.05, hand.y() - 0.05, hand.y() + 0.05, hand.z() + 0.02));
  c.scene.surfaces.back().thickness = 0.06;
  c.plan.knots[1].end_effectors_W[right_hand] += Vector3d(0.0, -0.1, 0.05);
  c.plan.scene = c.scene;
  const auto solids = mcplan::solids_of(c.scene);
  const auto depth = [&](double t) {
    return mcplan::clearance_depth(solids, c.plan.at(t).end_effectors[right_hand].position_W);
  };
  for (const double slack_s : {0.02, 0.1, 0.4}) {
    CAPTURE(slack_s);
    c.plan.start_slack_s = slack_s;
    const CheckResult result = c.check();
    CHECK(find(result, "clearance").value ==
          doctest::Approx(std::max(0.0, largest_beyond(c, 0.02, depth))).epsilon(1e-6));
    REQUIRE(!result.start.empty());
    CHECK(result.start.front().name == "clearance");
    CHECK(result.start.front().value == doctest::Approx(0.02).epsilon(1e-9));
  }
}

TEST_CASE("the CoM's speed at a measured start is forgiven while it slows down") {
  Case c;
  c.plan.measured_start = true;
  const auto speed = [&](double t) { return c.plan.at(t).com_velocity_W.norm(); };
  // The walk from its sixth phase on: the CoM is on its way.
  for (int k = 0; k < 5; ++k) {
    c.plan.knots.erase(c.plan.knots.begin());
    c.plan.phases.erase(c.plan.phases.begin());
  }
  c.plan.swings.erase(c.plan.swings.begin());
  for (auto& swing : c.plan.swings) swing.first_phase -= 5, swing.end_phase -= 5;
  const double max = 0.5 * speed(0.0);
  c.robot.max_com_speed = max;
  for (const double slack_s : {0.1, 1.0, 4.0}) {
    CAPTURE(slack_s);
    c.plan.start_slack_s = slack_s;
    const double expected = largest_beyond(c, max, [&](double t) { return speed(t) - max; });
    const CheckResult result = c.check();
    CHECK(find(result, "com_speed").value == doctest::Approx(expected).epsilon(1e-6));
    REQUIRE(result.start.size() == 1);
    CHECK(result.start.front().name == "com_speed");
    CHECK(result.start.front().end_effector.empty());
    CHECK(result.start.front().value == doctest::Approx(max).epsilon(1e-9));
  }
}

TEST_CASE("the yaw of a sole and its place have slack of their own") {
  mcplan::Plan plan = fixtures::stand_on_wrenches();
  plan.measured_start = true;
  plan.start_slack_s = 0.3;
  plan.robot.end_effectors[left_foot].yaw_range = {-0.05, 0.05};
  for (auto& knot : plan.knots) knot.end_effector_yaw[left_foot] = 0.1;
  const CheckResult result = mcplan::check(plan, plan.scene, plan.robot);
  REQUIRE(result.start.size() == 1);
  CHECK(result.start.front().unit == "rad");
  CHECK(result.start.front().value == doctest::Approx(0.05).epsilon(1e-9));
  CHECK(names(result) == Names{"reach"});  // the sole stays as it is
  CHECK(find(result, "reach").unit == "rad");
  CHECK(find(result, "reach").value == doctest::Approx(0.05).epsilon(1e-9));
}

TEST_CASE("slack that is none is refused") {
  Case c = out_of_reach(kSlack_s);
  c.plan.start_slack_s = -1.0;
  CHECK_THROWS_AS(c.check(), mcplan::InvalidPlan);
  c.plan.start_slack_s = 1.0;
  c.plan.measured_start = false;
  CHECK_THROWS_AS(c.check(), mcplan::InvalidPlan);
  c.plan.start_slack_s = std::nan("");
  const CheckResult result = c.check();
  CHECK(names(result) == Names{"finite"});
  CHECK(result.kept_until_s == 0.0);
  CHECK(result.checked_until_s == 0.0);
}
