#pragma once

#include <Eigen/Core>
#include <vector>

#include "mcplan/plan/plan.hpp"

namespace mcplan {

/// CoM and the angular momentum about it: what forces at points move.
struct CentroidalState {
  Eigen::Vector3d com_W = Eigen::Vector3d::Zero();               ///< [m]
  Eigen::Vector3d com_velocity_W = Eigen::Vector3d::Zero();      ///< [m/s]
  Eigen::Vector3d angular_momentum_W = Eigen::Vector3d::Zero();  ///< [kg m^2/s]
};

/// Resultant of forces f_i at points p_i.
struct Wrench {
  Eigen::Vector3d force_W = Eigen::Vector3d::Zero();   ///< sum f_i [N]
  Eigen::Vector3d moment_W = Eigen::Vector3d::Zero();  ///< sum (p_i - a) x f_i [N m] about a point a
};

/// Advance by h [s] under forces at fixed points that go linearly from `begin` to `end`, both with moments about
/// from.com_W. With a_0, a_1 the CoM's accelerations and R_0, R_1 = sum (p_i - c) x f_i at the two ends,
///
///     c_1 = c_0 + h v_0 + h^2/6 (2 a_0 + a_1),    v_1 = v_0 + h/2 (a_0 + a_1)
///     L_1 = L_0 + h/2 (R_0 + R_1) - m h^2/6 v_0 x (a_0 - a_1) + m h^3/12 a_0 x a_1 + m g h^3/24 (a_0 + a_1) x e_z
///
/// without error: c is cubic in time, and L of degree 4 because the fastest terms of (p_i - c) x f_i are parallel.
/// Gravity g [m/s^2] acts along -e_z.
CentroidalState integrate_interval(const CentroidalState& from, const Wrench& begin, const Wrench& end, double h,
                                   double mass, double gravity);

/// An instant of a phase with forces at points.
struct IntervalTime {
  int interval = 0;       ///< in which it lies, 0 .. intervals - 1
  double since_s = 0.0;   ///< [s] since that interval began
  double fraction = 0.0;  ///< the same over the interval's length, 0..1
};

/// Which interval an instant belongs to: at the instant between two the later one (the last at the phase's end). A
/// billionth of an interval counts as rounding.
IntervalTime interval_time(const Phase& phase, double since_start);

/// Forces [N] of a contact's points at an instant: constant (held) or interpolated (linear) over the interval.
std::vector<Eigen::Vector3d> point_forces(const Phase& phase, const Contact& contact, const IntervalTime& at);

/// Resultant of all contacts' forces at an instant, moment about about_W.
Wrench wrench_at(const Phase& phase, const IntervalTime& at, const Eigen::Vector3d& about_W);

/// State `since_start` [s] after the phase began in `from`: the intervals before in full, then a part of one.
CentroidalState integrate_phase(const Phase& phase, const CentroidalState& from, double since_start, double mass,
                                double gravity);

}  // namespace mcplan
