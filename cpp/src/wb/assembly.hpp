#pragma once

#include <Eigen/Core>
#include <vector>

#include "wb/kinematics.hpp"
#include "wb/layout.hpp"

namespace mcplan::wb {

/// Values and derivatives of all that a node's rows and costs are made of.
///
/// `moving` rows depend on position, velocity and acceleration: the generalised forces of the base, those of the joints
/// over their limits, and velocities of contacts that rest. The former depend on the contacts' forces too. `placed`
/// rows depend on the configuration alone (Layout::placed_count).
struct NodeTerms {
  Eigen::VectorXd moving, placed;
  Eigen::MatrixXd moving_q, moving_v, moving_a;  ///< (moving, nv)
  Eigen::MatrixXd moving_force;                  ///< (nv, forces)
  Eigen::MatrixXd placed_q;                      ///< (placed, nv)
  Eigen::MatrixXd wrench;                        ///< (6 contacts, forces): over weight, in frames S; constant
  Eigen::VectorXd wrench_error;                  ///< off the plan's
};

/// A problem's rows at all nodes: what dynamics and kinematics say, brought to one scale.
class Assembly {
 public:
  Assembly(const Problem& problem, const Layout& layout, Dynamics& dynamics, Dynamics::Callback callback);

  /// At the unknowns x; with derivatives if asked.
  void evaluate(const Eigen::VectorXd& x, bool derivatives);

  const NodeTerms& node(int k) const { return terms_[k]; }

  /// (nodes, nv) coordinates and their derivatives.
  const Dynamics& dynamics() const { return dynamics_; }

  // What a row is divided by.
  static constexpr double kForceScale = 100.0;    ///< [N, N m] of the base
  static constexpr double kPoseScale = 0.1;       ///< [m, rad]
  static constexpr double kDistanceScale = 0.02;  ///< [m] of tubes and pairs

 private:
  void spread(const Eigen::VectorXd& x);
  void fill(int k, bool derivatives);
  void fill_moving(int k, bool derivatives);
  void fill_still(int k, bool derivatives);
  void fill_forces(int k);
  void add_turning(int k, int row, const Contact& contact);
  void fill_contacts(int k, int& row, bool derivatives);
  void fill_tubes(int k, int& row, bool derivatives);
  void fill_pairs(int k, int& row, bool derivatives);
  void fill_swings(int k, int& row, bool derivatives);
  void fill_pose(const EndEffector& end, const Eigen::Vector3d& position_W, const Eigen::Matrix3d& rotation_W,
                 double scale, NodeTerms& out, int row, bool derivatives);

  const Problem& problem_;
  const Layout& layout_;
  Dynamics& dynamics_;
  Dynamics::Callback callback_;
  Kinematics kinematics_;
  std::vector<NodeTerms> terms_;
  Eigen::VectorXd moving_scale_;                               ///< of the generalised forces
  Eigen::MatrixXd jacobian_, other_, pose_, local_, turning_;  ///< workspace
};

/// Points nearest to each other of two segments, as parts 0 to 1 of their lengths.
struct NearestPoints {
  double first = 0.0, second = 0.0;
};
NearestPoints nearest_points(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1, const Eigen::Vector3d& b0,
                             const Eigen::Vector3d& b1);

}  // namespace mcplan::wb
