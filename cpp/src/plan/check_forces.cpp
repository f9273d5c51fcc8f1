#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "check_internal.hpp"

namespace mcplan::checks {

using Eigen::Vector3d;

/// mu_l = 0 and tau_l = 0, exactly, and no points for an end-effector that touches nothing. The stiffness is reported
/// as the force it gives at the CoM height, the moment as it is. Where forces act at points, mu_l and tau_l would be
/// forces that move nothing: they are held to zero at contacts as well.
void check_free_force(const Problem& problem, Findings& findings) {
  for (int k = 0; k < problem.phase_count(); ++k)
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
  for (int k = 0; k < problem.phase_count(); ++k)
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
/// tangential force alone must be as small, and a pulling contact is left to `pull`. A corner that carries less than a
/// thousandth of the weight is measured against that thousandth: its excess counts by what it does to the robot.
void check_friction(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const int index = problem.surface(sample.phase, l);
    if (index < 0 || problem.scene.surfaces[index].grasp) continue;
    const Vector3d& n = problem.solids[index].polygon.normal_W();
    const double friction = problem.scene.surfaces[index].friction, least = problem.tolerances.force;
    const double unit =
        problem.has_points(sample.phase) ? std::max(least, 1e-3 * problem.robot.mass * problem.scene.gravity) : least;
    for (const Vector3d& force : sample.cone_forces_W[l]) {
      const double normal = n.dot(force), tangential = (force - normal * n).norm();
      if (normal < -least) continue;
      if (normal < least && tangential <= least) continue;
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
    findings.offer(Constraint::force_cap, sample.forces_W[l].norm() / cap - 1.0, {sample.phase, l, sample.time_s});
  }
}

/// |tau_i| <= max_moment_i about each world axis (contact wrenches: check_normal_moment).
void check_moment_cap(const Problem& problem, Findings& findings) {
  for (int k = 0; k < problem.phase_count(); ++k)
    for (int l = 0; l < problem.end_effector_count(); ++l) {
      const Contact& contact = problem.plan.phases[k].contacts[l];
      if (contact.surface < 0 || problem.has_wrenches(k)) continue;
      const Vector3d excess = contact.moment_W.cwiseAbs() - problem.robot.end_effectors[l].max_moment;
      findings.offer(Constraint::moment, largest(excess), problem.at_knot(k, l));
    }
}

/// The moment about the end-effector's own point, tau = tau_l + (s_l - p_l) x f, must come from pressure and friction
/// under the sole. With a the shorter half side (conservative: whatever way the sole points) and n the normal:
///
///     |tau - n (n . tau)| <= a (n . f)        the centre of pressure stays on the sole
///     |n . tau|           <= friction a (n . f)
///
/// A point contact and a grasp are held by max_moment alone. Forces at points need no such bound: the points lie on the
/// sole (`anchor`), and none pulls or slides.
void check_sole_moment(const Problem& problem, const Sample& sample, Findings& findings) {
  if (problem.has_wrenches(sample.phase)) return;  // check_torsion, check_center_of_pressure
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const int index = problem.surface(sample.phase, l);
    const double half = problem.robot.end_effectors[l].half_size.minCoeff();
    if (index < 0 || half <= 0.0 || problem.scene.surfaces[index].grasp || problem.has_points(sample.phase)) continue;
    const Contact& contact = problem.plan.phases[sample.phase].contacts[l];
    const Vector3d& n = problem.solids[index].polygon.normal_W();
    const Vector3d& force = sample.forces_W[l];
    const Vector3d moment = contact.moment_W + (contact.anchor_W - sample.at.end_effectors[l].position_W).cross(force);
    const double normal = std::max(n.dot(force), 0.0), torsion = n.dot(moment);
    const Place place{sample.phase, l, sample.time_s};
    findings.offer(Constraint::moment, (moment - torsion * n).norm() - half * normal, place);
    findings.offer(Constraint::moment, std::abs(torsion) - problem.scene.surfaces[index].friction * half * normal,
                   place);
  }
}

}  // namespace mcplan::checks
