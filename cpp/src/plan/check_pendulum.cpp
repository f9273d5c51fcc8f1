#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "check_laws.hpp"

/// The pendulum: each contact gives f_l = m mu_l (p - s_l) at s_l, and a moment tau_l that the base follows.
namespace mcplan::checks {
namespace {

using Eigen::Vector3d;

/// p'' = sum_l f_l / m - g  with  f_l = m mu_l (p - s_l),  theta'' = I^-1 sum_l tau_l.
Replay pendulum_rate(const Problem& problem, int phase, const Replay& state) {
  Vector3d acceleration(0.0, 0.0, -problem.scene.gravity), moment = Vector3d::Zero();
  for (const Contact& contact : problem.plan.phases[phase].contacts) {
    acceleration += contact.stiffness * (state.com_W - contact.anchor_W);
    moment += contact.moment_W;
  }
  return {state.com_velocity_W, acceleration, state.rpy_rate, moment.cwiseQuotient(problem.robot.inertia),
          Vector3d::Zero()};
}

/// The anchor s_l lies on the sole: |d_i| <= half_size_i along the sole and d_n = 0, d = s - p_l. Otherwise the force
/// would act on the robot where the robot does not touch anything.
void check_anchor(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const int surface = problem.surface(sample.phase, l);
    if (surface < 0) continue;
    const Vector3d& anchor = problem.plan.phases[sample.phase].contacts[l].anchor_W;
    findings.offer(Constraint::anchor,
                   beyond_sole(problem.robot.end_effectors[l].half_size, problem.solids[surface].polygon.normal_W(),
                               sole_yaw(problem, sample, l), anchor - sample.at.end_effectors[l].position_W),
                   {sample.phase, l, sample.time_s});
  }
}

/// The moment about the end-effector's own point, tau = tau_l + (s_l - p_l) x f, must come from pressure and friction
/// under the sole. With a the shorter half side (conservative: whatever way the sole points) and n the normal:
///
///     |tau - n (n . tau)| <= a (n . f)        the centre of pressure stays on the sole
///     |n . tau|           <= friction a (n . f)
///
/// A point contact and a grasp are held by max_moment alone.
void check_sole_moment(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const int index = problem.surface(sample.phase, l);
    const double half = problem.robot.end_effectors[l].half_size.minCoeff();
    if (index < 0 || half <= 0.0 || problem.scene.surfaces[index].grasp) continue;
    const Vector3d& n = problem.solids[index].polygon.normal_W();
    const Vector3d& moment = sample.moments_W[l];
    const double normal = std::max(n.dot(sample.forces_W[l]), 0.0), torsion = n.dot(moment);
    const Place place{sample.phase, l, sample.time_s};
    findings.offer(Constraint::moment, (moment - torsion * n).norm() - half * normal, place);
    findings.offer(Constraint::moment, std::abs(torsion) - problem.scene.surfaces[index].friction * half * normal,
                   place);
  }
}

}  // namespace

/// A step errs by (sqrt(stiffness) h)^5 / 120 of the motion: 1e-14 at 0.004, so 1e-11 over a second of such steps.
double stiffness_steps(const Problem& problem, int phase, double h) {
  double stiffness = 0.0;
  for (const Contact& contact : problem.plan.phases[phase].contacts) stiffness += std::abs(contact.stiffness);
  return std::ceil(std::sqrt(stiffness) * h / 0.004);
}

void set_forces_that_act_at(Vector3d Contact::*place_W, const Problem& problem, Sample& sample) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const Contact& contact = problem.plan.phases[sample.phase].contacts[l];
    sample.forces_W[l] = problem.robot.mass * contact.stiffness * (sample.replay.com_W - contact.anchor_W);
    sample.cone_forces_W[l] = {sample.forces_W[l]};
    const Vector3d arm = contact.*place_W - sample.at.end_effectors[l].position_W;
    sample.moments_W[l] = contact.moment_W + arm.cross(sample.forces_W[l]);
  }
}

void check_moment_cap(const Problem& problem, int phase, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const Contact& contact = problem.plan.phases[phase].contacts[l];
    if (contact.surface < 0) continue;
    const Vector3d excess = contact.moment_W.cwiseAbs() - problem.robot.end_effectors[l].max_moment;
    findings.offer(Constraint::moment, largest(excess), problem.at_knot(phase, l));
  }
}

Replay LawCheck<laws::Pendulum>::start(const Problem& problem, int phase) {
  const Knot& knot = problem.plan.knots[phase];
  return {knot.com_W, knot.com_velocity_W, knot.base_rpy, knot.base_rpy_rate, Vector3d::Zero()};
}

Replay LawCheck<laws::Pendulum>::advance(const Problem& problem, int phase, const Replay& from, double /*since_start*/,
                                         double h) {
  const int steps = static_cast<int>(std::clamp(stiffness_steps(problem, phase, h), 1.0, 64.0));
  Replay state = from;
  for (int i = 0; i < steps; ++i)
    state = rk4(state, h / steps, [&](double, const Replay& at) { return pendulum_rate(problem, phase, at); });
  return state;
}

void LawCheck<laws::Pendulum>::set_forces(const Problem& problem, Sample& sample) {
  set_forces_that_act_at(&Contact::anchor_W, problem, sample);
}

void LawCheck<laws::Pendulum>::check_numbers(const Problem& problem, int phase, Findings& findings) {
  check_moment_cap(problem, phase, findings);
}

void LawCheck<laws::Pendulum>::check_bounds(const Problem& problem, const Sample& sample, Findings& findings) {
  check_anchor(problem, sample, findings);
  check_sole_moment(problem, sample, findings);
}

}  // namespace mcplan::checks
