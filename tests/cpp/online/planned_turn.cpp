#include "mcplan/online/planned_turn.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "mcplan/ddp/plan.hpp"
#include "scenes.hpp"

using namespace mcplan;
using namespace mcplan::online;
using Eigen::Vector3d;

namespace {

constexpr double kTime_s = 1.3;

const Plan& walk() {
  static const Plan plan = ddp::plan(scenes::flat(), scenes::humanoid44()).plan;
  return plan;
}

/// The planned state at t, turning otherwise.
Knot turning(double t, const Vector3d& rate_off, const Vector3d& momentum_off_W) {
  const PlanState state = walk().at(t);
  Knot out;
  out.com_W = state.com_W;
  out.com_velocity_W = state.com_velocity_W;
  out.base_rpy = state.base_rpy;
  out.base_rpy_rate = state.base_rpy_rate + rate_off;
  out.angular_momentum_W = state.angular_momentum_W + momentum_off_W;
  return out;
}

}  // namespace

TEST_CASE("what a landing turns the base by is left to the controller") {
  const Vector3d off = Vector3d(0.5, -0.7, 0.2).normalized() * 0.99 * kTurnMargin_rad_s;
  const Knot begin = with_planned_turn(turning(kTime_s, off, {0.4, 0.2, -0.1}), walk(), kTime_s);
  const PlanState planned = walk().at(kTime_s);
  CHECK(begin.base_rpy_rate == planned.base_rpy_rate);
  CHECK(begin.angular_momentum_W == planned.angular_momentum_W);
  CHECK(begin.base_rpy == planned.base_rpy);
  CHECK(begin.com_velocity_W == planned.com_velocity_W);
}

TEST_CASE("of a base that turns faster the margin alone is left out, whichever way it turns") {
  const Vector3d off(0.8, -1.1, 0.3), momentum_off_W(5.0, -3.0, 0.5);
  const Knot begin = with_planned_turn(turning(kTime_s, off, momentum_off_W), walk(), kTime_s);
  const PlanState planned = walk().at(kTime_s);
  const Vector3d left = begin.base_rpy_rate - planned.base_rpy_rate;
  CHECK(left.norm() == doctest::Approx(off.norm() - kTurnMargin_rad_s));
  CHECK(left.normalized().dot(off.normalized()) == doctest::Approx(1.0));
  const double ratio = left.norm() / off.norm();
  CHECK((begin.angular_momentum_W - planned.angular_momentum_W - ratio * momentum_off_W).norm() < 1e-12);
}

TEST_CASE("a momentum of zero, which stands for that of the rates, stays zero, and no margin begins as measured") {
  Knot measured = turning(kTime_s, {0.1, 0.0, 0.0}, Vector3d::Zero());
  measured.angular_momentum_W.setZero();
  CHECK(with_planned_turn(measured, walk(), kTime_s).angular_momentum_W == Vector3d::Zero());
  const Knot begin = with_planned_turn(measured, walk(), kTime_s, 0.0);
  CHECK((begin.base_rpy_rate - measured.base_rpy_rate).norm() < 1e-15);
  measured.base_rpy_rate.x() = NAN;
  CHECK(std::isnan(with_planned_turn(measured, walk(), kTime_s).base_rpy_rate.x()));
}

TEST_CASE("after its plan the base is to stand still") {
  const double end_s = walk().duration();
  Knot measured = turning(end_s, Vector3d::Zero(), Vector3d::Zero());
  measured.base_rpy_rate = {0.1, 0.1, 0.1};
  measured.angular_momentum_W = {0.2, 0.1, 0.0};
  const Knot begin = with_planned_turn(measured, walk(), end_s + 0.7);
  CHECK(begin.base_rpy_rate == Vector3d::Zero());
  CHECK(begin.angular_momentum_W == Vector3d::Zero());
}

TEST_CASE("what pushes a robot turns it as well: a base that was pushed turns as it does") {
  Knot measured = turning(kTime_s, {0.1, -0.1, 0.0}, {0.3, 0.0, 0.1});
  measured.com_velocity_W.y() += 0.1;
  const Knot begin = with_planned_turn(measured, walk(), kTime_s);
  CHECK(begin.base_rpy_rate == measured.base_rpy_rate);
  CHECK(begin.angular_momentum_W == measured.angular_momentum_W);
}

TEST_CASE("in flight the base turns as it does") {
  Plan jump = walk();
  int k = 0;
  while (jump.knot_times()[k + 1] < kTime_s) ++k;
  for (Contact& contact : jump.phases[k].contacts) contact = {};
  const Knot measured = turning(kTime_s, {0.1, -0.1, 0.0}, {0.3, 0.0, 0.1});
  const Knot begin = with_planned_turn(measured, jump, kTime_s);
  CHECK(begin.base_rpy_rate == measured.base_rpy_rate);
  CHECK(begin.angular_momentum_W == measured.angular_momentum_W);
}
