#include "plan/point_forces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace mcplan {
namespace {

using Eigen::Vector3d;

/// Of one point, `fraction` of the way through an interval.
Vector3d force_of(const Phase& phase, const Contact& contact, std::size_t point, int interval, double fraction) {
  const std::size_t points = contact.points_W.size();
  const Vector3d& begin = contact.point_forces_W[interval * points + point];
  if (phase.law == ForceLaw::held) return begin;
  return begin + fraction * (contact.point_forces_W[(interval + 1) * points + point] - begin);
}

}  // namespace

CentroidalState integrate_interval(const CentroidalState& from, const Wrench& begin, const Wrench& end, double h,
                                   double mass, double gravity) {
  const Vector3d up = Vector3d::UnitZ();
  const Vector3d a0 = begin.force_W / mass - gravity * up, a1 = end.force_W / mass - gravity * up;
  const Vector3d& v0 = from.com_velocity_W;
  const Vector3d travel = h * v0 + h * h / 6.0 * (2.0 * a0 + a1);
  const Vector3d end_moment = end.moment_W - travel.cross(end.force_W);
  CentroidalState to;
  to.com_W = from.com_W + travel;
  to.com_velocity_W = v0 + 0.5 * h * (a0 + a1);
  to.angular_momentum_W = from.angular_momentum_W + 0.5 * h * (begin.moment_W + end_moment) -
                          mass * h * h / 6.0 * v0.cross(a0 - a1) + mass * h * h * h / 12.0 * a0.cross(a1) +
                          mass * gravity * h * h * h / 24.0 * (a0 + a1).cross(up);
  return to;
}

IntervalTime interval_time(const Phase& phase, double since_start) {
  constexpr double kRounding = 1e-9;
  const double length = phase.duration / phase.intervals;
  IntervalTime at;
  if (!(length > 0.0)) return at;  // of a duration that has no such part among the numbers
  const double whole = std::floor(since_start / length + kRounding);
  at.interval = static_cast<int>(std::clamp(whole, 0.0, phase.intervals - 1.0));
  at.since_s = std::clamp(since_start - at.interval * length, 0.0, length);
  at.fraction = at.since_s / length;
  return at;
}

std::vector<Vector3d> point_forces(const Phase& phase, const Contact& contact, const IntervalTime& at) {
  std::vector<Vector3d> forces(contact.points_W.size());
  for (std::size_t i = 0; i < forces.size(); ++i) forces[i] = force_of(phase, contact, i, at.interval, at.fraction);
  return forces;
}

Wrench wrench_at(const Phase& phase, const IntervalTime& at, const Vector3d& about_W) {
  Wrench sum;
  for (const Contact& contact : phase.contacts)
    for (std::size_t i = 0; i < contact.points_W.size(); ++i) {
      const Vector3d force = force_of(phase, contact, i, at.interval, at.fraction);
      sum.force_W += force;
      sum.moment_W += (contact.points_W[i] - about_W).cross(force);
    }
  return sum;
}

CentroidalState integrate_phase(const Phase& phase, const CentroidalState& from, double since_start, double mass,
                                double gravity) {
  const IntervalTime last = interval_time(phase, since_start);
  const double length = phase.duration / phase.intervals;
  CentroidalState state = from;
  for (int j = 0; j <= last.interval; ++j) {
    const IntervalTime end = j < last.interval ? IntervalTime{j, length, 1.0} : last;
    state = integrate_interval(state, wrench_at(phase, {j, 0.0, 0.0}, state.com_W), wrench_at(phase, end, state.com_W),
                               end.since_s, mass, gravity);
  }
  return state;
}

}  // namespace mcplan
