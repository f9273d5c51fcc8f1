/// Plans that were edited until they no longer fit together: whoever is asked about them throws, and reads nothing
/// that is not there.

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "mcplan/base/error.hpp"
#include "mcplan/plan/friction_use.hpp"
#include "plan/point_fixtures.hpp"

namespace {

using namespace fixtures;
using mcplan::InvalidInput;
using mcplan::InvalidPlan;
using mcplan::Plan;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
constexpr int kSwinging = 3;  // phase of the walk in which the left foot swings

struct Edit {
  std::string field;
  std::function<void(Plan&)> make;
};

/// Each makes the walk's phase 3 point outside of something.
std::vector<Edit> edits() {
  return {
      {"phases", [](Plan& p) { p.phases.clear(); }},
      {"knots", [](Plan& p) { p.knots.resize(4); }},
      {"knots", [](Plan& p) { p.knots.clear(); }},
      {"knots[3].end_effectors", [](Plan& p) { p.knots[3].end_effectors_W.pop_back(); }},
      {"knots[4].end_effectors", [](Plan& p) { p.knots[4].end_effectors_W.clear(); }},
      {"knots[4].end_effector_velocities", [](Plan& p) { p.knots[4].end_effector_velocities_W.pop_back(); }},
      {"phases[3].contacts", [](Plan& p) { p.phases[3].contacts.pop_back(); }},
      {"phases[3].contacts", [](Plan& p) { p.phases[3].contacts.clear(); }},
      {"phases[3].contacts", [](Plan& p) { p.robot.end_effectors.resize(1); }},
      {"phases[3].contacts", [](Plan& p) { p.robot = mcplan::Robot(); }},
      {"phases[3].duration", [](Plan& p) { p.phases[3].duration = -0.4; }},
      {"swings[0].end_effector", [](Plan& p) { p.swings[0].end_effector = 4; }},
      {"swings[0].end_effector", [](Plan& p) { p.swings[0].end_effector = -1; }},
      {"swings[0]", [](Plan& p) { p.swings[0].end_phase = 100; }},
      {"swings[0]", [](Plan& p) { p.swings[0].first_phase = std::numeric_limits<int>::min(); }},
      {"knots[4].end_effectors", [](Plan& p) { p.knots[p.swings[0].end_phase].end_effectors_W.resize(1); }},
  };
}

std::string field_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.field();
  }
  return "no error";
}

}  // namespace

TEST_CASE("an edited plan answers with the field that does not fit, whatever is asked") {
  REQUIRE(walk().swings[0].first_phase <= kSwinging);
  REQUIRE(walk().swings[0].end_phase == kSwinging + 1);
  for (const Edit& edit : edits()) {
    CAPTURE(edit.field);
    Plan plan = walk();
    edit.make(plan);
    CHECK(field_of([&] { plan.at_phase(kSwinging, 0.1); }) == edit.field);
    CHECK_THROWS_AS(plan.validate(), InvalidPlan);
    for (double t : {0.0, 1.3, 4.8}) {
      try {
        plan.at(t);
      } catch (const InvalidInput&) {
      }
    }
  }
}

TEST_CASE("an instant that is no number, or outside of its phase, is named") {
  for (const Plan& plan : {walk(), step_on_corners()})
    for (double since : {kNan, kInf, -kInf, -1e-6, plan.phases[0].duration + 1e-6, 1e300}) {
      CHECK(field_of([&] { plan.at_phase(0, since); }) == "since_start");
      CHECK(field_of([&] { plan.at(since == since ? 1e3 * since : since); }) == "t");
    }
}

TEST_CASE("intervals and forces at points that do not fit are refused before they are counted on") {
  for (int intervals : {0, -1, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    Plan plan = step_on_corners();
    plan.phases[0].intervals = intervals;
    for (mcplan::Contact& contact : plan.phases[0].contacts) {
      contact.points_W.clear();
      contact.point_forces_W.clear();
    }
    CHECK(field_of([&] { plan.at(0.0); }) == "phases[0].intervals");
    CHECK(field_of([&] { plan.validate(); }) == "phases[0].intervals");
  }
}

TEST_CASE("swings, clearances and friction are not read out of a plan that does not fit together") {
  for (const Edit& edit : edits()) {
    if (edit.field == "phases[3].duration") continue;  // a phase without a duration is left out of samples
    CAPTURE(edit.field);
    Plan plan = walk();
    edit.make(plan);
    CHECK_THROWS_AS(mcplan::friction_use(plan), InvalidPlan);
    const bool of_swings = edit.field.rfind("swings", 0) == 0;
    if (!of_swings) CHECK_THROWS_AS(mcplan::choose_swings(plan), InvalidPlan);
  }
  Plan plan = walk();
  plan.phases[2].contacts[0].surface = 99;
  CHECK_THROWS_AS(mcplan::friction_use(plan), InvalidPlan);
  CHECK_THROWS_AS(mcplan::choose_swings(plan), InvalidPlan);
  for (int end : {-1, 4})
    CHECK_THROWS_AS(mcplan::free_stretches(walk(), mcplan::solids_of(walk().scene), end), InvalidInput);
  for (double sample_s : {0.0, -1.0, kNan, 1e-300})
    CHECK_THROWS_AS(mcplan::friction_use(walk(), sample_s), InvalidInput);
}
