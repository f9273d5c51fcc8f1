#include <algorithm>
#include <cmath>

#include "check_internal.hpp"

namespace mcplan::checks {
namespace {

using Eigen::Vector3d;

/// contact_distance: |n . (p - v)|.  contact_polygon: distance of p's projection beyond the boundary (negative inside).
void offer_place(const Polygon& polygon, const Vector3d& position, const Place& place, Findings& findings) {
  findings.offer(Constraint::contact_distance, std::abs(polygon.height(position)), place);
  double beyond = polygon.outside(position);
  if (beyond > 0.0) {
    const Vector3d projected = position - polygon.normal_W() * polygon.height(position);
    beyond = (projected - polygon.nearest(projected)).norm();
  }
  findings.offer(Constraint::contact_polygon, beyond, place);
}

double beyond_sole(const Eigen::Vector2d& half, const Vector3d& normal, double yaw, const Vector3d& offset) {
  if (half.maxCoeff() <= 0.0 || offset.norm() == 0.0) return offset.norm();
  Vector3d d = sole_frame(normal, yaw).transpose() * offset;
  for (int i = 0; i < 2; ++i) d[i] = std::max(std::abs(d[i]) - half[i], 0.0);
  return d.norm();
}

}  // namespace

void check_contact_place(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const int surface = problem.surface(sample.phase, l);
    if (surface < 0) continue;
    offer_place(problem.solids[surface].polygon, sample.at.end_effectors[l].position_W,
                {sample.phase, l, sample.time_s}, findings);
  }
}

/// What touches down at the very end of the plan has no phase of its own.
void check_final_contact_place(const Problem& problem, const Sample& last, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const int surface = problem.plan.final_contacts[l];
    if (surface < 0) continue;
    offer_place(problem.solids[surface].polygon, last.at.end_effectors[l].position_W, {last.phase, l, last.time_s},
                findings);
  }
}

/// The surface admits the end-effector.
void check_contact_permission(const Problem& problem, Findings& findings) {
  for (int k = 0; k <= problem.phase_count(); ++k)
    for (int l = 0; l < problem.end_effector_count(); ++l) {
      const int surface = problem.surface(k, l);
      if (surface < 0) continue;
      const bool allowed = may_touch(problem.scene.surfaces[surface], problem.robot.end_effectors[l]);
      findings.offer(Constraint::contact_permission, allowed ? 0.0 : 1.0, problem.at_knot(k, l));
    }
}

/// The anchor s_l, or every point s at which a force acts, lies on the sole: |d_i| <= half_size_i along the sole and
/// d_n = 0, d = s - p_l. Otherwise the force would act on the robot where the robot does not touch anything.
void check_anchor(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const int surface = problem.surface(sample.phase, l);
    if (surface < 0) continue;
    const Contact& contact = problem.plan.phases[sample.phase].contacts[l];
    const Eigen::Vector2d& half = problem.robot.end_effectors[l].half_size;
    const Vector3d& normal = problem.solids[surface].polygon.normal_W();
    const Vector3d& position = sample.at.end_effectors[l].position_W;
    const Place place{sample.phase, l, sample.time_s};
    if (!problem.has_points(sample.phase))
      findings.offer(Constraint::anchor, beyond_sole(half, normal, sample.replay.rpy.z(), contact.anchor_W - position),
                     place);
    for (const Vector3d& point : contact.points_W)
      findings.offer(Constraint::anchor, beyond_sole(half, normal, sample.replay.rpy.z(), point - position), place);
  }
}

/// slip: |p(t) - p(touchdown)| while the end-effector stays on one surface, over as many phases as that lasts.
/// path_continuity: |p(knot, from the left) - p(knot, from the right)|.
void Travel::check(const Problem& problem, const Sample& sample, Findings& findings) {
  const int n = problem.end_effector_count();
  const bool first = phase_ < 0;
  if (first) {
    surface_.assign(n, -1);
    touched_W_.resize(n);
    last_W_.resize(n);
  }
  for (int l = 0; l < n; ++l) {
    const Vector3d& position = sample.at.end_effectors[l].position_W;
    const Place place{sample.phase, l, sample.time_s};
    if (!first && sample.phase != phase_)
      findings.offer(Constraint::path_continuity, (position - last_W_[l]).norm(), place);
    const int surface = problem.surface(sample.phase, l);
    if (surface >= 0) {
      if (surface != surface_[l]) touched_W_[l] = position;
      findings.offer(Constraint::slip, (position - touched_W_[l]).norm(), place);
    }
    surface_[l] = surface;
    last_W_[l] = position;
  }
  phase_ = sample.phase;
}

}  // namespace mcplan::checks
