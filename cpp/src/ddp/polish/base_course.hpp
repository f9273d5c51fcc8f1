#pragma once

#include <Eigen/Core>

#include "ddp/pendulum.hpp"

namespace mcplan::ddp::polish {

/// The angles of the base inside a phase, where limits are held: the cubic that has their values and rates at both
/// ends,
///
///     theta(s) = h_00 theta_0 + h_10 t theta_0' + h_01 theta_1 + h_11 t theta_1',   s = 0 ... 1 of the phase's t,
///
/// with Hermite's polynomials h. The dynamics take a Runge-Kutta step to the end of the phase; one to every instant,
/// with its derivatives, took a tenth of a whole plan's time. Measured on a plan of gap_with_rail against a fine
/// integration: 8e-4 rad at most, 3e-4 rad with such steps, and 1e-3 rad at the ends of phases, which both have in
/// common. Exact for Model::lipm.
class BaseCourse {
 public:
  /// The phase that begins so and ends there.
  void set(const Pendulum& pendulum, const Pendulum::Drive& begin, const PendulumStep& end);

  /// theta at s, axes that the layout leaves out 0.
  Eigen::Vector3d at(double s) const;

  /// What theta at s depends on: angles and momenta at both ends, and the duration while these are held.
  struct Derivatives {
    Eigen::Matrix3d begin_angle, begin_momentum;
    Eigen::Matrix<double, 3, 6> end;  ///< by the angle, by the momentum
    Eigen::Vector3d duration;
  };
  Derivatives derivatives(double s) const;

 private:
  Eigen::Vector3d begin_angle_, end_angle_;
  RpyRate begin_, end_;
  double duration_ = 0.0;
};

}  // namespace mcplan::ddp::polish
