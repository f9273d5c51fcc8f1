#include "ddp/replan/recovery.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "ddp/replan/under_feet.hpp"
#include "mcplan/ddp/plan.hpp"
#include "mcplan/ddp/replan.hpp"
#include "mcplan/mcplan.hpp"
#include "mcplan/plan/checker.hpp"
#include "scenes.hpp"

namespace {

using namespace mcplan;
using namespace mcplan::ddp;
using Eigen::Vector2d;
using Eigen::Vector3d;

const Plan& walk() {
  static const Plan plan = ddp::plan(scenes::flat(), scenes::humanoid44()).plan;
  return plan;
}

/// A swing of a foot in the middle of the walk.
struct Swinging {
  int foot = 0, other = 1;
  double lifts_s = 0.0, lands_s = 0.0;
  double at(double ratio) const { return lifts_s + ratio * (lands_s - lifts_s); }
};
Swinging swinging() {
  const std::vector<double> times = walk().knot_times();
  for (std::size_t k = walk().phases.size() / 2; k < walk().phases.size(); ++k)
    for (const int foot : {0, 1})
      if (walk().phases[k].contacts[foot].surface < 0) return {foot, 1 - foot, times[k], times[k + 1]};
  FAIL("there is a swing");
  return {};
}

Measured pushed_at(double t, const Vector3d& velocity) {
  Measured out;
  out.state = rest_of(walk(), t).plan.knots.front();
  out.state.com_velocity_W += velocity;
  return out;
}

/// To the side on which an end-effector is.
double side_of(int foot) { return walk().robot.end_effectors[foot].nominal_B.y() < 0.0 ? -1.0 : 1.0; }

/// What is tried at a time, with the CoM pushed to a side, of what is left of the walk or of its first phase alone.
std::vector<Recovery> tried(double t, double to_left_m_s, const ReplanOptions& options, bool first_phase_only = false) {
  const Deadline never;
  Now now{&walk().scene, &walk().robot, &options, &never, {}, {}, similarity_of(walk().robot, walk().scene.gravity)};
  Rest rest = rest_of(walk(), t);
  if (first_phase_only) {
    const ContactState landed = rest.contacts(1);
    rest.keep_first();
    rest.plan.final_contacts = landed;
    rest.plan.knots.shrink_to_fit();
  }
  rest.plan.knots.front().com_velocity_W.y() += to_left_m_s;
  return recoveries(rest, now);
}

/// Three steps in turn, each foot on its own side, and both stand at the end.
void steps_as_feet_do(const Rest& rest, const Swinging& swing) {
  CHECK(rest.free_end);
  CHECK(rest.size() < 12);
  CHECK(rest.surface(0, swing.foot) == kFree);
  int landed = 0;
  for (int k = 1; k <= rest.size(); ++k) {
    int changes = 0;
    for (const int e : {0, 1}) {
      changes += rest.surface(k, e) != rest.surface(k - 1, e);
      if (rest.surface(k, e) == kFree || rest.surface(k - 1, e) != kFree) continue;
      ++landed;
      const Knot& knot = rest.plan.knots[k];
      const Vector3d apart = knot.end_effectors_W[e] - knot.end_effectors_W[1 - e];
      CHECK(side_of(e) * apart.y() > 0.0);
    }
    CHECK(changes <= 1);
  }
  CHECK(landed == 3);
  for (const int e : {0, 1}) CHECK(rest.surface(rest.size(), e) != kFree);
}

}  // namespace

TEST_CASE(
    "steps that catch a push: one contact changes at a time, each foot on its own side, and both stand at the end") {
  const Swinging swing = swinging();
  for (const double ratio : {0.3, 0.6}) {
    for (const double push : {-0.5, 0.5}) {
      CAPTURE(ratio);
      CAPTURE(push);
      const std::vector<Recovery> found = tried(swing.at(ratio), push, {});
      REQUIRE(!found.empty());
      for (const Recovery& recovery : found) steps_as_feet_do(recovery.rest, swing);
    }
  }
  // From both feet either of them steps first; in the air nothing can be done.
  CHECK(tried(0.0, 0.5, {}).size() == 2);
}

TEST_CASE("a foot that is due to land short of the capture point may take the time to get there") {
  const Swinging swing = swinging();
  const std::vector<Recovery> near = tried(swing.at(0.8), 0.0, {});
  CHECK(near.size() == 1);
  const std::vector<Recovery> found = tried(swing.at(0.8), side_of(swing.foot) * 0.9, {});
  REQUIRE(found.size() == 2);
  const Rest &due = found[0].rest, &later = found[1].rest;
  CHECK(later.plan.phases.front().duration > due.plan.phases.front().duration + 0.05);
  const auto out_m = [&](const Rest& rest) {
    const Knot& landed = rest.plan.knots[1];
    return side_of(swing.foot) * (landed.end_effectors_W[swing.foot] - landed.end_effectors_W[swing.other]).y();
  };
  CHECK(out_m(later) > out_m(due) + 0.05);
}

TEST_CASE("with both feet on the ground the step that is due comes first and is not put off, the other one later") {
  const Swinging swing = swinging();
  for (const double left_s : {0.03, 0.06}) {
    CAPTURE(left_s);
    const std::vector<Recovery> found = tried(swing.lifts_s - left_s, 0.4, {});
    REQUIRE(found.size() == 2);
    const Rest &due = found.front().rest, &late = found.back().rest;
    for (const int e : {0, 1}) CHECK(due.surface(0, e) != kFree);
    CHECK(due.surface(1, swing.foot) == kFree);
    CHECK(due.surface(1, swing.other) != kFree);
    CHECK(due.plan.phases.front().duration == doctest::Approx(left_s).epsilon(1e-6));
    CHECK(late.surface(1, swing.other) == kFree);
    CHECK(late.plan.phases.front().duration > 0.1);
  }
}

TEST_CASE("a hard push is answered by a plan that the checker accepts, steps to a stand among them") {
  const Swinging swing = swinging();
  int caught = 0;
  for (const double ratio : {0.2, 0.5, 0.8}) {
    for (const double push : {0.4, 0.5}) {
      CAPTURE(ratio);
      CAPTURE(push);
      const double t = swing.at(ratio);
      const Measured measured = pushed_at(t, {0.0, side_of(swing.foot) * push, 0.0});
      const PlanResult result = ddp::replan(walk(), t, measured);
      INFO(result.report.message);
      CHECK(result.report.status == Status::solved);
      CHECK(check(result.plan, result.plan.scene, result.plan.robot).ok());
      CHECK((result.plan.at(0.0).com_velocity_W - measured.state.com_velocity_W).norm() < 1e-9);
      if (result.report.plan_from != PlanFrom::recovery) continue;
      ++caught;
      const Knot& end = result.plan.knots.back();
      CHECK(end.com_velocity_W.norm() < 0.01);
      CHECK(result.plan.robot.end_effectors[0].reach_max_B == walk().robot.end_effectors[0].reach_max_B);  // as given
      CHECK((end.com_W - result.plan.scene.goal.position_W).head<2>().norm() < 1e-9);
      for (const int e : {0, 1}) CHECK(result.plan.final_contacts[e] >= 0);
    }
  }
  CHECK(caught > 0);
}

TEST_CASE("however hard the push, the guess stays where legs reach") {
  const Swinging swing = swinging();
  const double height_m = walk().robot.com_height;
  for (const double t : {swing.lifts_s - 0.05, swing.at(0.3), swing.at(0.7)})
    for (const double push : {-1.5, -0.6, 0.6, 1.5}) {
      CAPTURE(t);
      CAPTURE(push);
      const std::vector<Recovery> found = tried(t, push, {});
      REQUIRE(!found.empty());
      for (const Recovery& recovery : found)
        for (const Knot& knot : recovery.rest.plan.knots) {
          const auto away_m = [&](int e) { return (knot.com_W - knot.end_effectors_W[e]).head<2>().norm(); };
          CHECK(std::min(away_m(0), away_m(1)) < height_m);
        }
    }
}

TEST_CASE("steps that catch a push are made to their end before the robot looks for its way again") {
  const Swinging swing = swinging();
  const Measured measured = pushed_at(swing.at(0.5), {0.0, side_of(swing.foot) * 0.5, 0.0});
  ReplanOptions options;
  options.recovery_first = true;
  const Plan caught = ddp::replan(walk(), swing.at(0.5), measured, options).plan;
  const Deadline never;
  const Now now{
      &walk().scene, &walk().robot, &options, &never, {}, {}, similarity_of(walk().robot, walk().scene.gravity)};
  CHECK(!recovery_under_way(rest_of(walk(), swing.at(0.5)), now));  // a walk, whose phases are not quick
  const Rest rest = rest_of(caught, 0.03);
  const std::optional<Recovery> found = recovery_under_way(rest, now);
  REQUIRE(found);
  CHECK(found->rest.catches_push());
  for (int k = 0; k <= rest.size(); ++k) CHECK(found->rest.contacts(k) == rest.contacts(k));

  Measured later;
  later.state = rest.plan.knots.front();
  const PlanResult on = ddp::replan(caught, 0.03, later, walk().scene, walk().robot, options);
  INFO(on.report.message);
  CHECK(on.report.status == Status::solved);
  CHECK(on.report.plan_from == PlanFrom::recovery);
  REQUIRE(on.plan.phases.size() == static_cast<std::size_t>(rest.size()));
  for (int k = 0; k < rest.size(); ++k)
    for (const int e : {0, 1}) CHECK(on.plan.phases[k].contacts[e].surface == rest.surface(k, e));
  CHECK((on.plan.knots.back().com_W - caught.knots.back().com_W).norm() < 0.02);
}

TEST_CASE("pushed outward over the foot that stands, the other one may step across it, soles one behind the other") {
  const Swinging swing = swinging();
  const double outward = side_of(swing.other), t = swing.at(0.25);
  ReplanOptions options;
  const auto across = [](const Recovery& recovery) { return recovery.rest.across.has_value(); };
  const auto any_across = [&](const std::vector<Recovery>& of) { return std::any_of(of.begin(), of.end(), across); };
  CHECK(!any_across(tried(t, outward * 0.6, options)));
  options.crossing = true;
  CHECK(!any_across(tried(t, -outward * 0.6, options)));  // the other side needs no such step
  const std::vector<Recovery> found = tried(t, outward * 0.6, options);
  REQUIRE(found.size() == 3);
  for (const Recovery& recovery : {found[1], found[2]}) {
    REQUIRE(recovery.rest.across);
    const Rest::Across& across = *recovery.rest.across;
    const Knot& landing = recovery.rest.plan.knots[across.knot];
    const Vector3d apart = landing.end_effectors_W[swing.foot] - landing.end_effectors_W[swing.other];
    CHECK(outward * apart.y() > 0.0);
    const auto half_length = [&](int e) { return recovery.robot.end_effectors[e].half_size.x(); };
    CHECK(across.axis_W.dot(apart.head<2>()) > half_length(swing.foot) + half_length(swing.other));
    if (across.via_knot < 0) continue;
    const Vector3d via = across.via_W - landing.end_effectors_W[swing.other];
    CHECK(outward * via.y() < 0.0);  // still on its own side
    CHECK(across.axis_W.dot(via.head<2>()) > half_length(swing.foot) + half_length(swing.other));
  }
  CHECK((found[1].rest.across->axis_W + found[2].rest.across->axis_W).norm() < 1e-12);  // behind it and in front of it
}

TEST_CASE("steps across are the same where the plan ends with the swing under way") {
  const Swinging swing = swinging();
  const double outward = side_of(swing.other), t = swing.at(0.25);
  ReplanOptions options;
  options.crossing = true;
  const std::vector<Recovery> all = tried(t, outward * 0.6, options), last = tried(t, outward * 0.6, options, true);
  REQUIRE(last.size() == all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    REQUIRE(last[i].rest.size() == all[i].rest.size());
    for (std::size_t k = 0; k < all[i].rest.plan.knots.size(); ++k)
      for (const int foot : {swing.foot, swing.other})
        CHECK(last[i].rest.plan.knots[k].end_effectors_W[foot] == all[i].rest.plan.knots[k].end_effectors_W[foot]);
  }
}
