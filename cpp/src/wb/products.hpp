#pragma once

#include <Eigen/Core>
#include <vector>

#include "wb/assembly.hpp"

namespace mcplan::wb {

/// A number for all that is measured at a node: coordinates and their derivatives, moving and placed rows, contact
/// wrenches over weight, forces along edges. Values, weights and multipliers of rows have this shape.
struct NodeVector {
  Eigen::VectorXd q, v, a, moving, placed, wrench, force;

  void resize(const Layout& layout, const NodeTerms& terms, int k);
  void set_zero();
};

/// What all costs and rows are: functions of the node's vector, which is a linear one of the unknowns at a point. With
/// the Jacobian T_k of the vector, the Hessian of Gauss and Newton is sum T_k' diag(weights) T_k.
class Products {
 public:
  Products(const Problem& problem, const Layout& layout, const Assembly& assembly);

  /// Out of the unknowns x: T_k x.
  void image(int k, const Eigen::VectorXd& x, NodeVector& out) const;

  /// out += T_k' y.
  void add_transposed(int k, const NodeVector& y, Eigen::VectorXd& out);

  /// Values at the point that was assembled: residuals where the cost has a square of them.
  void values(int k, const Eigen::VectorXd& x, NodeVector& out) const;

  /// Of half the squares in the cost.
  const NodeVector& cost_weights(int k) const { return cost_[k]; }

  // Which of a vector's numbers are rows. Those of inequalities leave elastic variables aside.
  void to_equalities(int k, const NodeVector& from, Eigen::VectorXd& out) const;
  void to_inequalities(int k, const NodeVector& from, Eigen::VectorXd& out) const;
  /// Adds numbers of rows to those of a vector; inequalities are scaled as their rows are, `squared` as their squares.
  void add_equalities(int k, const Eigen::VectorXd& from, NodeVector& out) const;
  void add_inequalities(int k, const Eigen::VectorXd& from, bool squared, NodeVector& out) const;
  void add_to_equalities(int k, double value, NodeVector& out) const;

  NodeVector make(int k) const;

 private:
  NodeVector cost_weights_of(int k) const;

  const Problem& problem_;
  const Layout& layout_;
  const Assembly& assembly_;
  std::vector<NodeVector> cost_;
  Eigen::VectorXd velocity_scale_;  ///< of joints
  Eigen::VectorXd work_;
};

}  // namespace mcplan::wb
