#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mcplan/scene/polygon.hpp"

namespace mcplan::ddp {

/// Boxes about polygons, which tell in no time that a polygon is too far away to be the nearest.
class SurfaceBoxes {
 public:
  explicit SurfaceBoxes(const std::vector<Polygon>& polygons) : boxes_(polygons.size()) {
    for (std::size_t i = 0; i < polygons.size(); ++i)
      for (const Eigen::Vector3d& vertex : polygons[i].vertices_W()) boxes_[i].extend(vertex);
  }

  /// No more than the squared distance of the polygon, however little flat it is within what a scene admits.
  double min_squared_distance(int polygon, const Eigen::Vector3d& point) const {
    constexpr double kFlat = 1e-3;
    return (1.0 - kFlat) * boxes_[polygon].squaredExteriorDistance(point) - kFlat;
  }

 private:
  std::vector<Eigen::AlignedBox3d> boxes_;
};

}  // namespace mcplan::ddp
