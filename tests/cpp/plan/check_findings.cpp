#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "mcplan/base/error.hpp"
#include "plan/checker_case.hpp"
#include "plan/swings.hpp"

using namespace checker_case;

namespace {

CheckResult check_until(const Case& c, double until_s) {
  return mcplan::check(c.plan, c.scene, c.robot, {}, {}, until_s);
}

/// The first `phases` phases, as a plan that ends on the way. No swing of the walk goes on over a knot.
Case truncated(Case c, int phases) {
  c.plan.final_contacts.clear();
  for (const auto& contact : c.plan.phases[phases].contacts) c.plan.final_contacts.push_back(contact.surface);
  c.plan.phases.resize(phases);
  c.plan.knots.resize(phases + 1);
  auto& swings = c.plan.swings;
  swings.erase(std::remove_if(swings.begin(), swings.end(), [&](const auto& s) { return s.end_phase > phases; }),
               swings.end());
  c.plan.open_end = true;
  return c;
}

void check_equal(const CheckResult& a, const CheckResult& b) {
  REQUIRE(a.constraints.size() == b.constraints.size());
  for (std::size_t i = 0; i < a.constraints.size(); ++i) {
    const auto &x = a.constraints[i], &y = b.constraints[i];
    CAPTURE(x.name);
    CHECK(x.name == y.name);
    CHECK(x.phase == y.phase);
    CHECK(x.end_effector == y.end_effector);
    CHECK(x.time_s == y.time_s);
    CHECK(x.value == y.value);
    CHECK(x.tolerance == y.tolerance);
    CHECK(x.unit == y.unit);
  }
  CHECK(a.kept_until_s == b.kept_until_s);
  CHECK(a.checked_until_s == b.checked_until_s);
  CHECK(a.ok() == b.ok());
}

/// Walks with a violation or none, in the middle or at knots, of places, forces, sequence.
std::vector<Case> cases() {
  std::vector<Case> out(7);
  out[1].plan.knots[5].com_W.x() += 1e-4;
  out[2].plan.knots[6].end_effectors_W[right_hand].y() -= 0.25;
  out[3].plan.phases[4].contacts[left_foot].stiffness *= -1.0;
  out[4].plan.phases[6].contacts[right_foot].surface = hand_patch;
  shift_foothold(out[5].plan, left_foot, 4, 6, {0.0, 0.05, 0.01});
  out[6].robot.max_com_speed = 0.08;
  return out;
}

/// Of the walk: when the CoM is first faster than `max`, or the right hand below `low` in y from it, beyond the
/// tolerances, at the instants that the checker looks at; infinite: never.
double first_violation(const Case& c, double max, double low) {
  const mcplan::Tolerances tolerances;
  for (std::size_t k = 0; k < c.plan.phases.size(); ++k)
    for (int i = 0; i <= 400; ++i) {
      const auto state = c.plan.at_phase(static_cast<int>(k), kPhase * i / 400);
      Vector3d offset = state.end_effectors[right_hand].position_W - state.com_W;
      offset.head<2>() = Eigen::Rotation2Dd(-state.base_rpy.z()) * offset.head<2>();
      if (state.com_velocity_W.norm() > max + tolerances.boundary || offset.y() < low - tolerances.reach)
        return c.plan.knot_times()[k] + kPhase * i / 400;
    }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

TEST_CASE("a check up to a knot says what a check of the plan that ends there says") {
  for (const Case& c : cases())
    for (int k = 1; k < 12; ++k) {
      CAPTURE(k);
      const double until_s = c.plan.knot_times()[k];
      check_equal(check_until(c, until_s), truncated(c, k).check());
    }
}

TEST_CASE("a check up to an instant within a phase leaves out the knot at its end and all later ones") {
  for (int k = 0; k < 12; ++k) {
    Case c;
    c.plan.knots[k + 1].com_W.x() += 1e-4;
    c.plan.knots[k + 1].end_effectors_W[right_hand].y() -= 0.25;  // the spline to it is another from knot k on
    const double begin_s = c.plan.knot_times()[k];
    CHECK(check_until(c, begin_s + 0.01).ok());
    CHECK(check_until(c, begin_s + 0.01).checked_until_s == begin_s + 0.01);
    const Names names = checker_case::names(check_until(c, begin_s + kPhase));
    CHECK(names.count("dynamics") == 1);
    CHECK(names.count("reach") == 1);
  }
}

TEST_CASE("a check up to the end or beyond is a check of the whole plan") {
  for (const Case& c : cases())
    for (const double until_s : {c.plan.knot_times().back(), 100.0, std::numeric_limits<double>::infinity()})
      check_equal(check_until(c, until_s), c.check());
  Case lost;
  lost.plan.scene.goal.position_W.x() += 1.0;
  lost.scene.goal.position_W.x() += 1.0;
  CHECK(names(lost.check()) == Names{"goal"});
  CHECK(lost.check().kept_until_s == lost.plan.duration());
  CHECK(check_until(lost, lost.plan.duration() - 1e-3).ok());
  CHECK(find(check_until(lost, 1.0), "goal").phase == -1);
}

TEST_CASE("an instant that is none is refused, up to which to check") {
  for (const double until_s : {0.0, -1.0, std::nan("")})
    CHECK_THROWS_AS(check_until(Case(), until_s), mcplan::InvalidOptions);
}

TEST_CASE("a plan is kept until its earliest violation, whatever is worst") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int early = 0;
  for (int n = 0; n < 60; ++n) {
    CAPTURE(n);
    Case c;
    const double max = 0.02 + 0.25 * uniform(random);
    const int first = 1 + static_cast<int>(4 * uniform(random));
    auto& end = c.robot.end_effectors[right_hand];
    // A hand that goes out a little, and later, where its knot is looked at before all motion, much.
    c.plan.knots[first].end_effectors_W[right_hand].y() += -0.19 - 0.06 * uniform(random);
    if (n % 2) c.plan.knots[9].end_effectors_W[right_hand].y() -= 0.5;
    if (n % 3 != 0) c.robot.max_com_speed = max;
    mcplan::choose_swings(c.plan, false);
    for (auto& swing : c.plan.swings)
      if (swing.end_effector == left_foot || swing.end_effector == right_foot) swing.height = 0.08;
    double expected = first_violation(c, c.robot.max_com_speed, end.reach_min_B.y());
    if (n % 2) expected = std::min(expected, c.plan.knot_times()[9]);
    // What knots state of the hand is looked at as well as its path, which bends into the box.
    const auto& knot = c.plan.knots[first];
    Vector3d stated = knot.end_effectors_W[right_hand] - knot.com_W;
    stated.head<2>() = Eigen::Rotation2Dd(-knot.base_rpy.z()) * stated.head<2>();
    if (stated.y() < end.reach_min_B.y() - mcplan::Tolerances().reach)
      expected = std::min(expected, c.plan.knot_times()[first]);
    const CheckResult result = c.check();
    early += expected < result.worst().time_s;
    CHECK(result.kept_until_s == doctest::Approx(std::min(expected, c.plan.duration())).epsilon(1e-9));
    CHECK(result.checked_until_s == c.plan.duration());
    CHECK(result.ok() == std::isinf(expected));
    // Up to there the plan may be followed.
    if (expected > 2e-3 && !std::isinf(expected)) {
      CHECK(check_until(c, expected - 1e-3).ok());
      CHECK_FALSE(check_until(c, expected + 1e-9).ok());
    }
  }
  CHECK(early > 10);
}

TEST_CASE("a plan that could not be evaluated is kept at no time; one whose check was stopped as far as that went") {
  Case c;
  c.plan.phases[4].duration = 0.0;
  CHECK(c.check().kept_until_s == 0.0);
  CHECK(c.check().checked_until_s == 0.0);
  CHECK(CheckResult().kept_until_s == 0.0);
  const Case made;
  int asked = 0;
  const CheckResult part = mcplan::check(made.plan, made.scene, made.robot, {}, [&] { return ++asked > 5; });
  CHECK_FALSE(part.complete);
  CHECK(part.checked_until_s > 0.0);
  CHECK(part.checked_until_s < made.plan.duration());
  CHECK(part.kept_until_s == part.checked_until_s);
}
