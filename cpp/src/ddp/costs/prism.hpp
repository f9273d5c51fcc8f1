#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mcplan/scene/polygon.hpp"

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
  int side = 0;
  for (int i = 1; i < polygon.edge_count(); ++i)
    if (polygon.overshoot(i, p) > polygon.overshoot(side, p)) side = i;
  const Outside beside{polygon.overshoot(side, p), polygon.edge_outward_W(side)};
  if (beside.distance <= 0.0) return above == 0.0 ? beside : Outside{std::abs(above), std::copysign(1.0, above) * n};
  const Eigen::Vector3d level = p - height * n;
  const Eigen::Vector3d away = level - polygon.nearest(level) + above * n;
  const double distance = away.norm();
  return distance > 0.0 ? Outside{distance, away / distance} : beside;
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

/// Of a line from + s along, 0 <= s <= 1: where a solid is nearest, and how far off.
struct NearestOnLine {
  double s;
  Outside outside;
};

/// The distance is convex along a line, so that it lies above its tangents: those at both ends of an interval meet
/// below its minimum there. Once this is known to be at least `enough`, any place that is so far off is as good.
inline NearestOnLine nearest_on_line(const Polygon& polygon, double thickness, const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& along,
                                     double enough = std::numeric_limits<double>::infinity()) {
  constexpr double kGap = 1e-14;  // of distance, above the least that the tangents leave: the place within 1e-7
  constexpr int kProbes = 60;     // a half of them halve the interval
  const auto at = [&](double s) { return NearestOnLine{s, outside_solid(polygon, thickness, from + s * along)}; };
  NearestOnLine low = at(0.0), high = at(1.0);
  double falls = low.outside.outward.dot(along), rises = high.outside.outward.dot(along);
  if (falls >= 0.0) return low;
  if (rises <= 0.0) return high;
  for (int probe = 0; probe < kProbes; ++probe) {
    const double width = high.s - low.s;
    const double meet = (high.outside.distance - low.outside.distance - rises * width) / (falls - rises);
    const double least = low.outside.distance + falls * meet;
    if (least >= enough || std::min(low.outside.distance, high.outside.distance) - least < kGap) break;
    // Where the tangents meet is the minimum between two planes; where the slope would vanish, of what is smooth.
    const double step = probe % 2 == 1 ? 0.5 * width : probe % 4 == 0 ? meet : width * falls / (falls - rises);
    const NearestOnLine next = at(low.s + std::clamp(step, 0.0, width));
    const double slope = next.outside.outward.dot(along);
    if (slope == 0.0) return next;
    (slope < 0.0 ? low : high) = next;
    (slope < 0.0 ? falls : rises) = slope;
  }
  return low.outside.distance < high.outside.distance ? low : high;
}

}  // namespace mcplan::ddp
