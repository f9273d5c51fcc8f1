#pragma once

#include <Eigen/Core>

namespace mcplan {

/// Quintic Hermite segments of h [s] with zero acceleration at both ends, at s = t / h in [0, 1].
class Hermite {
 public:
  Hermite(double h, double s) : h_(h) {
    const double s2 = s * s, s3 = s2 * s, s4 = s3 * s, s5 = s4 * s;
    blend_ = 10.0 * s3 - 15.0 * s4 + 6.0 * s5;
    blend_rate_ = (30.0 * s2 - 60.0 * s3 + 30.0 * s4) / h;
    in0_ = s - 6.0 * s3 + 8.0 * s4 - 3.0 * s5;
    in0_rate_ = 1.0 - 18.0 * s2 + 32.0 * s3 - 15.0 * s4;
    in1_ = -4.0 * s3 + 7.0 * s4 - 3.0 * s5;
    in1_rate_ = -12.0 * s2 + 28.0 * s3 - 15.0 * s4;
  }

  /// Position and velocity between those at the two ends.
  void put(const Eigen::Vector3d& p0, const Eigen::Vector3d& v0, const Eigen::Vector3d& p1, const Eigen::Vector3d& v1,
           Eigen::Vector3d& position, Eigen::Vector3d& velocity) const {
    position = p0 + blend_ * (p1 - p0) + h_ * (in0_ * v0 + in1_ * v1);
    velocity = blend_rate_ * (p1 - p0) + in0_rate_ * v0 + in1_rate_ * v1;
  }

 private:
  double h_, blend_, blend_rate_, in0_, in0_rate_, in1_, in1_rate_;
};

}  // namespace mcplan
