#pragma once

#include <Eigen/Core>
#include <vector>

namespace mcplan::ddp {

/// What of a planar polygon lies in a box (Sutherland and Hodgman); points count as polygons. Empty: nothing.
inline std::vector<Eigen::Vector3d> cut_to_box(std::vector<Eigen::Vector3d> polygon, const Eigen::Vector3d& box_min,
                                               const Eigen::Vector3d& box_max) {
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    const double sign = side % 2 == 0 ? 1.0 : -1.0, limit = side % 2 == 0 ? box_max[axis] : box_min[axis];
    std::vector<Eigen::Vector3d> left;
    for (std::size_t i = 0, n = polygon.size(); i < n; ++i) {
      const Eigen::Vector3d &a = polygon[i], &b = polygon[(i + 1) % n];
      const double beyond_a = sign * (a[axis] - limit), beyond_b = sign * (b[axis] - limit);
      if (beyond_a <= 0.0) left.push_back(a);
      if ((beyond_a <= 0.0) != (beyond_b <= 0.0)) left.push_back(a + beyond_a / (beyond_a - beyond_b) * (b - a));
    }
    polygon = left;
  }
  return polygon;
}

}  // namespace mcplan::ddp
