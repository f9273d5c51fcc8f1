#include <algorithm>
#include <cmath>

#include "check_internal.hpp"

namespace mcplan::checks {
namespace {

using Eigen::Vector3d;

/// p'' = sum_l f_l / m - g  with  f_l = m mu_l (p - s_l),  theta'' = I^-1 sum_l tau_l.
Replay rate(const Problem& problem, int phase, const Replay& state) {
  Vector3d acceleration(0.0, 0.0, -problem.scene.gravity), moment = Vector3d::Zero();
  for (const Contact& contact : problem.plan.phases[phase].contacts) {
    acceleration += contact.stiffness * (state.com_W - contact.anchor_W);
    moment += contact.moment_W;
  }
  return {state.com_velocity_W, acceleration, state.rpy_rate, moment.cwiseQuotient(problem.robot.inertia)};
}

Replay add(const Replay& state, double h, const Replay& slope) {
  return {state.com_W + h * slope.com_W, state.com_velocity_W + h * slope.com_velocity_W, state.rpy + h * slope.rpy,
          state.rpy_rate + h * slope.rpy_rate};
}

Replay rk4(const Problem& problem, int phase, const Replay& from, double h) {
  const Replay a = rate(problem, phase, from);
  const Replay b = rate(problem, phase, add(from, 0.5 * h, a));
  const Replay c = rate(problem, phase, add(from, 0.5 * h, b));
  const Replay d = rate(problem, phase, add(from, h, c));
  return add(add(add(add(from, h / 6.0, a), h / 3.0, b), h / 3.0, c), h / 6.0, d);
}

/// Largest difference of two states among its four parts, each in its own unit.
void offer_difference(Constraint constraint, const Replay& a, const Replay& b, const Place& place, double tolerance,
                      Findings& findings) {
  const auto offer = [&](const Vector3d& x, const Vector3d& y, const char* unit) {
    findings.offer(constraint, largest((x - y).cwiseAbs()), place, tolerance, unit);
  };
  offer(a.com_W, b.com_W, "m");
  offer(a.com_velocity_W, b.com_velocity_W, "m/s");
  offer(a.rpy, b.rpy, "rad");
  offer(a.rpy_rate, b.rpy_rate, "rad/s");
}

}  // namespace

Replay advance(const Problem& problem, int phase, const Replay& from, double h) {
  double stiffness = 0.0;
  for (const Contact& contact : problem.plan.phases[phase].contacts) stiffness += std::abs(contact.stiffness);
  // A step errs by (sqrt(stiffness) h)^5 / 120 of the motion: 1e-14 at 0.004, so 1e-11 over a second of such steps.
  const double wanted = std::ceil(std::sqrt(stiffness) * h / 0.004);
  const int steps = static_cast<int>(std::clamp(wanted, 1.0, 64.0));
  Replay state = from;
  for (int i = 0; i < steps; ++i) state = rk4(problem, phase, state, h / steps);
  return state;
}

void contact_forces(const Problem& problem, Sample& sample) {
  sample.forces_W.resize(problem.end_effector_count());
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const Contact& contact = problem.plan.phases[sample.phase].contacts[l];
    sample.forces_W[l] = problem.robot.mass * contact.stiffness * (sample.replay.com_W - contact.anchor_W);
  }
}

/// The state integrated over the phase is the next knot.
void check_dynamics(const Problem& problem, const Sample& phase_end, Findings& findings) {
  const Knot& next = problem.plan.knots[phase_end.phase + 1];
  offer_difference(Constraint::dynamics, phase_end.replay,
                   {next.com_W, next.com_velocity_W, next.base_rpy, next.base_rpy_rate},
                   {phase_end.phase, -1, phase_end.time_s}, problem.tolerances.dynamics, findings);
}

/// What the plan says of an instant is what the integration says; forces are compared in units of the weight.
void check_at_consistency(const Problem& problem, const Sample& sample, Findings& findings) {
  const PlanState& at = sample.at;
  offer_difference(Constraint::at_consistency, sample.replay,
                   {at.com_W, at.com_velocity_W, at.base_rpy, at.base_rpy_rate}, {sample.phase, -1, sample.time_s},
                   problem.tolerances.dynamics, findings);
  const double weight = problem.robot.mass * problem.scene.gravity;
  for (int l = 0; l < problem.end_effector_count(); ++l)
    findings.offer(Constraint::at_consistency,
                   largest((at.end_effectors[l].force_W - sample.forces_W[l]).cwiseAbs()) / weight,
                   {sample.phase, l, sample.time_s}, problem.tolerances.dynamics, "of the weight");
}

}  // namespace mcplan::checks
