#include "ddp/problem_layout.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ddp/constants.hpp"
#include "plan/clearance.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/// Directions in which an end-effector's centre of pressure, or its moments, may lie: the common plane or normal of all
/// surfaces that it may touch, or all of space where these differ. The dynamics must not depend on which one it is;
/// rows of the contact then keep to its plane and normal.
std::optional<Vector3d> common_normal(const std::vector<Polygon>& polygons, const std::vector<int>& surfaces) {
  constexpr double kParallel = 1e-9;
  for (int i : surfaces)
    if ((polygons[i].normal_W() - polygons[surfaces.front()].normal_W()).norm() > kParallel) return std::nullopt;
  return polygons[surfaces.front()].normal_W();
}

/// An end-effector that stands below the CoM shifts its force's line sideways: along itself would be nearly the same as
/// another stiffness. Where it may touch surfaces that it meets at an angle, walls above all, the line goes anywhere.
Matrix3Xd force_line_directions(const Vector3d& nominal, const std::vector<Polygon>& polygons,
                                const std::vector<int>& surfaces) {
  const bool facing = std::all_of(surfaces.begin(), surfaces.end(), [&](int i) {
    return std::abs(polygons[i].normal_W().dot(nominal)) > kFacing * nominal.norm();
  });
  // The two are level: those of an end-effector that hangs down.
  return Eigen::Matrix3d::Identity().leftCols(facing && std::abs(nominal.z()) > kFacing * nominal.norm() ? 2 : 3);
}

}  // namespace

Layout wrench_layout(const std::vector<EndLimits>& limits, const std::vector<Polygon>& polygons,
                     const std::vector<std::vector<int>>& surfaces) {
  std::vector<Layout::Offsets> end_effectors;
  std::vector<Layout::Moment> moments;
  for (std::size_t l = 0; l < limits.size(); ++l) {
    const std::optional<Vector3d> normal = common_normal(polygons, surfaces[l]);
    Layout::Offsets offsets;
    if (limits[l].half_size.maxCoeff() > 0.0) {
      if (normal)
        offsets.pressure = mcplan::sole_frame(*normal, 0.0).leftCols<2>();
      else
        offsets.pressure = Eigen::Matrix3d::Identity();
    }
    offsets.force_line = force_line_directions(limits[l].nominal, polygons, surfaces[l]);
    end_effectors.push_back(offsets);
    const double max_moment = limits[l].moment_max.z();
    if (max_moment <= 0.0) continue;
    if (normal)
      moments.push_back({static_cast<int>(l), *normal, max_moment});
    else
      for (int i = 0; i < 3; ++i) moments.push_back({static_cast<int>(l), Vector3d::Unit(i), max_moment});
  }
  return Layout(end_effectors, {0, 1, 2}, moments);
}

Layout lipm_layout(const std::vector<EndLimits>& limits, bool all_axes) {
  std::vector<int> axes;
  for (int axis = 0; axis < 3; ++axis)
    if (all_axes ||
        std::any_of(limits.begin(), limits.end(), [&](const EndLimits& e) { return e.moment_max[axis] > 0.0; }))
      axes.push_back(axis);
  std::vector<Layout::Moment> moments;
  for (std::size_t l = 0; l < limits.size(); ++l)
    for (int axis : axes)
      if (all_axes || limits[l].moment_max[axis] > 0.0)
        moments.push_back({static_cast<int>(l), Vector3d::Unit(axis), limits[l].moment_max[axis]});
  return Layout(std::vector<Layout::Offsets>(limits.size()), axes, moments);
}

}  // namespace mcplan::ddp
