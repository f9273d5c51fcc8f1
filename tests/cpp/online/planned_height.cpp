#include "mcplan/online/planned_height.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "mcplan/ddp/plan.hpp"
#include "scenes.hpp"

using namespace mcplan;
using namespace mcplan::online;
using Eigen::Vector3d;

namespace {

const Plan& walk() {
  static const Plan plan = ddp::plan(scenes::flat(), scenes::humanoid44()).plan;
  return plan;
}

/// The planned state at t, the CoM and its velocity off it.
Knot off_by(double t, const Vector3d& com_m, const Vector3d& velocity_m_s) {
  const PlanState state = walk().at(t);
  Knot out;
  out.com_W = state.com_W + com_m;
  out.com_velocity_W = state.com_velocity_W + velocity_m_s;
  out.base_rpy = state.base_rpy;
  out.base_rpy_rate = state.base_rpy_rate;
  for (const EndEffectorState& end : state.end_effectors) out.end_effectors_W.push_back(end.position_W);
  return out;
}

constexpr double kTime_s = 1.3;

}  // namespace

TEST_CASE("a robot that hangs a little lower than planned goes on from the planned height, and else from where it is") {
  const Knot measured = off_by(kTime_s, {0.01, -0.05, -0.015}, {0.02, 0.3, -0.03});
  const Knot begin = with_planned_height(measured, walk(), kTime_s);
  const PlanState planned = walk().at(kTime_s);
  CHECK(begin.com_W.z() == planned.com_W.z());
  CHECK(begin.com_velocity_W.z() == planned.com_velocity_W.z());
  CHECK(begin.com_W.head<2>() == measured.com_W.head<2>());
  CHECK(begin.com_velocity_W.head<2>() == measured.com_velocity_W.head<2>());
  CHECK(begin.base_rpy == measured.base_rpy);
}

TEST_CASE("a robot that has left the planned height goes on from where it is") {
  const double swing_s = std::sqrt(walk().robot.com_height / walk().scene.gravity);
  Vector3d com_m = Vector3d::Zero(), velocity_m_s = Vector3d::Zero();
  SUBCASE("lower") { com_m.z() = -1.01 * kHeightMargin_m; }
  SUBCASE("lower, on its way back") {
    com_m.z() = -1.01 * kHeightMargin_m;
    velocity_m_s.z() = kHeightMargin_m / swing_s;
  }
  SUBCASE("falling") { velocity_m_s.z() = -1.01 * kHeightMargin_m / swing_s; }
  const Knot measured = off_by(kTime_s, com_m, velocity_m_s);
  const Knot begin = with_planned_height(measured, walk(), kTime_s);
  CHECK(begin.com_W == measured.com_W);
  CHECK(begin.com_velocity_W == measured.com_velocity_W);
}

TEST_CASE("a margin of zero begins where the robot is, and what is no number is left to the planner") {
  const Knot measured = off_by(kTime_s, {0.0, 0.0, 1e-4}, Vector3d::Zero());
  CHECK(with_planned_height(measured, walk(), kTime_s, 0.0).com_W == measured.com_W);
  const Knot nowhere = off_by(kTime_s, {0.0, 0.0, NAN}, Vector3d::Zero());
  CHECK(std::isnan(with_planned_height(nowhere, walk(), kTime_s).com_W.z()));
}

TEST_CASE("after its plan the robot is to keep the height at which it ended") {
  const double end_s = walk().duration();
  const Knot begin = with_planned_height(off_by(end_s, {0.0, 0.0, -0.01}, {0.0, 0.0, -0.02}), walk(), end_s + 0.7);
  CHECK(begin.com_W.z() == walk().at(end_s).com_W.z());
  CHECK(begin.com_velocity_W.z() == 0.0);
}

TEST_CASE("in flight the robot goes on from where it is") {
  Plan jump = walk();
  int k = 0;
  while (jump.knot_times()[k + 1] < kTime_s) ++k;
  for (Contact& contact : jump.phases[k].contacts) contact = {};
  const Knot measured = off_by(kTime_s, {0.0, 0.0, 0.01}, {0.0, 0.0, -0.02});
  const Knot begin = with_planned_height(measured, jump, kTime_s);
  CHECK(begin.com_W == measured.com_W);
  CHECK(begin.com_velocity_W == measured.com_velocity_W);
}
