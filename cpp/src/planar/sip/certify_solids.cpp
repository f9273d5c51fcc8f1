#include <algorithm>
#include <cmath>
#include <limits>

#include "certify_rows.hpp"

namespace mcplan::sip::proof {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

/// An outermost point of an end-effector in the frame of a surface.
OverSurface over(const PlanarPlan& plan, const PieceModels& models, int end_effector, int surface, bool last) {
  const std::vector<double>& points = plan.task.robot.end_effectors[end_effector].points;
  const auto [low, high] = std::minmax_element(points.begin(), points.end());
  return over_surface(plan, models, end_effector, surface, static_cast<int>((last ? high : low) - points.begin()));
}

/// How far the strip behind a surface reaches beyond the line through two points, on one of its two sides (`side` 1:
/// the left one as seen from a to b). That counts where the strip has an end on that side: where the line's normal does
/// not point into the solid, nor along the surface to where it has no end. Elsewhere it is no way out: infinite.
Amount beyond_line(const PlanarSurface& surface, const OverSurface& a, const OverSurface& b, double length,
                   double side) {
  const TaylorModel along = b.along - a.along, up = b.height - a.height;
  // In the surface's frame the normal is side (-up, along) / length, the points being this far apart.
  const auto beyond = [&](double corner) {
    const TaylorModel from_a = a.along - TaylorModel::constant(a.along.order(), corner);
    return scaled(Amount::of(up * from_a - along * a.height), side / length, 0.0);
  };
  Amount out;
  if (std::isinf(surface.from))
    out = beyond(surface.to);
  else if (std::isinf(surface.to))
    out = beyond(surface.from);
  else
    out = larger(beyond(surface.from), beyond(surface.to));
  const auto only_where = [&out](const Amount& not_negative) {
    out = out.map(not_negative, [](const Range& value, const Range& condition) {
      return Range{condition.max < 0.0 ? kNone : value.min, condition.min < 0.0 ? kNone : value.max};
    });
  };
  only_where(Amount::of(along.scaled(side)));
  if (std::isinf(surface.from)) only_where(Amount::of(up.scaled(-side)));
  if (std::isinf(surface.to)) only_where(Amount::of(up.scaled(side)));
  return out;
}

}  // namespace

/// The shortest way out of the strip: through the surface, over its ends, or across the end-effector's own line.
Amount depth_in_solid(const PlanarPlan& plan, const PieceModels& models, int end_effector, int surface_index) {
  const PlanarSurface& surface = plan.task.surfaces[surface_index];
  const OverSurface a = over(plan, models, end_effector, surface_index, false);
  const OverSurface b = over(plan, models, end_effector, surface_index, true);
  const auto farther = [](const TaylorModel& one, const TaylorModel& other, double sign, double shift) {
    return larger(scaled(Amount::of(one), sign, shift), scaled(Amount::of(other), sign, shift));
  };
  Amount depth = farther(a.height, b.height, -1.0, 0.0);
  if (std::isinf(surface.from) && std::isinf(surface.to)) return depth;
  if (!std::isinf(surface.from)) depth = smaller(depth, farther(a.along, b.along, 1.0, -surface.from));
  if (!std::isinf(surface.to)) depth = smaller(depth, farther(a.along, b.along, -1.0, surface.to));
  const std::vector<double>& points = plan.task.robot.end_effectors[end_effector].points;
  const auto [low, high] = std::minmax_element(points.begin(), points.end());
  const double length = *high - *low;
  if (!(length > 0.0)) return depth;
  for (double side : {1.0, -1.0}) depth = smaller(depth, beyond_line(surface, a, b, length, side));
  return depth;
}

/// Height of a point of an end-effector over a surface, and where it is along the surface.
OverSurface over_surface(const PlanarPlan& plan, const PieceModels& models, int end_effector, int surface_index,
                         int point) {
  const PlanarEndEffector& end = plan.task.robot.end_effectors[end_effector];
  const PlanarSurface& surface = plan.task.surfaces[surface_index];
  Constant point_B;
  const Eigen::Vector2d along_B(std::cos(end.angle_B), std::sin(end.angle_B));
  point_B.value = end.position_B + end.points[point] * along_B;
  point_B.error = 4.0 * kEpsilon * (end.position_B.lpNorm<1>() + std::abs(end.points[point]));
  Vector off = models.point_W(end.body, point_B);
  off.x -= TaylorModel::constant(off.x.order(), surface.origin_W.x());
  off.y -= TaylorModel::constant(off.y.order(), surface.origin_W.y());
  const Eigen::Vector2d tangent(std::cos(surface.angle), std::sin(surface.angle));
  OverSurface out;
  out.along = off.x.scaled(tangent.x(), kEpsilon).add_scaled(tangent.y(), off.y, kEpsilon);
  out.height = off.y.scaled(tangent.x(), kEpsilon).add_scaled(-tangent.y(), off.x, kEpsilon);
  return out;
}

}  // namespace mcplan::sip::proof
