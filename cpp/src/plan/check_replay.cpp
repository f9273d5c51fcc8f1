#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "check_internal.hpp"
#include "mcplan/base/rotation.hpp"

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
  return {state.com_velocity_W, acceleration, state.rpy_rate, moment.cwiseQuotient(problem.robot.inertia),
          Vector3d::Zero()};
}

Replay add(const Replay& state, double h, const Replay& slope) {
  return {state.com_W + h * slope.com_W,
          state.com_velocity_W + h * slope.com_velocity_W,
          state.rpy + h * slope.rpy,
          state.rpy_rate + h * slope.rpy_rate,
          state.momentum_W + h * slope.momentum_W,
          state.quat_wxyz + h * slope.quat_wxyz};
}

/// slope(t, state), t = 0..h.
template <class Slope>
Replay rk4(const Replay& from, double h, const Slope& slope) {
  const Replay a = slope(0.0, from);
  const Replay b = slope(0.5 * h, add(from, 0.5 * h, a));
  const Replay c = slope(0.5 * h, add(from, 0.5 * h, b));
  const Replay d = slope(h, add(from, h, c));
  return add(add(add(add(from, h / 6.0, a), h / 3.0, b), h / 3.0, c), h / 6.0, d);
}

/// Largest difference of two states among its five parts, each in its own unit; where momentum turns the base, the
/// angles are another constraint's.
void offer_difference(Constraint constraint, const Replay& a, const Replay& b, bool angles, const Place& place,
                      const Problem& problem, Findings& findings) {
  const Similarity& size = problem.similarity;
  const auto offer = [&](const Vector3d& x, const Vector3d& y, double factor, const char* unit) {
    findings.offer(constraint, largest((x - y).cwiseAbs()), place, problem.tolerances.dynamics * factor, unit);
  };
  offer(a.com_W, b.com_W, size.length, "m");
  offer(a.com_velocity_W, b.com_velocity_W, size.velocity(), "m/s");
  offer(a.momentum_W, b.momentum_W, size.angular_momentum(), "kg m^2/s");
  if (!angles) return;
  offer(a.rpy, b.rpy, 1.0, "rad");
  offer(a.rpy_rate, b.rpy_rate, size.rate(), "rad/s");
}

Replay advance_pendulum(const Problem& problem, int phase, const Replay& from, double h) {
  double stiffness = 0.0;
  for (const Contact& contact : problem.plan.phases[phase].contacts) stiffness += std::abs(contact.stiffness);
  // A step errs by (sqrt(stiffness) h)^5 / 120 of the motion: 1e-14 at 0.004, so 1e-11 over a second of such steps.
  double wanted = std::ceil(std::sqrt(stiffness) * h / 0.004);
  const bool wrenches = problem.has_wrenches(phase);
  // The same of the base, which turns by h |omega|: 1e-8 rad a second at 0.02.
  if (wrenches)
    wanted = std::max(wanted, std::ceil(from.momentum_W.norm() / problem.robot.inertia.minCoeff() * h / 0.02));
  const int steps = static_cast<int>(std::clamp(wanted, 1.0, 64.0));
  Replay state = from;
  for (int i = 0; i < steps; ++i) {
    state = rk4(state, h / steps, [&](double, const Replay& at) {
      return wrenches ? wrench_rate(problem, phase, at) : rate(problem, phase, at);
    });
    if (wrenches) set_angles(state);
  }
  return state;
}

/// Within an interval the CoM is cubic in time and L of degree 4, which one step of RK4 follows without error, however
/// long: the stages' own errors in p are parallel to the forces' slope and cancel. Rounding alone is left, 1e-13 kg
/// m^2/s a step.
Replay advance_point_forces(const Problem& problem, int phase, const Replay& from, double since_start, double h) {
  const int interval = interval_of(problem.plan.phases[phase], since_start + 0.5 * h);
  Replay to = rk4(from, h, [&](double t, const Replay& at) {
    return point_force_rate(problem, phase, at, interval, since_start + t);
  });
  turn_base(problem, phase, since_start + h, to);
  return to;
}

/// Of a contact about the end-effector, where it is at that instant.
Vector3d moment_about_end(const Problem& problem, const Sample& sample, int l) {
  const Phase& phase = problem.plan.phases[sample.phase];
  const Contact& contact = phase.contacts[l];
  const Vector3d& position = sample.at.end_effectors[l].position_W;
  const Vector3d& acts_at = phase.law == ForceLaw::wrench ? contact.center_of_pressure_W : contact.anchor_W;
  if (!problem.has_points(sample.phase)) return contact.moment_W + (acts_at - position).cross(sample.forces_W[l]);
  Vector3d moment = Vector3d::Zero();
  for (std::size_t i = 0; i < contact.points_W.size(); ++i)
    moment += (contact.points_W[i] - position).cross(sample.cone_forces_W[l][i]);
  return moment;
}

}  // namespace

int sample_count(const Problem& problem, int phase) {
  const Phase& p = problem.plan.phases[phase];
  const int pieces = std::max(1, p.intervals);
  return pieces * std::max(1, static_cast<int>(std::ceil(p.duration / pieces / problem.tolerances.sample_s)));
}

Replay start_of(const Problem& problem, int phase) {
  const Knot& knot = problem.plan.knots[phase];
  const Vector3d zero = Vector3d::Zero();
  Replay state{knot.com_W, knot.com_velocity_W, knot.base_rpy, knot.base_rpy_rate,
               problem.has_momentum(phase) ? knot.angular_momentum_W : zero};
  if (!problem.has_wrenches(phase)) return state;
  state.rpy_rate = zero;
  state.quat_wxyz = quat_wxyz_from_rpy(knot.base_rpy);
  return state;
}

Replay advance(const Problem& problem, int phase, const Replay& from, double since_start, double h) {
  return problem.has_points(phase) ? advance_point_forces(problem, phase, from, since_start, h)
                                   : advance_pendulum(problem, phase, from, h);
}

void contact_forces(const Problem& problem, Sample& sample) {
  const Phase& phase = problem.plan.phases[sample.phase];
  sample.forces_W.resize(problem.end_effector_count());
  sample.cone_forces_W.resize(problem.end_effector_count());
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const Contact& contact = phase.contacts[l];
    if (!problem.has_points(sample.phase)) {
      sample.forces_W[l] = problem.robot.mass * contact.stiffness * (sample.replay.com_W - contact.anchor_W);
      sample.cone_forces_W[l] = {sample.forces_W[l]};
      continue;
    }
    sample.forces_W[l].setZero();
    sample.cone_forces_W[l].resize(contact.points_W.size());
    const int interval = interval_of(phase, sample.since_start_s);
    for (std::size_t i = 0; i < contact.points_W.size(); ++i) {
      sample.cone_forces_W[l][i] = point_force(phase, contact, static_cast<int>(i), interval, sample.since_start_s);
      sample.forces_W[l] += sample.cone_forces_W[l][i];
    }
  }
}

/// The state integrated over the phase is the next knot.
void check_dynamics(const Problem& problem, const Sample& phase_end, Findings& findings) {
  const Knot& next = problem.plan.knots[phase_end.phase + 1];
  const bool wrenches = problem.has_wrenches(phase_end.phase);
  offer_difference(Constraint::dynamics, phase_end.replay,
                   {next.com_W, next.com_velocity_W, next.base_rpy, next.base_rpy_rate,
                    problem.has_momentum(phase_end.phase) ? next.angular_momentum_W : phase_end.replay.momentum_W},
                   !wrenches, {phase_end.phase, -1, phase_end.time_s}, problem, findings);
  if (!wrenches) return;
  check_turning_rate(problem, phase_end.phase, findings);
  check_orientation_at_knot(problem, phase_end, findings);
}

/// What the plan says of an instant is what the integration says; forces are compared in units of the weight, moments
/// in those of the weight at a metre.
void check_at_consistency(const Problem& problem, const Sample& sample, Findings& findings) {
  const PlanState& at = sample.at;
  offer_difference(Constraint::at_consistency, sample.replay,
                   {at.com_W, at.com_velocity_W, at.base_rpy, at.base_rpy_rate,
                    problem.has_momentum(sample.phase) ? at.angular_momentum_W : sample.replay.momentum_W},
                   !problem.has_wrenches(sample.phase), {sample.phase, -1, sample.time_s}, problem, findings);
  if (problem.has_wrenches(sample.phase)) check_at_wrenches(problem, sample, findings);
  const double weight = problem.robot.mass * problem.scene.gravity;
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const Place place{sample.phase, l, sample.time_s};
    const EndEffectorState& end = at.end_effectors[l];
    findings.offer(Constraint::at_consistency, largest((end.force_W - sample.forces_W[l]).cwiseAbs()) / weight, place,
                   problem.tolerances.dynamics, "of the weight");
    if (problem.surface(sample.phase, l) < 0) continue;
    const Vector3d moment = moment_about_end(problem, sample, l);
    findings.offer(Constraint::at_consistency, largest((end.moment_W - moment).cwiseAbs()) / weight, place,
                   problem.tolerances.dynamics * problem.similarity.length, "m of the weight");
  }
}

}  // namespace mcplan::checks
