#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace mcplan {

/// Rotation R_WB of roll, pitch, yaw [rad]: R = Rz(yaw) Ry(pitch) Rx(roll).
Eigen::Matrix3d rotation_from_rpy(const Eigen::Vector3d& rpy);

/// dR/d(rpy_i) for i = 0 (roll), 1 (pitch), 2 (yaw).
Eigen::Matrix3d rotation_derivative(const Eigen::Vector3d& rpy, int i);

/// Unit quaternion (w, x, y, z) of roll, pitch, yaw [rad], with w >= 0.
Eigen::Vector4d quat_wxyz_from_rpy(const Eigen::Vector3d& rpy);
Eigen::Vector4d quat_wxyz_from_rotation(const Eigen::Matrix3d& rotation);  ///< the same of R_WB

}  // namespace mcplan
