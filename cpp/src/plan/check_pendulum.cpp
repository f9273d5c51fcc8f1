#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "check_laws.hpp"

/// The pendulum: each contact gives f_l = m mu_l (p - s_l) at s_l, and a moment tau_l that the base follows.
namespace mcplan::checks {
namespace {

using Eigen::Vector3d;

double stiffness_of(const Phase& phase) {
  double stiffness = 0.0;
  for (const Contact& contact : phase.contacts) stiffness += contact.stiffness;
  return stiffness;
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
PendulumStep::PendulumStep(double stiffness, double h) {
  const int steps = static_cast<int>(std::clamp(std::ceil(std::sqrt(std::abs(stiffness)) * h / 0.004), 1.0, 64.0));
  for (int i = 0; i < 3; ++i) {
    Vector3d state(i == 0, i == 1, 0.0);
    const double f = i == 2;
    const auto rate = [&](const Vector3d& at) { return Vector3d(at[1], stiffness * at[0] - f, at[0]); };
    for (int k = 0; k < steps; ++k) {
      const double t = h / steps;
      const Vector3d a = rate(state), b = rate(state + 0.5 * t * a), c = rate(state + 0.5 * t * b);
      state += t / 6.0 * (a + 2.0 * b + 2.0 * c + rate(state + t * c));
    }
    for (int j = 0; j < 3; ++j) of_[i][j] = state[j];
  }
}

void set_forces_that_act_at(Vector3d Contact::*place_W, const Problem& problem, Sample& sample) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const Contact& contact = problem.plan.phases[sample.phase].contacts[l];
    sample.forces_W[l] = problem.robot.mass * contact.stiffness * (sample.replay.com_W - contact.anchor_W);
    if (contact.surface < 0) continue;
    sample.cone_forces_W[l].assign(1, sample.forces_W[l]);
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

/// p'' = sum_l f_l / m - g  with  f_l = m mu_l (p - s_l),  theta'' = I^-1 sum_l tau_l. Places are counted from where
/// the CoM is as the phase begins.
LawCheck<laws::Pendulum>::Integration::Integration(const Problem& problem, int phase, double h)
    : h_(h),
      step_(stiffness_of(problem.plan.phases[phase]), h),
      origin_W_(problem.plan.knots[phase].com_W),
      fall_(0.0, 0.0, problem.scene.gravity),
      spin_up_(Vector3d::Zero()) {
  for (const Contact& contact : problem.plan.phases[phase].contacts) {
    fall_ += contact.stiffness * (contact.anchor_W - origin_W_);
    spin_up_ += contact.moment_W.cwiseQuotient(problem.robot.inertia);
  }
}

void LawCheck<laws::Pendulum>::Integration::advance(Sample& sample) {
  Replay& replay = sample.replay;
  Vector3d com = replay.com_W - origin_W_;
  step_.apply(com, replay.com_velocity_W, fall_);
  replay.com_W = origin_W_ + com;
  replay.rpy += h_ * (replay.rpy_rate + 0.5 * h_ * spin_up_);
  replay.rpy_rate += h_ * spin_up_;
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
