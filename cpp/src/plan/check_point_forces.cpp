#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "check_laws.hpp"

/// The laws with forces at points, evaluated once more and without the plan's own code.
namespace mcplan::checks {
namespace {

using Eigen::Vector3d;

/// At the instant between two intervals the later one; a billionth of an interval is rounding.
int interval_of(const Phase& phase, double since_start) {
  // Compared before it is cut: of durations next to nothing it may be any number.
  return static_cast<int>(
      std::clamp(since_start * phase.intervals / phase.duration + 1e-9, 0.0, phase.intervals - 1.0));
}

/// f_j
Vector3d point_force(laws::Held /*law*/, const Phase& /*phase*/, const Contact& contact, int point, int interval,
                     double /*since_start*/) {
  return contact.point_forces_W[interval * static_cast<int>(contact.points_W.size()) + point];
}

/// (1 - s) f_j + s f_{j+1},  s = 0..1 over interval j
Vector3d point_force(laws::Linear /*law*/, const Phase& phase, const Contact& contact, int point, int interval,
                     double since_start) {
  const int points = static_cast<int>(contact.points_W.size());
  const double s = since_start * phase.intervals / phase.duration - interval;
  return (1.0 - s) * contact.point_forces_W[interval * points + point] +
         s * contact.point_forces_W[(interval + 1) * points + point];
}

/// p'' = sum_i f_i / m - g,  L' = sum_i (p_i - p) x f_i.
template <class Law>
Replay point_force_rate(const Problem& problem, int phase, const Replay& state, int interval, double since_start) {
  const Phase& p = problem.plan.phases[phase];
  Replay rate{state.com_velocity_W, Vector3d(0.0, 0.0, -problem.scene.gravity), Vector3d::Zero(), Vector3d::Zero(),
              Vector3d::Zero()};
  for (const Contact& contact : p.contacts)
    for (std::size_t i = 0; i < contact.points_W.size(); ++i) {
      const Vector3d force = point_force(Law(), p, contact, static_cast<int>(i), interval, since_start);
      rate.com_velocity_W += force / problem.robot.mass;
      rate.momentum_W += (contact.points_W[i] - state.com_W).cross(force);
    }
  return rate;
}

/// theta = theta_0 + h theta'_0 s + s^3 (A + B s + C s^2), s = t / h: the quintic without acceleration at its ends,
/// whose rate and value at s = 1 are the next knot's. There is nothing to integrate; the limbs carry the rest of L.
void turn_base(const Problem& problem, int phase, double since_start, Replay& state) {
  const Knot &from = problem.plan.knots[phase], &to = problem.plan.knots[phase + 1];
  const double h = problem.plan.phases[phase].duration, s = since_start / h;
  const Vector3d drift = h * from.base_rpy_rate, turn = to.base_rpy - from.base_rpy - drift,
                 spin_up = h * to.base_rpy_rate - drift;
  const Vector3d a = 10.0 * turn - 4.0 * spin_up, b = 7.0 * spin_up - 15.0 * turn, c = 6.0 * turn - 3.0 * spin_up;
  state.rpy = from.base_rpy + s * drift + s * s * s * (a + s * (b + s * c));
  state.rpy_rate = (drift + s * s * (3.0 * a + s * (4.0 * b + s * 5.0 * c))) / h;
}

}  // namespace

template <class Law>
Replay PointForceCheck<Law>::start(const Problem& problem, int phase) {
  const Knot& knot = problem.plan.knots[phase];
  return {knot.com_W, knot.com_velocity_W, knot.base_rpy, knot.base_rpy_rate, knot.angular_momentum_W};
}

/// Within an interval the CoM is cubic in time and L of degree 4, which one step of RK4 follows without error, however
/// long: the stages' own errors in p are parallel to the forces' slope and cancel. Rounding alone is left, 1e-13 kg
/// m^2/s a step.
template <class Law>
void PointForceCheck<Law>::Integration::advance(Sample& sample) {
  const double since_start = sample.since_start_s;
  const int interval = interval_of(problem_.plan.phases[phase_], since_start + 0.5 * h_);
  sample.replay = rk4(sample.replay, h_, [&](double t, const Replay& at) {
    return point_force_rate<Law>(problem_, phase_, at, interval, since_start + t);
  });
  turn_base(problem_, phase_, since_start + h_, sample.replay);
}

template <class Law>
void PointForceCheck<Law>::set_forces(const Problem& problem, Sample& sample) {
  const Phase& phase = problem.plan.phases[sample.phase];
  const int interval = interval_of(phase, sample.since_start_s);
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const Contact& contact = phase.contacts[l];
    sample.forces_W[l].setZero();
    sample.moments_W[l].setZero();
    sample.cone_forces_W[l].resize(contact.points_W.size());
    for (std::size_t i = 0; i < contact.points_W.size(); ++i) {
      const Vector3d force = point_force(Law(), phase, contact, static_cast<int>(i), interval, sample.since_start_s);
      sample.cone_forces_W[l][i] = force;
      sample.forces_W[l] += force;
      sample.moments_W[l] += (contact.points_W[i] - sample.at.end_effectors[l].position_W).cross(force);
    }
  }
}

/// A corner that carries less than a thousandth of the weight is measured against that thousandth: its excess counts by
/// what it does to the robot.
template <class Law>
double PointForceCheck<Law>::min_normal(const Problem& problem) {
  return std::max(problem.tolerances.force, 1e-3 * problem.robot.mass * problem.scene.gravity);
}

template <class Law>
void PointForceCheck<Law>::check_numbers(const Problem& problem, int phase, Findings& findings) {
  check_moment_cap(problem, phase, findings);
}

/// Every point at which a force acts lies on the sole. The forces' moments need no bound of their own: none pulls or
/// slides.
template <class Law>
void PointForceCheck<Law>::check_bounds(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const int surface = problem.surface(sample.phase, l);
    if (surface < 0) continue;
    const double yaw = sole_yaw(problem, sample, l);
    for (const Vector3d& point : problem.plan.phases[sample.phase].contacts[l].points_W)
      findings.offer(Constraint::anchor,
                     beyond_sole(problem.robot.end_effectors[l].half_size, problem.solids[surface].polygon.normal_W(),
                                 yaw, point - sample.at.end_effectors[l].position_W),
                     {sample.phase, l, sample.time_s});
  }
}

template struct PointForceCheck<laws::Held>;
template struct PointForceCheck<laws::Linear>;

}  // namespace mcplan::checks
