#pragma once

#include <Eigen/Core>
#include <vector>

namespace mcplan::sip {

/// The weighted least norm of a phase and how it changes with the logarithms p_a of its weights.
///
///     f_v = K_v D,   K_v = gamma_v G_v^T Omega^-1,   Omega = sum_v G_v gamma_v G_v^T          (eqs. 18-25)
///
/// with gamma_v = diag(1 / (10 beta_v), 1 / beta_v), beta_v = exp(p_a) for the points v that parameter a weighs, and
/// G_v = [t n; (x_v - p) x t, (x_v - p) x n]: f is the force on the robot, n points from the ground into the robot, and
/// sum_v G_v f_v = D. (The paper's F is the force on the environment, and its eqs. 19-23 transpose the 6 x 3 block.)
/// Derivatives, with X_a = sum_{v in a} G_v gamma_v G_v^T Omega^-1:
///
///     dK_v / da     = K_v (X_a - [v in a])
///     d2K_v / da db = K_v (X_b - [v in b]) (X_a - [v in a]) + K_v (X_a X_b - [a = b] X_a)
class ContactGain {
 public:
  /// One point of a contact.
  struct Point {
    Eigen::Vector2d place;    ///< relative to p [m]
    Eigen::Vector2d tangent;  ///< unit vector; the normal is 90 degrees to its left
    int parameter = -1;       ///< that weighs it; -1: weight 1
  };

  ContactGain(std::vector<Point> points, int parameters);

  void update(const Eigen::Ref<const Eigen::VectorXd>& log_weights);

  int points() const { return static_cast<int>(points_.size()); }
  const Eigen::MatrixXd& value() const { return value_; }  ///< (2 points) x 3: tangential and normal, point by point
  const Eigen::MatrixXd& first(int a) const { return first_[a]; }
  const Eigen::MatrixXd& second(int a, int b) const { return second_[a * parameters_ + b]; }

 private:
  std::vector<Point> points_;
  std::vector<Eigen::Matrix<double, 3, 2>> grasp_;
  int parameters_;
  Eigen::MatrixXd value_;
  std::vector<Eigen::MatrixXd> first_, second_;
  std::vector<Eigen::Matrix3d> part_, X_;
  std::vector<Eigen::Matrix<double, 2, 3>> weighted_;
};

}  // namespace mcplan::sip
