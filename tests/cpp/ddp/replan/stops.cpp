#include "ddp/replan/stops.hpp"

#include <doctest/doctest.h>

#include "ddp/replan/under_feet.hpp"
#include "mcplan/ddp/plan.hpp"
#include "mcplan/ddp/replan.hpp"
#include "mcplan/mcplan.hpp"
#include "mcplan/plan/checker.hpp"
#include "scenes.hpp"

namespace {

using namespace mcplan;
using namespace mcplan::ddp;

const Plan& over_stones() {
  static const Plan plan = ddp::plan(load_scene("stepping_stones"), scenes::humanoid44()).plan;
  return plan;
}

/// The first swing that begins after a time: its end-effector, its surface and when it lands.
struct Step {
  int foot = 0, surface = kFree;
  double lifts_s = 0.0, lands_s = 0.0;
};
Step step_after(const Plan& plan, double t) {
  const std::vector<double> times = plan.knot_times();
  for (std::size_t k = 1; k < plan.phases.size(); ++k)
    for (int e = 0; e < plan.end_effector_count(); ++e) {
      const auto surface = [&](std::size_t j) {
        return j < plan.phases.size() ? plan.phases[j].contacts[e].surface : plan.final_contacts[e];
      };
      if (times[k] < t || surface(k) != kFree || surface(k - 1) == kFree) continue;
      std::size_t end = k;
      while (end < plan.phases.size() && surface(end) == kFree) ++end;
      if (surface(end) != kFree) return {e, surface(end), times[k], times[end]};
    }
  FAIL("there is a step");
  return {};
}

Scene without(Scene scene, int surface) {
  scene.surfaces[surface].end_effectors = {"nobody"};
  return scene;
}

}  // namespace

TEST_CASE("a stop lands the feet that are in the air, one after the other, and nothing more changes") {
  const Plan& plan = over_stones();
  const Similarity human = similarity_of(plan.robot, plan.scene.gravity);
  const Step step = step_after(plan, 1.0);
  const Rest rest = rest_of(plan, 0.5 * (step.lifts_s + step.lands_s));
  const std::vector<Rest> found = stops(rest, plan.scene, plan.robot, human);
  REQUIRE(!found.empty());
  CHECK(found.size() <= 3);
  for (const Rest& stop : found) {
    CHECK(stop.contacts(0) == rest.contacts(0));
    int changes = 0;
    for (int k = 1; k <= stop.size(); ++k)
      for (int e = 0; e < plan.end_effector_count(); ++e) changes += stop.surface(k, e) != stop.surface(k - 1, e);
    CHECK(changes == 1);
    CHECK(stop.plan.final_contacts[step.foot] != kFree);
    CHECK(may_touch(plan.scene.surfaces[stop.plan.final_contacts[step.foot]], plan.robot.end_effectors[step.foot]));
  }
  CHECK(found.front().plan.final_contacts[step.foot] == step.surface);
  // Where both feet stand nothing changes at all; where none does there is no stop.
  const Rest standing = rest_of(plan, 0.0);
  for (const Rest& stop : stops(standing, plan.scene, plan.robot, human))
    CHECK(stop.contacts(stop.size()) == standing.contacts(0));
  Rest flying = rest;
  for (Contact& contact : flying.plan.phases.front().contacts) contact.surface = kFree;
  CHECK(stops(flying, plan.scene, plan.robot, human).empty());
}

TEST_CASE("contacts on a surface that is gone move to the nearest one, others stay") {
  const Plan& plan = over_stones();
  const Step step = step_after(plan, 1.0);
  const Rest rest = rest_of(plan, 0.5 * (step.lifts_s + step.lands_s));
  Rest same = rest;
  CHECK_FALSE(stand_on_others(same, plan.scene, plan.robot));
  Rest moved = rest;
  const Scene scene = without(plan.scene, step.surface);
  REQUIRE(stand_on_others(moved, scene, plan.robot));
  for (int k = 0; k <= rest.size(); ++k)
    for (int e = 0; e < plan.end_effector_count(); ++e) {
      const int before = rest.surface(k, e), after = moved.surface(k, e);
      if (before == step.surface) {
        CHECK(after != step.surface);
        CHECK(may_touch(scene.surfaces[after], plan.robot.end_effectors[e]));
      } else {
        CHECK(after == before);
      }
    }
}

TEST_CASE("where a stone is gone while the foot is on its way, a plan that the checker accepts keeps the robot up") {
  const Plan& plan = over_stones();
  for (const double after_s : {1.0, 2.0, 3.0}) {
    CAPTURE(after_s);
    const Step step = step_after(plan, after_s);
    for (const double before_s : {0.6, 0.5}) {
      const double t = step.lands_s - before_s;
      CAPTURE(t);
      Measured measured;
      measured.state = rest_of(plan, t).plan.knots.front();
      const PlanResult result = ddp::replan(plan, t, measured, without(plan.scene, step.surface), plan.robot);
      INFO(result.report.message);
      REQUIRE(!result.plan.phases.empty());
      CHECK(result.report.plan_from != PlanFrom::same_sequence);
      const CheckResult again =
          check(result.plan, result.plan.scene, result.plan.robot, {}, {}, result.report.kept_until_s);
      CHECK(again.ok());
      CHECK(result.report.kept_until_s > before_s);  // the foot has landed
      for (const Phase& phase : result.plan.phases) CHECK(phase.contacts[step.foot].surface != step.surface);
      if (result.report.plan_from == PlanFrom::stop) CHECK(result.plan.knots.back().com_velocity_W.norm() < 1e-3);
    }
  }
}
