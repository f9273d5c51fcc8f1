#pragma once

#include <Eigen/Core>

namespace mcplan {

/// Quintic Hermite segment with zero acceleration at both ends; s = t / h in [0, 1].
struct Hermite {
  Eigen::Vector3d position, velocity;

  Hermite(const Eigen::Vector3d& p0, const Eigen::Vector3d& v0, const Eigen::Vector3d& p1, const Eigen::Vector3d& v1,
          double h, double s) {
    const double s2 = s * s, s3 = s2 * s, s4 = s3 * s, s5 = s4 * s;
    const double blend = 10.0 * s3 - 15.0 * s4 + 6.0 * s5;
    const double blend_rate = 30.0 * s2 - 60.0 * s3 + 30.0 * s4;
    const double in0 = s - 6.0 * s3 + 8.0 * s4 - 3.0 * s5, in0_rate = 1.0 - 18.0 * s2 + 32.0 * s3 - 15.0 * s4;
    const double in1 = -4.0 * s3 + 7.0 * s4 - 3.0 * s5, in1_rate = -12.0 * s2 + 28.0 * s3 - 15.0 * s4;
    position = p0 + blend * (p1 - p0) + h * (in0 * v0 + in1 * v1);
    velocity = blend_rate / h * (p1 - p0) + in0_rate * v0 + in1_rate * v1;
  }
};

}  // namespace mcplan
