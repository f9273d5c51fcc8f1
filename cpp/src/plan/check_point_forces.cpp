#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "check_internal.hpp"

namespace mcplan::checks {

using Eigen::Vector3d;

/// At the instant between two intervals the later one; a billionth of an interval is rounding.
int interval_of(const Phase& phase, double since_start) {
  // Compared before it is cut: of durations next to nothing it may be any number.
  return static_cast<int>(
      std::clamp(since_start * phase.intervals / phase.duration + 1e-9, 0.0, phase.intervals - 1.0));
}

/// held: f_j.  linear: (1 - s) f_j + s f_{j+1},  s = 0..1 over interval j.
Vector3d point_force(const Phase& phase, const Contact& contact, int point, int interval, double since_start) {
  const int points = static_cast<int>(contact.points_W.size());
  const Vector3d& begin = contact.point_forces_W[interval * points + point];
  if (phase.law == ForceLaw::held) return begin;
  const double s = since_start * phase.intervals / phase.duration - interval;
  return (1.0 - s) * begin + s * contact.point_forces_W[(interval + 1) * points + point];
}

/// p'' = sum_i f_i / m - g,  L' = sum_i (p_i - p) x f_i.
Replay point_force_rate(const Problem& problem, int phase, const Replay& state, int interval, double since_start) {
  const Phase& p = problem.plan.phases[phase];
  Replay rate{state.com_velocity_W, Vector3d(0.0, 0.0, -problem.scene.gravity), Vector3d::Zero(), Vector3d::Zero(),
              Vector3d::Zero()};
  for (const Contact& contact : p.contacts)
    for (std::size_t i = 0; i < contact.points_W.size(); ++i) {
      const Vector3d force = point_force(p, contact, static_cast<int>(i), interval, since_start);
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

}  // namespace mcplan::checks
