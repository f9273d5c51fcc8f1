#pragma once

#include <Eigen/Core>

namespace mcplan {

/// How a base with principal inertia I turns under an angular momentum L about the CoM, in roll, pitch and yaw:
///
///     theta' = E(theta) omega,   omega_W = R I^-1 R^T L,   R = Rz(yaw) Ry(pitch) Rx(roll)
///
/// with E the matrix that takes an angular velocity to rates of the angles: no small-angle assumption, singular at a
/// pitch of 90 degrees alone. Units: rad, kg m^2, kg m^2/s (or any consistent ones).
struct TurningRate {
  Eigen::Vector3d rate;        ///< theta'
  Eigen::Matrix3d d_rpy;       ///< d theta' / d theta
  Eigen::Matrix3d d_momentum;  ///< d theta' / d L
};

/// theta' alone.
Eigen::Vector3d rpy_rate(const Eigen::Vector3d& rpy, const Eigen::Vector3d& momentum_W, const Eigen::Vector3d& inertia);

/// theta' with derivatives.
TurningRate turning_rate(const Eigen::Vector3d& rpy, const Eigen::Vector3d& momentum_W, const Eigen::Vector3d& inertia);

/// theta after a time h, by one Runge-Kutta step of order 4 on the momentum at begin, middle and end. The momentum
/// itself is known in closed form (docs/theory/ddp.md, "Angular momentum and base"), so this is the one approximation
/// of the model: 1e-3 rad at most in a phase of the built-in scenes, where one exponential map with the mean angular
/// velocity errs by 2.5e-2.
struct Turned {
  Eigen::Vector3d rpy;
  Eigen::Matrix3d d_rpy;                     ///< with respect to theta at the begin
  Eigen::Matrix3d d_begin, d_middle, d_end;  ///< with respect to the three momenta
  Eigen::Vector3d d_duration;                ///< with respect to h, the momenta held
};

Eigen::Vector3d turned_rpy(const Eigen::Vector3d& rpy, const Eigen::Vector3d& begin_W, const Eigen::Vector3d& middle_W,
                           const Eigen::Vector3d& end_W, const Eigen::Vector3d& inertia, double h);

/// The same with derivatives.
void turn(const Eigen::Vector3d& rpy, const Eigen::Vector3d& begin_W, const Eigen::Vector3d& middle_W,
          const Eigen::Vector3d& end_W, const Eigen::Vector3d& inertia, double h, Turned& out);

}  // namespace mcplan
