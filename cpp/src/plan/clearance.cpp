#include "plan/clearance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mcplan/base/error.hpp"
#include "plan_shape.hpp"

namespace mcplan {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::vector<Solid> solids_of(const Scene& scene) {
  std::vector<Solid> solids;
  for (const Surface& surface : scene.surfaces) solids.push_back({Polygon(surface.vertices_W), surface.thickness});
  return solids;
}

double clearance_depth(const std::vector<Solid>& solids, const Vector3d& point_W) {
  double worst = 0.0;
  for (const Solid& solid : solids) {
    const double depth = -solid.polygon.height(point_W);
    if (depth > worst && depth < solid.thickness && solid.polygon.outside(point_W) < 0.0) worst = depth;
  }
  return worst;
}

Matrix3d sole_frame(const Vector3d& normal_W, double yaw) {
  const Vector3d heading(std::cos(yaw), std::sin(yaw), 0.0);
  Vector3d along = heading - normal_W * normal_W.dot(heading);
  if (along.norm() < 0.1) along = Vector3d::UnitZ() - normal_W * normal_W.z();
  along.normalize();
  Matrix3d frame;
  frame << along, normal_W.cross(along), normal_W;
  return frame;
}

double clearance_depth(const std::vector<Solid>& solids, const EndEffector& end_effector, const Vector3d& position_W,
                       const Matrix3d& sole_W, bool whole_sole) {
  double worst = clearance_depth(solids, position_W);
  const Eigen::Vector2d& half = end_effector.half_size;
  if (!whole_sole || half.maxCoeff() <= 0.0) return worst;
  for (double x : {-half.x(), half.x()})
    for (double y : {-half.y(), half.y()})
      worst = std::max(worst, clearance_depth(solids, position_W + x * sole_W.col(0) + y * sole_W.col(1)));
  return worst;
}

/// Whether no corner of a sole about that point can be in a solid, from how far the point is from the solid's sides: a
/// corner is half a diagonal away, of which the normals' angle leaves a part across the solid's plane. The margins are
/// far above the rounding of a corner's place.
static bool corners_clear(const std::vector<Solid>& solids, const Vector3d& position_W, double half_diagonal,
                          const Vector3d& sole_normal_W) {
  const double margin = 1e-6 * half_diagonal + 1e-12 * position_W.lpNorm<1>();
  for (const Solid& solid : solids) {
    const Polygon& polygon = solid.polygon;
    const double height = polygon.height(position_W), cosine = polygon.normal_W().dot(sole_normal_W);
    const double above = std::max(height, -solid.thickness - height) - margin;
    if (above > 0.0 && above * above > half_diagonal * half_diagonal * (1.0 - cosine * cosine)) continue;
    if (!(polygon.outside(position_W) > half_diagonal + margin)) return false;
  }
  return true;
}

double begun_s(const Swing& swing, const Robot& robot, const Similarity& similarity) {
  return std::min(swing.elapsed_s, phase_duration_of(robot, similarity)[1]);
}

std::vector<FreeStretch> free_stretches(const Plan& plan, const std::vector<Solid>& solids, int end_effector) {
  return free_stretches(plan, solids, end_effector, plan.robot, similarity_of(plan.robot, plan.scene.gravity));
}

std::vector<FreeStretch> free_stretches(const Plan& plan, const std::vector<Solid>& solids, int end_effector,
                                        const Robot& robot, const Similarity& similarity) {
  require_shape(plan, solids.size(), false);
  if (end_effector < 0 || end_effector >= plan.end_effector_count())
    throw InvalidInput("end_effector", "must be an index below " + text(plan.end_effector_count()), text(end_effector));
  std::vector<FreeStretch> stretches;
  const int n = static_cast<int>(plan.phases.size());
  int before = -1;
  double time = 0.0;
  bool open = false;
  for (int k = 0; k <= n; ++k) {
    const int surface = k < n ? plan.phases[k].contacts[end_effector].surface : plan.final_contacts[end_effector];
    if (surface < 0 && !open && k < n) {
      stretches.emplace_back();
      stretches.back().first_phase = k;
      stretches.back().start_s = time;
      if (before >= 0) stretches.back().lift_normal_W = solids[before].polygon.normal_W();
      open = true;
    }
    if (open && (surface >= 0 || k == n)) {
      stretches.back().end_phase = k;
      stretches.back().duration_s = time - stretches.back().start_s;
      if (surface >= 0) stretches.back().land_normal_W = solids[surface].polygon.normal_W();
      open = false;
    }
    before = surface;
    if (k < n) time += plan.phases[k].duration;
  }
  if (stretches.empty() || stretches.front().first_phase > 0) return stretches;
  for (const Swing& swing : plan.swings)
    if (swing.end_effector == end_effector && swing.first_phase == 0) {
      if (swing.elapsed_s > 0.0) stretches.front().before_s = begun_s(swing, robot, similarity);
      // What is in the air at the start is as tilted there as the plan says.
      if (swing.lift_normal_W.norm() > 0.0) stretches.front().lift_normal_W = swing.lift_normal_W.normalized();
    }
  return stretches;
}

double clearance_depth(const std::vector<Solid>& solids, const EndEffector& end_effector, const FreeStretch& stretch,
                       double s, const Vector3d& position_W, double yaw) {
  const bool middle = s > 0.1 && s < 0.9;
  const Vector3d normal = stretch.normal(s);
  // Half way between opposite walls there is no normal to turn to; the point alone counts there.
  const double length = normal.norm();
  const double half_diagonal = end_effector.half_size.norm();
  if (!middle || length < 1e-6 || half_diagonal <= 0.0 ||
      corners_clear(solids, position_W, half_diagonal, normal / length))
    return clearance_depth(solids, position_W);
  return clearance_depth(solids, end_effector, position_W, sole_frame(normal / length, yaw), true);
}

}  // namespace mcplan
