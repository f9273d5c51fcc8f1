#include "ddp/replan/rest.hpp"

#include <doctest/doctest.h>

#include "ddp/constants.hpp"
#include "mcplan/base/rotation.hpp"
#include "mcplan/ddp/plan.hpp"
#include "scenes.hpp"

namespace {

using namespace mcplan;
using namespace mcplan::ddp;
using Eigen::Vector3d;

const Plan& walk() {
  static const Plan plan = ddp::plan(scenes::flat(), scenes::humanoid44()).plan;
  return plan;
}

Similarity human() { return similarity_of(walk().robot, walk().scene.gravity); }

/// The planned state as if measured.
Measured planned_at(double t) {
  Measured out;
  out.state = rest_of(walk(), t).plan.knots.front();
  for (const EndEffectorState& end : walk().at(t).end_effectors) out.contacts.push_back(end.surface);
  return out;
}

/// Index of a phase after the first steps that follows one in which the end-effector was, or was not, in contact.
int switch_after(int e, bool touchdown) {
  const auto sequence = walk().contact_sequence();
  for (int k = 4; k < static_cast<int>(sequence.size()); ++k)
    if ((sequence[k - 1][e] < 0 && sequence[k][e] >= 0) == touchdown && sequence[k - 1][e] != sequence[k][e]) return k;
  FAIL("no such switch");
  return 0;
}

}  // namespace

TEST_CASE("the rest of a plan moves as the plan does") {
  for (const double t : {0.0, 0.4, 1.3, 2.9}) {
    CAPTURE(t);
    const Rest rest = rest_of(walk(), t);
    CHECK(rest.plan.duration() == doctest::Approx(walk().duration() - t).epsilon(1e-12));
    Plan plan = rest.plan;
    for (const double later : {0.0, 0.01, 0.3, 1.0}) {
      const PlanState there = plan.at(later), here = walk().at(t + later);
      CHECK((there.com_W - here.com_W).norm() < 1e-9);
      CHECK((there.com_velocity_W - here.com_velocity_W).norm() < 1e-9);
      CHECK((there.angular_momentum_W - here.angular_momentum_W).norm() < 1e-9);
    }
  }
}

TEST_CASE("hands in the air are carried by the base: they stay where they are to it, and those that hold stay put") {
  const Robot& robot = walk().robot;
  Rest rest = rest_of(walk(), 1.0);
  rest.plan.phases.front().contacts[2].surface = 0;
  rest.plan.knots.front().base_rpy = {0.02, -0.05, 0.4};
  const Plan before = rest.plan;
  rest.carry_hands(robot);
  const auto seen_from_base = [](const Knot& knot, int e) {
    return Vector3d(rotation_from_rpy(knot.base_rpy).transpose() * (knot.end_effectors_W[e] - knot.com_W));
  };
  for (int k = 1; k <= rest.size(); ++k) {
    const Knot& knot = rest.plan.knots[k];
    for (int e : {0, 1, 2}) CHECK(knot.end_effectors_W[e] == before.knots[k].end_effectors_W[e]);
    CHECK((seen_from_base(knot, 3) - seen_from_base(rest.plan.knots.front(), 3)).norm() < 1e-12);
  }
}

TEST_CASE("the rest is quick where phases ahead of the one under way are shorter than the robot's") {
  Plan quick = walk();
  CHECK(!rest_of(quick, 1.0).quick);
  quick.phases[4].duration = 0.6 * phase_duration_of(quick.robot, human())[0];
  const std::vector<double> times = quick.knot_times();
  CHECK(rest_of(quick, times[3]).quick);
  CHECK(!rest_of(quick, times[4]).quick);
  CHECK(!rest_of(quick, quick.duration()).quick);
}

TEST_CASE("what is desired goes with the phases that are put in, dropped or left alone") {
  Rest rest = rest_of(walk(), 1.0);
  rest.desired = rest.plan.knots;
  for (Knot& knot : rest.desired) knot.com_W.x() += 1.0;
  const auto goes_along = [&] {
    REQUIRE(rest.desired.size() == rest.plan.knots.size());
    for (std::size_t k = 1; k < rest.desired.size(); ++k)
      CHECK((rest.desired[k].com_W - rest.plan.knots[k].com_W).isApprox(Vector3d::UnitX(), 1e-12));
  };
  for (const int k : {0, 3, rest.size()}) {
    rest.insert(k, rest.contacts(k), 0.3);
    goes_along();
  }
  rest.drop(2);
  goes_along();
  rest.keep_first();
  CHECK(rest.desired.empty());
  CHECK(rest.size() == 1);
  CHECK(rest.plan.knots.size() == 2);
  rest.insert(1, rest.contacts(1), 0.3);
  CHECK(rest.desired.empty());
}

TEST_CASE("with the planned contacts the rest stays as it is, from the measured state on") {
  Measured measured = planned_at(1.0);
  measured.state.com_W += Vector3d(0.01, 0.0, 0.0);
  Rest rest = rest_of(walk(), 1.0);
  const Rest before = rest;
  REQUIRE(begin_with(rest, measured, measured.contacts, past_of(walk(), 1.0), human()));
  CHECK(rest.size() == before.size());
  CHECK(rest.plan.knots.front().com_W == measured.state.com_W);
  CHECK(rest.plan.knots[1].com_W == before.plan.knots[1].com_W);
}

TEST_CASE("a contact that is early begins its phase, one that is late gets a short one before it") {
  for (const bool touchdown : {true, false})
    for (int e : {0, 1}) {
      CAPTURE(touchdown);
      CAPTURE(e);
      const int k = switch_after(e, touchdown);
      const double at = walk().knot_times()[k];
      const auto sequence = walk().contact_sequence();
      Rest early = rest_of(walk(), at - 0.03);
      Measured measured = planned_at(at - 0.03);
      REQUIRE(begin_with(early, measured, sequence[k], past_of(walk(), at - 0.03), human()));
      CHECK(early.contacts(0) == sequence[k]);
      CHECK(early.size() == static_cast<int>(sequence.size()) - k);
      Rest late = rest_of(walk(), at + 0.03);
      measured = planned_at(at + 0.03);
      REQUIRE(begin_with(late, measured, sequence[k - 1], past_of(walk(), at + 0.03), human()));
      CHECK(late.contacts(0) == sequence[k - 1]);
      CHECK(late.contacts(1) == sequence[k]);
      CHECK(late.size() == static_cast<int>(sequence.size()) - k + 1);
      CHECK(late.plan.phases.front().duration <= kLateMax_s);
      CHECK(late.planned.front() == 0);
    }
}

TEST_CASE("other contacts are led over by single changes, making before breaking") {
  Rest rest = rest_of(walk(), 0.0);
  const ContactState none(4, kFree), both = rest.contacts(0);
  Measured measured = planned_at(0.0);
  REQUIRE(begin_with(rest, measured, none, {}, human()));
  CHECK(rest.contacts(0) == none);
  int changes = 0;
  for (std::size_t e = 0; e < both.size(); ++e) changes += rest.contacts(1)[e] != none[e];
  CHECK(changes == 1);
  CHECK(rest.contacts(2) == both);
}

TEST_CASE("a foot that is measured on another surface stands there until it lifts off") {
  const int k = switch_after(0, true);
  const double t = walk().knot_times()[k] + 0.01;
  Rest rest = rest_of(walk(), t);
  rest.plan.scene.surfaces.push_back(rest.plan.scene.surfaces.front());
  rest.plan.scene.surfaces.back().name = "other";
  ContactState contacts = rest.contacts(0);
  contacts[0] = 1;
  REQUIRE(begin_with(rest, planned_at(t), contacts, {}, human()));
  int j = 0;
  for (; rest.surface(j, 0) != kFree; ++j) CHECK(rest.surface(j, 0) == 1);
  for (; j <= rest.size(); ++j) CHECK(rest.surface(j, 0) != 1);
}

TEST_CASE("at the end the robot stands for as many phases as asked for") {
  const double t = walk().duration() - 0.1;
  Rest rest = rest_of(walk(), t);
  stand_on(rest, 5, human());
  CHECK(rest.size() == 5);
  for (int k = 1; k <= 5; ++k) CHECK(rest.contacts(k) == rest.contacts(5));
  double stiffness = 0.0;
  for (const Contact& contact : rest.plan.phases.back().contacts) stiffness += contact.stiffness;
  CHECK(stiffness == doctest::Approx(walk().scene.gravity / walk().robot.com_height));
}
