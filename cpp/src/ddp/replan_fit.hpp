#pragma once

#include <cmath>
#include <string>

#include "mcplan/base/error.hpp"
#include "mcplan/plan/plan.hpp"
#include "mcplan/robot/robot.hpp"

namespace mcplan::ddp {

/// Headings that differ by fewer turns are of a robot that counts them otherwise. Chosen.
constexpr double kTurnsMax = 1000.0;

/// What replan() relies on beyond a plan that is valid in itself.
inline void require_fit(const Plan& previous, const Knot& measured, const Robot& robot) {
  const std::size_t end_effectors = robot.end_effectors.size();
  const auto require_count = [end_effectors](const std::string& field, std::size_t count) {
    if (count != end_effectors)
      throw InvalidPlan(field, "must be one per end-effector (" + std::to_string(end_effectors) + ")",
                        std::to_string(count));
  };
  require_count("previous.robot.end_effectors", previous.robot.end_effectors.size());
  for (std::size_t e = 0; e < end_effectors; ++e)
    if (previous.robot.end_effectors[e].name != robot.end_effectors[e].name)
      throw InvalidPlan("previous.robot.end_effectors[" + std::to_string(e) + "].name",
                        "must be that of the robot (" + robot.end_effectors[e].name + ")",
                        previous.robot.end_effectors[e].name);
  require_count("measured.end_effectors_W", measured.end_effectors_W.size());
  if (!measured.end_effector_yaw.empty()) require_count("measured.end_effector_yaw", measured.end_effector_yaw.size());
  if (!measured.end_effector_velocities_W.empty())
    require_count("measured.end_effector_velocities_W", measured.end_effector_velocities_W.size());
  const auto require_finite = [](const std::string& field, const Eigen::Ref<const Eigen::VectorXd>& value) {
    if (!value.allFinite()) throw InvalidPlan("measured." + field, "must be finite numbers", text(value));
  };
  require_finite("com_W", measured.com_W);
  require_finite("com_velocity_W", measured.com_velocity_W);
  require_finite("base_rpy", measured.base_rpy);
  if (!(measured.base_rpy.cwiseAbs().maxCoeff() < kTurnsMax * 2.0 * M_PI))
    throw InvalidPlan("measured.base_rpy", "must be angles of fewer than 1000 turns [rad]", text(measured.base_rpy));
  require_finite("base_rpy_rate", measured.base_rpy_rate);
  require_finite("angular_momentum_W", measured.angular_momentum_W);
  for (const Eigen::Vector3d& end : measured.end_effectors_W) require_finite("end_effectors_W", end);
  for (const Eigen::Vector3d& velocity : measured.end_effector_velocities_W)
    require_finite("end_effector_velocities_W", velocity);
  for (double yaw : measured.end_effector_yaw) require_finite("end_effector_yaw", Eigen::VectorXd::Constant(1, yaw));
}

}  // namespace mcplan::ddp
