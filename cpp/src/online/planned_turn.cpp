#include "mcplan/online/planned_turn.hpp"

#include <algorithm>

#include "mcplan/robot/similarity.hpp"

namespace mcplan::online {

using Eigen::Vector3d;

namespace {

/// A CoM that is faster than planned by this [m/s], for a robot of human size, was pushed. As for steps that catch a
/// push.
constexpr double kPushed_m_s = 0.08;

}  // namespace

Knot with_planned_turn(Knot measured, const Plan& plan, double t, double margin_rad_s) {
  const PlanState planned = plan.at(std::clamp(t, 0.0, plan.duration()));
  const auto touches = [](const EndEffectorState& end) { return end.surface >= 0; };
  if (std::none_of(planned.end_effectors.begin(), planned.end_effectors.end(), touches)) return measured;
  const double under_way = t > plan.duration() ? 0.0 : 1.0;  // at the end it stands
  const double pushed_m_s = (measured.com_velocity_W - under_way * planned.com_velocity_W).norm();
  if (pushed_m_s > kPushed_m_s * similarity_of(plan.robot, plan.scene.gravity).velocity()) return measured;
  const Vector3d rate = under_way * planned.base_rpy_rate, momentum_W = under_way * planned.angular_momentum_W;
  const Vector3d off = measured.base_rpy_rate - rate;
  if (!(off.norm() > 0.0)) return measured;
  const double ratio = std::max(1.0 - margin_rad_s / off.norm(), 0.0);
  measured.base_rpy_rate = rate + ratio * off;
  // Zero stands for the momentum that goes with the rates.
  if (!measured.angular_momentum_W.isZero(0.0))
    measured.angular_momentum_W = momentum_W + ratio * (measured.angular_momentum_W - momentum_W);
  return measured;
}

}  // namespace mcplan::online
