#include <doctest/doctest.h>

#include <cmath>

#include "mcplan/base/error.hpp"
#include "plan/clearance.hpp"
#include "plan/fixtures.hpp"
#include "plan/plan_shape.hpp"
#include "plan/swings.hpp"

using namespace fixtures;
using mcplan::EndEffectorState;
using mcplan::Plan;
using mcplan::Swing;

namespace {

constexpr int kSwing = 3;  // phase of the left foot's first swing, and its index in plan.knots

/// What is left of the walk at `since` [s] in its first swing, from the state there.
Plan rest_of_swing(const Plan& plan, double since) {
  const mcplan::PlanState now = plan.at_phase(kSwing, since);
  Plan rest = plan;
  rest.phases.erase(rest.phases.begin(), rest.phases.begin() + kSwing);
  rest.knots.erase(rest.knots.begin(), rest.knots.begin() + kSwing);
  rest.phases.front().duration -= since;
  mcplan::Knot& knot = rest.knots.front();
  knot.com_W = now.com_W;
  knot.com_velocity_W = now.com_velocity_W;
  knot.base_rpy = now.base_rpy;
  knot.base_rpy_rate = now.base_rpy_rate;
  for (int e = 0; e < plan.end_effector_count(); ++e) {
    knot.end_effectors_W[e] = now.end_effectors[e].position_W;
    knot.end_effector_velocities_W[e] = now.end_effectors[e].velocity_W;
  }
  rest.measured_start = true;
  mcplan::choose_swings(rest, true, swings_under_way(plan, kSwing * kPhase + since));
  return rest;
}

const Swing& of(const Plan& plan, int end_effector) {
  for (const Swing& swing : plan.swings)
    if (swing.end_effector == end_effector) return swing;
  throw mcplan::InvalidPlan("swings", "must have one of the end-effector", "none");
}

/// The walk with a first step on the spot, so that its way is the lift alone, without limits of reach.
Plan step_on_the_spot() {
  Plan plan = walk();
  plan.scene.surfaces[block].vertices_W = plan.scene.surfaces[patch].vertices_W;
  plan.robot.end_effectors[left_foot].reach_min_B.setConstant(-9.0);
  plan.robot.end_effectors[left_foot].reach_max_B.setConstant(9.0);
  plan.knots[kSwing + 1].end_effectors_W[left_foot] = plan.knots[kSwing].end_effectors_W[left_foot];
  return plan;
}

}  // namespace

TEST_CASE("a swing that is under way goes on as it was, again and again") {
  const Plan plan = step_on_the_spot();
  for (const double since : {0.004, 0.1, 0.2, 0.37}) {
    CAPTURE(since);
    const Plan rest = rest_of_swing(plan, since);
    CHECK(of(rest, left_foot).elapsed_s == doctest::Approx(since));
    CHECK(of(rest, left_foot).height == of(plan, left_foot).height);
    const Plan again = [&] {
      Plan shifted = rest;  // as long before its swing as the walk is
      shifted.knots.insert(shifted.knots.begin(), kSwing, rest.knots.front());
      shifted.phases.insert(shifted.phases.begin(), plan.phases.begin(), plan.phases.begin() + kSwing);
      for (Swing& swing : shifted.swings) swing.first_phase += kSwing, swing.end_phase += kSwing;
      return rest_of_swing(shifted, 0.02);
    }();
    CHECK(of(again, left_foot).elapsed_s == doctest::Approx(since + 0.02));
    for (double t = 0.0; t < kPhase - since; t += 0.004) {
      const EndEffectorState planned = plan.at_phase(kSwing, since + t).end_effectors[left_foot];
      const EndEffectorState on = rest.at_phase(0, t).end_effectors[left_foot];
      CHECK((on.position_W - planned.position_W).norm() < 1e-14);
      CHECK((on.velocity_W - planned.velocity_W).norm() < 1e-12);
      if (t < 0.02 || again.phases.front().duration < t - 0.02) continue;
      const EndEffectorState later = again.at_phase(0, t - 0.02).end_effectors[left_foot];
      CHECK((later.position_W - planned.position_W).norm() < 1e-14);
    }
  }
}

TEST_CASE("the path of a swing that is under way begins at its knot, with that velocity and its own acceleration") {
  const Plan plan = walk();
  for (const double since : {0.05, 0.2, 0.3}) {
    CAPTURE(since);
    Plan rest = rest_of_swing(plan, since);
    rest.knots.front().end_effectors_W[left_foot] += Vector3d(0.004, -0.003, 0.006);  // pushed off its way
    rest.knots.front().end_effector_velocities_W[left_foot] += Vector3d(0.1, 0.05, -0.2);
    rest.phases.front().duration *= 1.1;  // and later
    const EndEffectorState begin = rest.at_phase(0, 0.0).end_effectors[left_foot];
    CHECK((begin.position_W - rest.knots[0].end_effectors_W[left_foot]).norm() < 1e-14);
    CHECK((begin.velocity_W - rest.knots[0].end_effector_velocities_W[left_foot]).norm() < 1e-12);
    const EndEffectorState end = rest.at_phase(0, rest.phases.front().duration).end_effectors[left_foot];
    CHECK((end.position_W - rest.knots[1].end_effectors_W[left_foot]).norm() < 1e-14);
    CHECK(end.velocity_W.norm() < 1e-12);
    const double h = 1e-6;
    for (double t = 0.01; t < rest.phases.front().duration - h; t += 0.013) {
      const auto at = [&](double tau) { return rest.at_phase(0, tau).end_effectors[left_foot]; };
      const Vector3d difference = (at(t + h).position_W - at(t - h).position_W) / (2.0 * h);
      CHECK((difference - at(t).velocity_W).norm() < 1e-7);
    }
  }
}

TEST_CASE("a swing under way that is cut out of a plan is looked at like the whole of it, at the same instants") {
  Plan plan = step_on_the_spot();
  const auto solids = mcplan::solids_of(plan.scene);
  const mcplan::FreeStretch whole = mcplan::free_stretches(plan, solids, left_foot)[0];
  const mcplan::EndEffector& foot = plan.robot.end_effectors[left_foot];
  // A table whose edge the sole overhangs: its corners are inside, where they count.
  const std::vector<mcplan::Solid> table = {
      {mcplan::Polygon({{0, 0, 0.5}, {1, 0, 0.5}, {1, 2, 0.5}, {0, 2, 0.5}}), 0.1}};
  const Vector3d beside(1.02, 1.0, 0.48);
  for (const double since : {0.02, 0.1, 0.2, 0.37}) {
    CAPTURE(since);
    const Plan rest = rest_of_swing(plan, since);
    const mcplan::FreeStretch cut = mcplan::free_stretches(rest, solids, left_foot)[0];
    CHECK(cut.lift_normal_W == whole.lift_normal_W);
    for (double t = since; t < kPhase; t += 0.007) {
      CHECK(cut.ratio(t - since) == doctest::Approx(whole.ratio(t)));
      CHECK(clearance_depth(table, foot, cut, cut.ratio(t - since), beside, 0.0) ==
            clearance_depth(table, foot, whole, whole.ratio(t), beside, 0.0));
    }
  }
}

TEST_CASE("a plan that claims to swing for ages leaves no more of its end unlooked at than a longest phase does") {
  Plan rest = rest_of_swing(step_on_the_spot(), 0.2);
  const auto solids = mcplan::solids_of(rest.scene);
  rest.robot.phase_duration = {0.15, 0.5};
  for (Swing& swing : rest.swings)
    if (swing.end_effector == left_foot) swing.elapsed_s = 1e6;
  const mcplan::FreeStretch stretch = mcplan::free_stretches(rest, solids, left_foot)[0];
  const double left = kPhase - 0.2;
  CHECK(stretch.duration_s == doctest::Approx(left));
  CHECK(stretch.ratio(left - 0.1 * (left + 0.5)) == doctest::Approx(0.9));
  CHECK(stretch.ratio(0.0) > 0.1);
}

TEST_CASE("a swing under way that would not clear the scene is lifted anew") {
  Plan plan = walk();
  plan.swings[0].height = 0.001;  // over a block of 0.02 m
  const Plan rest = rest_of_swing(plan, 0.02);
  CHECK(of(rest, left_foot).elapsed_s == 0.0);
  CHECK(of(rest, left_foot).height > 0.005);
}

TEST_CASE("swings under way are those that began last, whether they have ended or not") {
  const Plan plan = walk();
  CHECK(swings_under_way(plan, 0.0).empty());
  for (const auto& [t, elapsed_s] : {std::pair{1.3, 0.1}, std::pair{1.7, 0.5}}) {  // in the air, and landed
    const std::vector<Swing> found = swings_under_way(plan, t);
    const auto foot =
        std::find_if(found.begin(), found.end(), [](const Swing& s) { return s.end_effector == left_foot; });
    REQUIRE(foot != found.end());
    CHECK(foot->elapsed_s == doctest::Approx(elapsed_s));
    CHECK(foot->first_phase == kSwing);
  }
}

TEST_CASE("the time since lift-off is refused where the swing begins in the plan, or is no time") {
  for (const auto& [first_phase, elapsed_s] : {std::pair{3, 0.1}, std::pair{0, -0.1}, std::pair{0, HUGE_VAL}}) {
    Plan plan = walk();
    plan.swings[0].first_phase = first_phase;
    plan.swings[0].elapsed_s = elapsed_s;
    CHECK_THROWS_AS(plan.validate(), mcplan::InvalidPlan);
  }
  Plan plan = walk();
  plan.swings[0].first_phase = 0;
  plan.swings[0].elapsed_s = 0.1;
  CHECK_NOTHROW(plan.validate());
}

TEST_CASE("soles are tilted as what they stand on, and on the way from there to what they land on") {
  Plan plan = walk();
  for (Vector3d& v : plan.scene.surfaces[patch].vertices_W) v.z() += 0.2 * v.x();
  for (Vector3d& v : plan.scene.surfaces[ground].vertices_W) v.z() -= 0.1 * v.x();
  const auto normal = [&](int k) {
    const int surface = plan.phases[k].contacts[left_foot].surface;
    return mcplan::Polygon(plan.scene.surfaces[surface].vertices_W).normal_W();
  };
  const auto at = [&](double t) { return mcplan::sole_normals(plan, t)[left_foot]; };
  CHECK((at((kSwing - 0.5) * kPhase) - normal(kSwing - 1)).norm() < 1e-12);
  CHECK((at((kSwing + 1.5) * kPhase) - normal(kSwing + 1)).norm() < 1e-12);
  for (const double s : {0.2, 0.5, 0.9}) {
    const Vector3d between = (1.0 - s) * normal(kSwing - 1) + s * normal(kSwing + 1);
    CHECK((at((kSwing + s) * kPhase) - between.normalized()).norm() < 1e-9);
  }
  CHECK((mcplan::sole_normals(plan, plan.duration())[left_foot] -
         mcplan::Polygon(plan.scene.surfaces[plan.final_contacts[left_foot]].vertices_W).normal_W())
            .norm() < 1e-12);
}

TEST_CASE("a sole that lies on a slope and bears nothing yet is no level one in the slope") {
  Plan plan = rest_of_swing(step_on_the_spot(), 0.37);
  const Vector3d tilted = Vector3d(-0.2, 0.0, 1.0).normalized();
  mcplan::choose_swings(plan, true, {}, std::vector<Vector3d>(plan.end_effector_count(), tilted));
  CHECK((of(plan, left_foot).lift_normal_W - tilted).norm() < 1e-15);
  CHECK(of(plan, left_foot).elapsed_s == 0.0);
  const auto solids = mcplan::solids_of(plan.scene);
  CHECK((mcplan::free_stretches(plan, solids, left_foot)[0].lift_normal_W - tilted).norm() < 1e-12);
  mcplan::choose_swings(plan, true, {});
  CHECK(mcplan::free_stretches(plan, solids, left_foot)[0].lift_normal_W == Vector3d(Vector3d::UnitZ()));
}
