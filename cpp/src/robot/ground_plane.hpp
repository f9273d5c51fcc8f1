#pragma once

#include <Eigen/Core>
#include <vector>

namespace mcplan {

/// Roll, pitch and yaw [rad] of a base of that yaw that is parallel to the plane through the feet, to the nearest one
/// of more than three; upright on fewer than three feet and on feet in a row.
Eigen::Vector3d rpy_along_ground(const std::vector<Eigen::Vector3d>& feet_W, double yaw);

}  // namespace mcplan
