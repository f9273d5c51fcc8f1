#include "ddp/replan/tail.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "mcplan/ddp/plan.hpp"
#include "mcplan/ddp/replan.hpp"
#include "mcplan/mcplan.hpp"
#include "mcplan/plan/checker.hpp"
#include "scenes.hpp"

namespace {

using namespace mcplan;
using namespace mcplan::ddp;
using Eigen::Vector3d;

/// A walk of 26 phases.
const Plan& walk() {
  static const Plan plan = [] {
    Options options;
    options.phases = 26;
    return ddp::plan(scenes::flat(), load_robot("talos"), options).plan;
  }();
  return plan;
}

Measured planned_at(double t) { return {rest_of(walk(), t).plan.knots.front(), {}}; }

/// So many phases at least are planned anew.
constexpr int kNew = 12;

PlanResult replanned(const Measured& measured, double t, const Scene& scene, int horizon = kNew / 2) {
  ReplanOptions options;
  options.horizon = horizon;
  return ddp::replan(walk(), t, measured, scene, walk().robot, options);
}

/// How many knots at the end are, to the bit, those of the walk.
int kept_knots(const Plan& plan) {
  int count = 0;
  const auto same = [](const Knot& one, const Knot& other) {
    return one.com_W == other.com_W && one.com_velocity_W == other.com_velocity_W && one.base_rpy == other.base_rpy &&
           one.angular_momentum_W == other.angular_momentum_W && one.end_effectors_W == other.end_effectors_W;
  };
  while (count < static_cast<int>(plan.knots.size()) &&
         same(plan.knots[plan.knots.size() - 1 - count], walk().knots[walk().knots.size() - 1 - count]))
    ++count;
  return count;
}

constexpr double kTime_s = 0.6;

}  // namespace

TEST_CASE(
    "what lies beyond the horizon of a replan stays as it was planned, and all of it is what the checker accepts") {
  for (const Vector3d& push_m_s : {Vector3d(0.0, 0.0, 0.0), Vector3d(0.05, -0.05, 0.0), Vector3d(0.0, 0.15, 0.02)}) {
    CAPTURE(push_m_s.transpose());
    Measured measured = planned_at(kTime_s);
    measured.state.com_velocity_W += push_m_s;
    const PlanResult result = replanned(measured, kTime_s, walk().scene);
    INFO(result.report.message);
    REQUIRE(result.report.status == Status::solved);
    REQUIRE(result.report.plan_from == PlanFrom::same_sequence);
    CHECK(check(result.plan, result.plan.scene, result.plan.robot).ok());
    const int kept = kept_knots(result.plan);
    CHECK(kept >= 8);
    CHECK(static_cast<int>(result.plan.phases.size()) - kept + 1 >= kNew);
    CHECK(result.plan.final_contacts == walk().final_contacts);
    CHECK(result.report.kept_until_s == result.plan.duration());
  }
}

TEST_CASE("what stays as it was planned is looked at, too") {
  Plan broken = walk();
  broken.phases[broken.phases.size() - 4].contacts[0].stiffness *= 3.0;  // the CoM does not come to its next knot
  ReplanOptions options;
  options.horizon = kNew / 2;
  const PlanResult result = ddp::replan(broken, kTime_s, planned_at(kTime_s), options);
  CHECK((result.report.status == Status::solved) == check(result.plan, result.plan.scene, result.plan.robot).ok());
}

TEST_CASE("where what stays as it was planned exceeds limits, all is planned anew, pushed or not") {
  for (const double push_m_s : {0.0, 0.12}) {
    CAPTURE(push_m_s);
    Plan broken = walk();
    broken.knots[broken.knots.size() - 4].com_velocity_W.y() += 0.3;
    ReplanOptions options;
    options.horizon = kNew / 2;
    Measured measured = planned_at(kTime_s);
    measured.state.com_velocity_W.x() += push_m_s;
    const PlanResult result = ddp::replan(broken, kTime_s, measured, options);
    INFO(result.report.message);
    CHECK(result.report.status == Status::solved);
    CHECK(check(result.plan, result.plan.scene, result.plan.robot).ok());
  }
}

TEST_CASE("a plan that another model has made is planned anew as a whole") {
  Plan lipm = walk();
  for (Knot& knot : lipm.knots) knot.end_effector_yaw.clear();  // as plans of the pendulum have none
  ReplanOptions options;
  options.horizon = kNew / 2;
  const PlanResult result = ddp::replan(lipm, kTime_s, planned_at(kTime_s), options);
  CHECK(kept_knots(result.plan) < 2);
  for (const Knot& knot : result.plan.knots) CHECK(knot.end_effector_yaw.size() == 4);
  Rest rest = rest_of(walk(), kTime_s);
  options.search.model = Model::lipm;
  keep_tail(rest, walk(), walk().scene, walk().robot, options, 3);
  CHECK(!rest.tail);
}

TEST_CASE("swings and headings go on where what was planned is put after what is new") {
  const PlanResult result = replanned(planned_at(kTime_s), kTime_s, walk().scene);
  const Plan& plan = result.plan;
  const int kept = kept_knots(plan), first = static_cast<int>(plan.knots.size()) - kept;
  const int before = static_cast<int>(walk().knots.size()) - kept;
  for (const Swing& swing : walk().swings) {
    if (swing.first_phase < before) continue;
    CHECK(std::any_of(plan.swings.begin(), plan.swings.end(), [&](const Swing& other) {
      return other.end_effector == swing.end_effector && other.first_phase == swing.first_phase - before + first &&
             other.end_phase == swing.end_phase - before + first && other.height == swing.height;
    }));
  }
  // A hand that touches nothing has one swing, all through the plan.
  for (int e : {2, 3}) {
    const auto of_hand = [&](const Swing& swing) { return swing.end_effector == e; };
    REQUIRE(std::count_if(plan.swings.begin(), plan.swings.end(), of_hand) == 1);
    const Swing& swing = *std::find_if(plan.swings.begin(), plan.swings.end(), of_hand);
    CHECK(swing.first_phase == 0);
    CHECK(swing.end_phase == static_cast<int>(plan.phases.size()));
  }
  for (int e : {0, 1})
    for (int k = first; k < static_cast<int>(plan.phases.size()) && plan.phases[k].contacts[e].surface >= 0; ++k)
      CHECK(plan.knots[k + 1].end_effector_yaw[e] == plan.knots[first].end_effector_yaw[e]);
}

TEST_CASE("all of a plan is planned anew with a horizon that is long enough, or where the ground has changed") {
  CHECK(kept_knots(replanned(planned_at(kTime_s), kTime_s, walk().scene, ReplanOptions().horizon).plan) < 2);
  Scene slippery = walk().scene;
  for (Surface& surface : slippery.surfaces) surface.friction *= 0.9;
  const PlanResult result = replanned(planned_at(kTime_s), kTime_s, slippery);
  CHECK(kept_knots(result.plan) < 2);
  CHECK(check(result.plan, slippery, result.plan.robot).ok() == (result.report.status == Status::solved));
}

TEST_CASE("a plan is cut where all feet stand and have stepped, with eight phases at least beyond") {
  Rest rest = rest_of(walk(), kTime_s);
  keep_tail(rest, walk(), walk().scene, walk().robot, ReplanOptions(), 3);
  REQUIRE(rest.tail);
  CHECK(rest.size() >= 3);
  CHECK(rest.plan.knots.size() == rest.plan.phases.size() + 1);
  CHECK(rest.plan.knots.back().com_W == rest.tail->knots.front().com_W);
  for (int e : {0, 1}) {
    CHECK(rest.plan.final_contacts[e] >= 0);
    CHECK(rest.tail->phases.front().contacts[e].surface == rest.plan.final_contacts[e]);
    bool stepped = false;
    for (const Phase& phase : rest.plan.phases) stepped = stepped || phase.contacts[e].surface < 0;
    CHECK(stepped);
  }
  Rest whole = rest_of(walk(), kTime_s);
  keep_tail(whole, walk(), walk().scene, walk().robot, ReplanOptions(), whole.size() - 7);
  CHECK(!whole.tail);
}

TEST_CASE("of an accepted plan what is kept is not looked at again, and the new plan is the same") {
  ReplanOptions options;
  options.horizon = kNew / 2;
  for (const double push_m_s : {0.0, 0.1}) {
    CAPTURE(push_m_s);
    Measured measured = planned_at(kTime_s);
    measured.state.com_velocity_W.y() += push_m_s;
    options.previous_accepted = false;
    const PlanResult in_full = ddp::replan(walk(), kTime_s, measured, options);
    options.previous_accepted = true;
    const PlanResult result = ddp::replan(walk(), kTime_s, measured, options);
    REQUIRE(result.report.status == Status::solved);
    CHECK(result.plan == in_full.plan);
    CHECK(result.report.kept_until_s == result.plan.duration());
    CHECK(in_full.report.checked_until_s == in_full.plan.duration());
    CHECK(result.report.checked_until_s < result.plan.duration());
    // Both feet have landed elsewhere by then, so that the headings of soles that are new are looked at.
    const int first = static_cast<int>(result.plan.knots.size()) - kept_knots(result.plan);
    for (int e : {0, 1}) {
      int k = first;
      while (result.plan.phases[k].contacts[e].surface >= 0) ++k;
      while (result.plan.phases[k].contacts[e].surface < 0) ++k;
      CHECK(result.report.checked_until_s > result.plan.knot_times()[k]);
    }
  }
}

TEST_CASE("on another scene or for another robot all of it is looked at, accepted before or not") {
  ReplanOptions options;
  options.horizon = kNew / 2;
  options.previous_accepted = true;
  Scene scene = walk().scene;
  scene.surfaces.push_back(scenes::rectangle("beside", 0.0, 3.0, 1.0, 1.2, 1.0));  // nothing that is touched
  Robot robot = walk().robot;
  robot.swing_height *= 1.01;
  for (const PlanResult& result : {ddp::replan(walk(), kTime_s, planned_at(kTime_s), scene, walk().robot, options),
                                   ddp::replan(walk(), kTime_s, planned_at(kTime_s), walk().scene, robot, options)}) {
    INFO(result.report.message);
    CHECK(kept_knots(result.plan) >= 8);
    CHECK(result.report.checked_until_s == result.plan.duration());
  }
}

TEST_CASE("where one switch a step is asked for, what may have more is looked at again") {
  // The plan before may have been accepted where that was not asked.
  Plan hopping = walk();
  const std::size_t last = hopping.phases.size() - 2;
  for (int e : {0, 1}) hopping.phases[last].contacts[e].surface = -1;
  ReplanOptions options;
  options.previous_accepted = true;
  for (const bool one : {true, false}) {
    options.search.one_switch_per_step = one;
    Rest rest = rest_of(hopping, kTime_s);
    keep_tail(rest, hopping, hopping.scene, hopping.robot, options, 3);
    REQUIRE(rest.tail);
    CHECK((rest.tail->unseen_from == static_cast<int>(rest.tail->phases.size())) == one);
  }
}
