#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "mcplan/base/error.hpp"
#include "mcplan/plan/plan.hpp"
#include "plan/point_fixtures.hpp"
#include "plan/wrench_fixtures.hpp"

using namespace fixtures;
using mcplan::Plan;

namespace {

/// Field of the error that a change to a valid plan brings.
std::string field(const std::function<void(Plan&)>& mutate, Plan plan = walk()) {
  mutate(plan);
  try {
    plan.validate();
  } catch (const mcplan::InvalidPlan& error) {
    return error.field();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("validate names the field that does not fit") {
  CHECK(field([](Plan&) {}) == "accepted");
  CHECK(field([](Plan& p) { p.phases.clear(); }) == "phases");
  CHECK(field([](Plan& p) { p.knots.pop_back(); }) == "knots");
  CHECK(field([](Plan& p) { p.knots[2].end_effectors_W.pop_back(); }) == "knots[2].end_effectors");
  CHECK(field([](Plan& p) { p.knots[2].com_W.x() = std::nan(""); }) == "knots[2]");
  CHECK(field([](Plan& p) { p.knots[4].end_effector_velocities_W[1].x() = INFINITY; }) == "knots[4]");
  CHECK(field([](Plan& p) { p.phases[1].duration = 0.0; }) == "phases[1].duration");
  CHECK(field([](Plan& p) { p.phases[1].contacts.pop_back(); }) == "phases[1].contacts");
  CHECK(field([](Plan& p) { p.phases[1].contacts[2].surface = 5; }) == "phases[1].contacts[2].surface");
  CHECK(field([](Plan& p) { p.phases[1].contacts[2].stiffness = std::nan(""); }) == "phases[1].contacts[2]");
  CHECK(field([](Plan& p) { p.final_contacts.pop_back(); }) == "final_contacts");
  CHECK(field([](Plan& p) { p.final_contacts[0] = 9; }) == "final_contacts");
  CHECK(field([](Plan& p) { p.swings[1].end_phase = 13; }) == "swings[1]");
  CHECK(field([](Plan& p) { p.swings[1].end_effector = 4; }) == "swings[1]");
  CHECK(field([](Plan& p) { p.swings[1].height = std::nan(""); }) == "swings[1]");
  CHECK(field([](Plan& p) { p.swings[2].lift_normal_W.z() = INFINITY; }) == "swings[2]");
}

TEST_CASE("slack of the start is a time that a measured start alone has") {
  const auto with = [](bool measured, double slack_s) {
    return field([&](Plan& p) { p.measured_start = measured, p.start_slack_s = slack_s; });
  };
  CHECK(with(true, 0.4) == "accepted");
  CHECK(with(true, 0.0) == "accepted");
  CHECK(with(false, 0.0) == "accepted");
  CHECK(with(false, 0.4) == "start_slack_s");
  for (const double bad : {-0.1, -HUGE_VAL, HUGE_VAL, std::nan("")}) CHECK(with(true, bad) == "start_slack_s");
  Plan plan = walk();
  plan.start_slack_s = 0.4;
  CHECK_THROWS_WITH_AS(plan.validate(), "start_slack_s: must be 0 without measured_start, got 0.4",
                       mcplan::InvalidPlan);
  plan.measured_start = true;
  plan.start_slack_s = -1.0;
  CHECK_THROWS_WITH_AS(plan.validate(), "start_slack_s: must lie in [0, inf) s, got -1", mcplan::InvalidPlan);
}

TEST_CASE("validate names the field of forces at points that does not fit") {
  const auto of_step = [](const std::function<void(Plan&)>& mutate) { return field(mutate, step_on_corners()); };
  CHECK(of_step([](Plan&) {}) == "accepted");
  CHECK(of_step([](Plan& p) { p.knots[1].angular_momentum_W.y() = INFINITY; }) == "knots[1]");
  CHECK(of_step([](Plan& p) { p.phases[0].intervals = 0; }) == "phases[0].intervals");
  CHECK(of_step([](Plan& p) { p.phases[0].intervals = 3; }) == "phases[0].contacts[0].point_forces");
  CHECK(of_step([](Plan& p) { p.phases[2].law = mcplan::laws::Linear(); }) == "phases[2].contacts[0].point_forces");
  CHECK(of_step([](Plan& p) { p.phases[1].contacts[1].points_W.pop_back(); }) == "phases[1].contacts[1].point_forces");
  CHECK(of_step([](Plan& p) { p.phases[1].contacts[1].points_W[2].x() = std::nan(""); }) == "phases[1].contacts[1]");
  CHECK(of_step([](Plan& p) { p.phases[1].contacts[1].point_forces_W[7].x() = NAN; }) == "phases[1].contacts[1]");
  CHECK(of_step([](Plan& p) { p.phases[0].contacts[0].surface = -1; }) == "phases[0].contacts[0].points");
  CHECK(of_step([](Plan& p) { p.phases[0].contacts[1].stiffness = 1.0; }) == "phases[0].contacts[1].stiffness");
  CHECK(of_step([](Plan& p) { p.phases[0].contacts[1].anchor_W.z() = 1.0; }) == "phases[0].contacts[1].anchor");
  CHECK(of_step([](Plan& p) { p.phases[0].contacts[1].moment_W.z() = 1.0; }) == "phases[0].contacts[1].moment");
  CHECK(field([](Plan& p) { p.phases[2].intervals = 4; }) == "phases[2].intervals");
  CHECK(field([](Plan& p) {
          p.phases[2].contacts[0].points_W.push_back({0, 0, 0});
        }) == "phases[2].contacts[0].points");
}

TEST_CASE("validate names the field of contact wrenches that does not fit") {
  const auto of_walk = [](const std::function<void(Plan&)>& mutate) { return field(mutate, wrench_walk()); };
  CHECK(of_walk([](Plan&) {}) == "accepted");
  CHECK(of_walk([](Plan& p) {
          for (auto& knot : p.knots) knot.end_effector_yaw.clear();
        }) == "accepted");
  CHECK(of_walk([](Plan& p) { p.knots[2].end_effector_yaw.pop_back(); }) == "knots[2].end_effector_yaw");
  CHECK(of_walk([](Plan& p) { p.knots[2].end_effector_yaw.clear(); }) == "knots[2].end_effector_yaw");
  CHECK(of_walk([](Plan& p) { p.knots[0].end_effector_yaw.clear(); }) == "knots[1].end_effector_yaw");
  CHECK(of_walk([](Plan& p) { p.knots[2].end_effector_yaw[3] = std::nan(""); }) == "knots[2]");
  CHECK(of_walk([](Plan& p) { p.phases[1].contacts[0].center_of_pressure_W.y() = INFINITY; }) ==
        "phases[1].contacts[0]");
  CHECK(of_walk([](Plan& p) { p.phases[1].intervals = 2; }) == "phases[1].intervals");
  CHECK(of_walk([](Plan& p) {
          p.phases[1].contacts[0].points_W.push_back({0, 0, 0});
        }) == "phases[1].contacts[0].points");
  CHECK(field([](Plan& p) { p.phases[0].contacts[1].center_of_pressure_W.z() = 1.0; }, step_on_corners()) ==
        "phases[0].contacts[1].center_of_pressure");
}
