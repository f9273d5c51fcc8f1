#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "check_laws.hpp"

namespace mcplan::checks {

using Eigen::Vector3d;

/// mu_l = 0 and tau_l = 0, exactly, and no points for an end-effector that touches nothing. The stiffness is reported
/// as the force it gives at the CoM height, the moment as it is. Where forces act at points, mu_l and tau_l would be
/// forces that move nothing: they are held to zero at contacts as well.
void check_free_force(const Problem& problem, Findings& findings) {
  for (int k = 0; k < problem.end_phase; ++k)
    for (int l = 0; l < problem.end_effector_count(); ++l) {
      const Contact& contact = problem.plan.phases[k].contacts[l];
      const bool free = contact.surface < 0;
      if (!free && !problem.has_points(k)) continue;
      const Place place = problem.at_knot(k, l);
      const double force = problem.robot.mass * std::abs(contact.stiffness) * problem.robot.com_height;
      findings.offer(Constraint::free_force, force, place);
      findings.offer(Constraint::free_force, contact.moment_W.norm(), place, 0.0, "N m");
      if (free) findings.offer(Constraint::free_force, contact.points_W.size(), place, 0.0, "points");
    }
}

/// mu_l >= 0: a negative stiffness would pull.
void check_stiffness_sign(const Problem& problem, Findings& findings) {
  for (int k = 0; k < problem.end_phase; ++k)
    for (int l = 0; l < problem.end_effector_count(); ++l)
      findings.offer(Constraint::stiffness_sign, 0.0 - problem.plan.phases[k].contacts[l].stiffness,
                     problem.at_knot(k, l));
}

/// n . f >= 0, of every force at a point where there are such.
void check_pull(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const int surface = problem.surface(sample.phase, l);
    if (surface < 0 || problem.scene.surfaces[surface].grasp) continue;
    const Vector3d& n = problem.solids[surface].polygon.normal_W();
    for (const Vector3d& force : sample.cone_forces_W[l])
      findings.offer(Constraint::pull, 0.0 - n.dot(force), {sample.phase, l, sample.time_s});
  }
}

/// |f - n (n . f)| / (n . f) - friction <= 0, a circular cone, for every force at a point where there are such; their
/// sum is then in the cone too, which is convex. Below the force tolerance the quotient means nothing: there the
/// tangential force alone must be as small, and a pulling contact is left to `pull`. The law says by what a smaller
/// force is measured.
void check_friction(const Problem& problem, const Sample& sample, Findings& findings) {
  const double unit = with_law(problem, sample.phase, [&](auto law) { return law.min_normal(problem); });
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const int index = problem.surface(sample.phase, l);
    if (index < 0 || problem.scene.surfaces[index].grasp) continue;
    const Vector3d& n = problem.solids[index].polygon.normal_W();
    const double friction = problem.scene.surfaces[index].friction, min_force = problem.tolerances.force;
    for (const Vector3d& force : sample.cone_forces_W[l]) {
      const double normal = n.dot(force), squared = (force - normal * n).squaredNorm();
      if (normal < -min_force) continue;
      const double kept = friction * normal + findings.kept(Constraint::friction) * std::max(normal, unit);
      if (normal >= min_force && kept > 0.0 && squared < kept * kept * kBelow) continue;
      const double tangential = std::sqrt(squared);
      if (normal < min_force && tangential <= min_force) continue;
      findings.offer(Constraint::friction, (tangential - friction * normal) / std::max(normal, unit),
                     {sample.phase, l, sample.time_s});
    }
  }
}

/// |f| / max_force - 1 <= 0.
void check_force_cap(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const double cap = problem.robot.end_effectors[l].max_force;
    if (problem.surface(sample.phase, l) < 0 || !std::isfinite(cap)) continue;
    const double kept = cap * (1.0 + findings.kept(Constraint::force_cap));
    if (kept > 0.0 && sample.forces_W[l].squaredNorm() < kept * kept * kBelow) continue;
    findings.offer(Constraint::force_cap, sample.forces_W[l].norm() / cap - 1.0, {sample.phase, l, sample.time_s});
  }
}

/// |L_j| / momentum_max - 1 <= 0 and |L'_j| / momentum_rate_max - 1 <= 0, j the axes of the start's heading, where the
/// plan claims to keep such limits:  L' = sum_l ((p_l - p) x f_l + tau_l).
void check_momentum(const Problem& problem, const Sample& sample, Findings& findings) {
  const double max = problem.plan.momentum_max, rate_max = problem.plan.momentum_rate_max;
  if (std::isinf(max) && std::isinf(rate_max)) return;
  Vector3d rate = Vector3d::Zero();
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    if (problem.surface(sample.phase, l) < 0) continue;
    const Vector3d arm = sample.at.end_effectors[l].position_W - sample.replay.com_W;
    rate += arm.cross(sample.forces_W[l]) + sample.moments_W[l];
  }
  const Eigen::Matrix3d to_heading = Eigen::AngleAxisd(-problem.scene.start.yaw, Vector3d::UnitZ()).toRotationMatrix();
  const auto offer = [&](const Vector3d& value_W, double limit) {
    if (std::isinf(limit)) return;
    findings.offer(Constraint::angular_momentum, largest((to_heading * value_W).cwiseAbs()) / limit - 1.0,
                   {sample.phase, -1, sample.time_s});
  };
  offer(sample.at.angular_momentum_W, max);
  offer(rate, rate_max);
}

}  // namespace mcplan::checks
