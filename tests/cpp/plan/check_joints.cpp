#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mcplan/plan/checker.hpp"
#include "plan/wrench_fixtures.hpp"

namespace {

using namespace fixtures;
using mcplan::CheckResult;
using mcplan::Plan;
constexpr double kInf = std::numeric_limits<double>::infinity();

const mcplan::Violation& find(const CheckResult& result, const std::string& name) {
  for (const auto& violation : result.constraints)
    if (violation.name == name) return violation;
  throw std::out_of_range(name);
}

CheckResult check(const Plan& plan) { return mcplan::check(plan, plan.scene, plan.robot); }

/// Legs whose hips are above their feet, with room to walk.
Plan with_legs(Plan plan, const std::function<void(mcplan::LimbLimits&)>& set) {
  for (int foot : {left_foot, right_foot}) {
    mcplan::LimbLimits& limb = plan.robot.end_effectors[foot].limb;
    limb.hip_B = {-0.015, foot == left_foot ? 0.1 : -0.1, -0.05};
    limb.upper = limb.lower = 0.4;
    limb.ankle = {0.0, 0.0, 0.06};
    set(limb);
  }
  return plan;
}

double hip_to_ankle(const Plan& plan) { return plan.knots[0].com_W.z() - 0.05 - 0.06; }

}  // namespace

TEST_CASE("checker holds the knees of a stance to the vertical force times the way from the knee to where it acts") {
  const Plan stand = stand_on_wrenches();
  const double length = hip_to_ankle(stand), lever = std::sqrt(0.4 * 0.4 - 0.25 * length * length);
  const double weight = 0.5 * stand.robot.mass * kGravity, torque = weight * (lever - 0.015);
  for (double limit : {1.03 * torque, 0.97 * torque}) {
    const CheckResult result = check(with_legs(stand, [&](auto& limb) { limb.knee_torque = limit; }));
    INFO(result.to_string());
    CHECK(find(result, "joint_torque").value == doctest::Approx(torque / limit - 1.0).epsilon(1e-6));
    CHECK(result.ok() == (limit > torque));
  }
  // Behind the leg the force passes ahead of the knee by as much more; a hip that may be nearer has a longer lever.
  const CheckResult behind = check(with_legs(stand, [&](auto& limb) {
    limb.knee_torque = torque;
    limb.bends_backward = true;
  }));
  CHECK(find(behind, "joint_torque").value == doctest::Approx(weight * (lever + 0.015) / torque - 1.0).epsilon(1e-6));
  const CheckResult unsure = check(with_legs(stand, [&](auto& limb) {
    limb.knee_torque = torque;
    limb.margin = 0.02;
  }));
  const double shorter = length - 0.02, longer_lever = std::sqrt(0.4 * 0.4 - 0.25 * shorter * shorter),
               lower = std::sqrt(0.4 * 0.4 - longer_lever * longer_lever) - 0.5 * shorter;
  CHECK(std::abs(lower) < 1e-12);
  CHECK(find(unsure, "joint_torque").value ==
        doctest::Approx(weight * (longer_lever - 0.015) / torque - 1.0).epsilon(1e-6));
}

TEST_CASE("checker holds hips and ankles to the force times their distance from its line") {
  const Plan stand = stand_on_wrenches();
  const double torque = 0.5 * stand.robot.mass * kGravity * 0.015;
  for (double limit : {1.03 * torque, 0.97 * torque}) {
    const CheckResult hip = check(with_legs(stand, [&](auto& limb) { limb.hip_torque = {kInf, limit}; }));
    CHECK(find(hip, "joint_torque").value == doctest::Approx(torque / limit - 1.0).epsilon(1e-6));
    const CheckResult ankle = check(with_legs(stand, [&](auto& limb) { limb.ankle_torque = {kInf, limit}; }));
    CHECK(find(ankle, "joint_torque").value == doctest::Approx(torque / limit - 1.0).epsilon(1e-6));
    CHECK(ankle.ok() == (limit > torque));
    // Nothing passes beside the leg.
    const CheckResult roll = check(with_legs(stand, [&](auto& limb) { limb.hip_torque = {limit, kInf}; }));
    CHECK(find(roll, "joint_torque").value < -0.99);
  }
}

TEST_CASE("checker holds the speed of knees to what the length of legs in contact says") {
  const Plan walk = with_legs(wrench_walk(), [](auto& limb) { limb.knee_speed = 1.0; });
  double fastest = 0.0;
  for (std::size_t k = 0; k < walk.phases.size(); ++k) {
    const double duration = walk.phases[k].duration, start = walk.knot_times()[k];
    for (int foot : {left_foot, right_foot}) {
      if (walk.phases[k].contacts[foot].surface < 0) continue;
      const auto angle = [&](double t) {
        const mcplan::PlanState state = walk.at(start + t);
        const Vector3d hip =
            state.com_W + mcplan::rotation_from_rpy(state.base_rpy) * walk.robot.end_effectors[foot].limb.hip_B;
        const Vector3d ankle = state.end_effectors[foot].position_W + Vector3d(0.0, 0.0, 0.06);
        return 2.0 * std::asin((hip - ankle).norm() / 0.8);
      };
      for (double t = 1e-3; t < duration - 2e-3; t += 1e-3)
        fastest = std::max(fastest, std::abs(angle(t + 1e-3) - angle(t)) / 1e-3);
    }
  }
  CHECK(fastest > 0.01);
  CHECK(find(check(walk), "joint_speed").value == doctest::Approx(fastest - 1.0).epsilon(0.02));
  const auto verdict = [&](double limit) {
    return find(check(with_legs(wrench_walk(), [&](auto& limb) { limb.knee_speed = limit; })), "joint_speed").value;
  };
  CHECK(verdict(1.1 * fastest) < 0.0);
  CHECK(verdict(0.9 * fastest) > 0.02);
}

TEST_CASE("checker says reach of a leg that its links do not span, and nothing of legs without limits") {
  const Plan stand = stand_on_wrenches();
  const Plan stretched = with_legs(stand, [&](auto& limb) { limb.upper = limb.lower = 0.51 * hip_to_ankle(stand); });
  CHECK(check(stand).ok());
  CHECK(find(check(stand), "joint_torque").phase == -1);
  const CheckResult result = check(stretched);
  CHECK(find(result, "reach").value < 0.0);
  const double r = 0.15 * 0.45 * hip_to_ankle(stand);
  Plan too_long = stretched;
  for (int foot : {left_foot, right_foot}) {
    too_long.robot.end_effectors[foot].limb.upper = too_long.robot.end_effectors[foot].limb.lower =
        0.45 * hip_to_ankle(stand);
    // The nominal stance bends them: its feet are nearer.
    too_long.robot.end_effectors[foot].nominal_B.z() += 0.15;
    too_long.robot.end_effectors[foot].reach_max_B.z() = -0.4;
  }
  const double link = 0.45 * hip_to_ankle(stand);
  CHECK(find(check(too_long), "reach").value ==
        doctest::Approx(hip_to_ankle(stand) - 2.0 * std::sqrt(link * link - r * r)).epsilon(1e-6));
}
