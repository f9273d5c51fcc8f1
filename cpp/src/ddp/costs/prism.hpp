#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "mcplan/scene/polygon.hpp"
#include "plan/convex_min.hpp"

namespace mcplan::ddp {

/// Of a point and the prism below a polygon: how far outside it is, and in which direction that grows; inside, minus
/// the distance to the nearest side. A trunk does not leave a post through its top.
struct Outside {
  double distance;
  Eigen::Vector3d outward;
};

inline Outside outside_prism(const Polygon& polygon, double thickness, const Eigen::Vector3d& p) {
  const Eigen::Vector3d& n = polygon.normal_W();
  const double height = polygon.height(p), above = std::max(height, 0.0) + std::min(height + thickness, 0.0);
  const Eigen::Vector3d level = p - height * n;
  const Eigen::Vector3d away = level - polygon.nearest(level) + above * n;
  const double distance = away.norm();
  if (distance > 0.0) return {distance, away / distance};
  int side = 0;
  for (int i = 1; i < polygon.edge_count(); ++i)
    if (polygon.overshoot(i, p) > polygon.overshoot(side, p)) side = i;
  return {polygon.overshoot(side, p), polygon.edge_outward_W(side)};
}

/// The same, but that the nearest side may be the top or the bottom: a convex function of p, and a continuous one.
inline Outside outside_solid(const Polygon& polygon, double thickness, const Eigen::Vector3d& p) {
  Outside out = outside_prism(polygon, thickness, p);
  if (out.distance > 0.0) return out;
  const double top = polygon.height(p), bottom = -thickness - top;
  if (std::max(top, bottom) > out.distance) {
    out.distance = std::max(top, bottom);
    out.outward = top > bottom ? polygon.normal_W() : Eigen::Vector3d(-polygon.normal_W());
  }
  return out;
}

/// Where on a line from + s along, 0 <= s <= 1, a solid is nearest.
inline double nearest_on_line(const Polygon& polygon, double thickness, const Eigen::Vector3d& from,
                              const Eigen::Vector3d& along) {
  const auto distance = [&](double s) { return outside_solid(polygon, thickness, from + s * along).distance; };
  double best = convex_min(distance);
  for (const double end : {0.0, 1.0})
    if (distance(end) < distance(best)) best = end;
  return best;
}

}  // namespace mcplan::ddp
