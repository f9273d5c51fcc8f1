#include "robot/ground_plane.hpp"

#include <Eigen/LU>
#include <cmath>

#include "mcplan/base/rotation.hpp"

namespace mcplan {

using Eigen::Vector3d;

Vector3d rpy_along_ground(const std::vector<Vector3d>& feet_W, double yaw) {
  constexpr double kInRow = 1e-3;  // of the spread across a row over that along it
  const Vector3d upright(0.0, 0.0, yaw);
  if (feet_W.size() < 3) return upright;
  const Eigen::Matrix3d to_level = rotation_from_rpy(upright).transpose();
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& foot : feet_W) mean += foot / static_cast<double>(feet_W.size());
  // Least squares of z = a x + b y over the feet about their mean.
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Vector2d rise = Eigen::Vector2d::Zero();
  for (const Vector3d& foot : feet_W) {
    const Vector3d off = to_level * (foot - mean);
    spread += off.head<2>() * off.head<2>().transpose();
    rise += off.z() * off.head<2>();
  }
  if (!(spread.determinant() > kInRow * spread.trace() * spread.trace())) return upright;
  const Eigen::Vector2d slope = spread.inverse() * rise;
  const Vector3d normal = Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
  return {std::asin(-normal.y()), std::atan2(normal.x(), normal.z()), yaw};
}

}  // namespace mcplan
