#include "plan/sole_depth.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

namespace mcplan {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Interval {
  double min = std::numeric_limits<double>::infinity(), max = -std::numeric_limits<double>::infinity();

  void extend(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
  }
};

/// A sole's corners, relative to a corner of the solid: coordinates far from the origin cost no digits.
using Corners = std::array<Vector3d, 4>;

/// By how much the sole has to be moved along a direction to be out of the solid [m], the shorter way, but not down
/// through it: whoever stands below a solid has a foot above the sole. 0 or less: it is out; infinity: the direction
/// tells nothing.
double way_out(const Vector3d& direction, const Corners& corners, const Solid& solid, double height) {
  constexpr double kUpright = 0.5;  // cosine to the solid's normal from which a direction counts as up and down
  const double length = direction.norm();
  if (length < 1e-9) return std::numeric_limits<double>::infinity();
  const Vector3d &normal = solid.polygon.normal_W(), &origin = solid.polygon.vertices_W().front();
  const Vector3d axis = (direction.dot(normal) < 0.0 ? -1.0 : 1.0) / length * direction;
  const double upright = axis.dot(normal);
  Interval sole, prism;
  for (const Vector3d& corner : corners) sole.extend(axis.dot(corner));
  for (const Vector3d& vertex : solid.polygon.vertices_W()) {
    const double there = axis.dot(vertex - origin);
    prism.extend(there);
    prism.extend(there - solid.thickness * upright);
  }
  if (upright > kUpright) return prism.min - sole.max > height ? 0.0 : prism.max - sole.min;
  return std::min(sole.max - prism.min, prism.max - sole.min);
}

/// By the theorem of the separating axis, over the normals of both and the directions across their edges.
double depth_in(const Corners& corners, const Matrix3d& sole_W, const Solid& solid, double height) {
  const Polygon& polygon = solid.polygon;
  double depth = way_out(polygon.normal_W(), corners, solid, height);
  const auto look_along = [&](const Vector3d& direction) {
    if (depth > 0.0) depth = std::min(depth, way_out(direction, corners, solid, height));
  };
  look_along(sole_W.col(2));
  for (int i = 0; i < polygon.edge_count(); ++i) look_along(polygon.edge_outward_W(i));
  for (int a = 0; a < 2; ++a) {
    look_along(sole_W.col(a).cross(polygon.normal_W()));
    for (int i = 0; i < polygon.edge_count(); ++i)
      look_along(sole_W.col(a).cross(polygon.edge_outward_W(i).cross(polygon.normal_W())));
  }
  return std::max(depth, 0.0);
}

}  // namespace

double sole_depth(const std::vector<Solid>& solids, int own, const EndEffector& end_effector, double height,
                  const Vector3d& position_W, const Matrix3d& sole_W) {
  const Eigen::Vector2d& half = end_effector.half_size;
  const double radius = half.norm();
  double worst = 0.0;
  for (int i = 0; i < static_cast<int>(solids.size()); ++i) {
    const Polygon& polygon = solids[i].polygon;
    if (i == own || polygon.outside(position_W) > radius || polygon.height(position_W) > radius) continue;
    const Vector3d from = position_W - polygon.vertices_W().front();
    const Vector3d x = half.x() * sole_W.col(0), y = half.y() * sole_W.col(1);
    worst =
        std::max(worst, depth_in({from + x + y, from + x - y, from - x - y, from - x + y}, sole_W, solids[i], height));
  }
  return worst;
}

}  // namespace mcplan
