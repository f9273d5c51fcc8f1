#pragma once

#include <Eigen/Core>

namespace mcplan::planar {

/// The z component of a x b, of two vectors in the plane.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// A vector turned by 90 degrees, counter-clockwise.
inline Eigen::Vector2d left_of(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

}  // namespace mcplan::planar
