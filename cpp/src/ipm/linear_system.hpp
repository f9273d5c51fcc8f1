#pragma once

#include <Eigen/Core>

namespace mcplan::ipm {

/// The linear system of a step,
///
///     [ H + J_I' D J_I + diag(S) + delta I    J_E'       ] [ dx     ]   [ a ]
///     [ J_E                                   -delta_c I ] [ lambda ] = [ b ]
///
/// with the Hessian H of the Lagrangian, the Jacobians J_E of the equalities and J_I of the inequalities, whose slacks
/// are eliminated (D), and the weights S of the variables' own bounds. What factorises it knows how the problem is
/// made.
class LinearSystem {
 public:
  virtual ~LinearSystem() = default;

  /// Values in the order in which the oracle gives them; they are read until others are set.
  virtual void set_jacobian(const Eigen::VectorXd& values) = 0;
  virtual void set_hessian(const Eigen::VectorXd& values) = 0;
  virtual void set_weights(const Eigen::Ref<const Eigen::VectorXd>& slacks,
                           const Eigen::Ref<const Eigen::VectorXd>& bounds) = 0;

  enum class Factor { good, wrong_inertia, singular };
  virtual Factor factor(double delta, double delta_c) = 0;
  virtual double delta_c() const = 0;  ///< of the last factor()

  /// dx and lambda, refined until the residual is small against the right side or falls no further.
  virtual void solve(const Eigen::VectorXd& a, const Eigen::VectorXd& b, Eigen::VectorXd& dx,
                     Eigen::VectorXd& lambda) = 0;

  /// The same without a look at the residual, and of two right sides at once.
  struct Solution {
    Eigen::VectorXd dx, lambda;
  };
  virtual void solve_roughly(const Solution& first_right, const Solution& second_right, Solution& first,
                             Solution& second) = 0;

  /// dx and lambda as good as solve() makes them, from what they are.
  virtual void refine(const Eigen::VectorXd& a, const Eigen::VectorXd& b, Eigen::VectorXd& dx,
                      Eigen::VectorXd& lambda) = 0;

  /// out = J_I x, out += J_I' y, out += J_E' y.
  virtual void multiply_inequalities(const Eigen::VectorXd& x, Eigen::VectorXd& out) const = 0;
  virtual void add_inequalities_transposed(const Eigen::VectorXd& y, Eigen::VectorXd& out) const = 0;
  virtual void add_equalities_transposed(const Eigen::VectorXd& y, Eigen::VectorXd& out) const = 0;
};

}  // namespace mcplan::ipm
