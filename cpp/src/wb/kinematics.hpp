#pragma once

#include <Eigen/Core>
#include <vector>

#include "mcplan/wb/problem.hpp"

namespace mcplan::wb {

/// Positions of a robot's links at a configuration, and how its joints move them.
///
/// Column i of the Jacobian is what joint i gives the links that it carries: the velocity of the point of the link that
/// is at the world's origin, and the angular velocity (Featherstone's spatial velocity, linear part first).
class Kinematics {
 public:
  using Jacobian = Eigen::Matrix<double, 3, Eigen::Dynamic>;

  explicit Kinematics(const Problem& problem);

  void update(const Eigen::Ref<const Eigen::VectorXd>& q);

  const Eigen::Matrix3d& rotation(int link) const { return rotations_[link]; }  ///< link to world
  Eigen::Vector3d point(int link, const Eigen::Vector3d& in_link) const {
    return rotations_[link] * in_link + positions_[link];
  }
  const Eigen::Vector3d& com() const { return com_; }

  /// Of a point of a link that is at `position_W`, and of its rotation, both in the world's axes; (3, nv).
  void point_jacobian(int link, const Eigen::Vector3d& position_W, Eigen::Ref<Eigen::MatrixXd> out) const;
  void rotation_jacobian(int link, Eigen::Ref<Eigen::MatrixXd> out) const;
  void com_jacobian(Eigen::Ref<Eigen::MatrixXd> out) const;

  /// Velocity of the point of a link that is at the fixed place `position_W`, and the link's angular velocity, with
  /// their derivatives (6, nv) with respect to q at fixed v; those with respect to v are the two Jacobians.
  Eigen::Matrix<double, 6, 1> velocity(int link, const Eigen::Vector3d& position_W,
                                       const Eigen::Ref<const Eigen::VectorXd>& v) const;
  void velocity_derivative(int link, const Eigen::Vector3d& position_W, const Eigen::Ref<const Eigen::VectorXd>& v,
                           Eigen::Ref<Eigen::MatrixXd> out) const;

  /// The links from the base to this one, it included.
  const std::vector<int>& chain(int link) const { return chains_[link]; }

 private:
  const std::vector<Link>& links_;
  std::vector<std::vector<int>> chains_;
  std::vector<Eigen::Matrix3d> rotations_;
  std::vector<Eigen::Vector3d> positions_, linear_, angular_;  ///< of links; of joints' columns
  std::vector<double> masses_;                                 ///< of a link and all that it carries
  std::vector<Eigen::Vector3d> moments_;                       ///< their masses times positions
  Eigen::Vector3d com_ = Eigen::Vector3d::Zero();
};

/// Vector of the rotation R, axis times angle, and what a small rotation in R's own axes, R exp(w), adds to it.
Eigen::Vector3d rotation_log(const Eigen::Matrix3d& R);
Eigen::Matrix3d rotation_log_jacobian(const Eigen::Vector3d& log);

}  // namespace mcplan::wb
