#pragma once

#include <Eigen/Core>

namespace mcplan {

/// How a base with principal inertia I turns under an angular momentum L about the CoM, in roll, pitch and yaw:
///
///     theta' = E(theta) omega,   omega_W = R I^-1 R^T L,   R = Rz(yaw) Ry(pitch) Rx(roll)
///
/// with E the matrix that takes an angular velocity to rates of the angles: no small-angle assumption, singular at a
/// pitch of 90 degrees alone. Units: rad, kg m^2, kg m^2/s (or any consistent ones).
struct RpyRate {
  Eigen::Vector3d rate;        ///< theta'
  Eigen::Matrix3d d_rpy;       ///< d theta' / d theta
  Eigen::Matrix3d d_momentum;  ///< d theta' / d L
};

/// theta' with derivatives.
RpyRate rpy_rate_derivatives(const Eigen::Vector3d& rpy, const Eigen::Vector3d& momentum_W,
                             const Eigen::Vector3d& inertia);

/// Sines and cosines of roll, pitch and yaw.
struct RpyTrig {
  double sr, cr, sp, cp, sy, cy;

  explicit RpyTrig(const Eigen::Vector3d& rpy);
  RpyTrig plus(const Eigen::Vector3d& by) const;  ///< of rpy + by, cheap where that is small

  /// R = Rz(yaw) Ry(pitch) Rx(roll).
  Eigen::Matrix3d rotation() const {
    Eigen::Matrix3d r;
    r << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
        sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,   //
        -sp, cp * sr, cp * cr;
    return r;
  }

  /// Angular velocity in the world of rates of the angles: each turns about its own axis, roll about the base's x,
  /// pitch about the level y of the heading, yaw about the vertical.
  Eigen::Vector3d angular_velocity_W(const Eigen::Vector3d& rate) const {
    return {rate[0] * cy * cp - rate[1] * sy, rate[0] * sy * cp + rate[1] * cy, rate[2] - rate[0] * sp};
  }
};

/// theta' alone.
Eigen::Vector3d rpy_rate(const RpyTrig& trig, const Eigen::Vector3d& momentum_W, const Eigen::Vector3d& inertia);
Eigen::Vector3d rpy_rate(const Eigen::Vector3d& rpy, const Eigen::Vector3d& momentum_W, const Eigen::Vector3d& inertia);

/// L = R I R^T omega_W of a base whose angles have these rates: what rpy_rate() takes back to them.
Eigen::Vector3d base_momentum_W(const Eigen::Vector3d& rpy, const Eigen::Vector3d& rate,
                                const Eigen::Vector3d& inertia);

/// Where a base turns from a given state, as a function of time: theta(h) by one Runge-Kutta step of order 4 on the
/// momentum at begin, middle and end. The momentum itself is known in closed form (docs/theory/ddp.md, "Angular
/// momentum and base"), so this is the one approximation of the model. Measured on the phases of gap_with_rail, against
/// a fine integration: 2.4e-3 rad at most in a phase; one exponential map with the mean angular velocity errs by two to
/// five times that.
class BaseRotation {
 public:
  BaseRotation(const Eigen::Vector3d& rpy, const Eigen::Vector3d& begin_W, const Eigen::Vector3d& inertia);

  /// theta(h), for the momenta at h/2 and h.
  Eigen::Vector3d rpy(const Eigen::Vector3d& middle_W, const Eigen::Vector3d& end_W, double h) const;

  /// The same with derivatives.
  struct Derivatives {
    Eigen::Vector3d rpy;
    Eigen::Matrix3d d_rpy;                     ///< with respect to theta at the begin
    Eigen::Matrix3d d_begin, d_middle, d_end;  ///< with respect to the three momenta
    Eigen::Vector3d d_duration;                ///< with respect to h, the momenta held
  };
  void differentiate(const Eigen::Vector3d& middle_W, const Eigen::Vector3d& end_W, double h, Derivatives& out) const;

 private:
  Eigen::Vector3d rpy_, begin_W_, inverse_inertia_, begin_rate_;
  RpyTrig trig_;
};

}  // namespace mcplan
