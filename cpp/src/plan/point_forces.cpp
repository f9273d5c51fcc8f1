#include "plan/point_forces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <variant>

namespace mcplan {
namespace {

using Eigen::Vector3d;

/// Of one point.
template <class Law>
Vector3d force_of(const Law& law, const Contact& contact, std::size_t point, const IntervalTime& at) {
  if constexpr (Law::has_points) {
    const std::size_t points = contact.points_W.size();
    return law.point_force_W(&contact.point_forces_W[at.interval * points + point], points, at.fraction);
  } else {
    return Vector3d::Zero();
  }
}

template <class Law>
Wrench resultant(const Law& law, const Phase& phase, const IntervalTime& at, const Vector3d& about_W) {
  Wrench sum;
  for (const Contact& contact : phase.contacts)
    for (std::size_t i = 0; i < contact.points_W.size(); ++i) {
      const Vector3d force = force_of(law, contact, i, at);
      sum.force_W += force;
      sum.moment_W += (contact.points_W[i] - about_W).cross(force);
    }
  return sum;
}

template <class Law>
CentroidalState integrate(const Law& law, const Phase& phase, const CentroidalState& from, double since_start,
                          double mass, double gravity) {
  const IntervalTime last = interval_time(phase, since_start);
  const double length = phase.duration / phase.intervals;
  CentroidalState state = from;
  for (int j = 0; j <= last.interval; ++j) {
    const IntervalTime end = j < last.interval ? IntervalTime{j, length, 1.0} : last;
    state = integrate_interval(state, resultant(law, phase, {j, 0.0, 0.0}, state.com_W),
                               resultant(law, phase, end, state.com_W), end.since_s, mass, gravity);
  }
  return state;
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
  std::visit(
      [&](auto law) {
        for (std::size_t i = 0; i < forces.size(); ++i) forces[i] = force_of(law, contact, i, at);
      },
      phase.law);
  return forces;
}

Wrench wrench_at(const Phase& phase, const IntervalTime& at, const Vector3d& about_W) {
  return std::visit([&](auto law) { return resultant(law, phase, at, about_W); }, phase.law);
}

CentroidalState integrate_phase(const Phase& phase, const CentroidalState& from, double since_start, double mass,
                                double gravity) {
  return std::visit([&](auto law) { return integrate(law, phase, from, since_start, mass, gravity); }, phase.law);
}

}  // namespace mcplan
