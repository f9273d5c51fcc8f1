#pragma once

#include <Eigen/Geometry>

#include "plan/clearance.hpp"

namespace mcplan {

/// Radius of the ball about the CoM that stays out of solids, in CoM heights: thinner than any trunk.
constexpr double kTrunkBall = 0.1;

/// Box of the prism below a surface; of one without a bottom nothing can be said, and its numbers say so.
inline Eigen::AlignedBox3d box_of(const Solid& solid) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : solid.polygon.vertices_W()) {
    box.extend(vertex);
    box.extend(vertex - solid.thickness * solid.polygon.normal_W());
  }
  return box;
}

}  // namespace mcplan
