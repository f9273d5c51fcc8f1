#pragma once

#include <Eigen/Core>
#include <vector>

#include "ipm/linear_system.hpp"
#include "wb/block_band.hpp"
#include "wb/products.hpp"

namespace mcplan::wb {

/// The linear system of a step, with the Hessian of Gauss and Newton. What elastic variables do is said by a change of
/// their rows' weights, forces are eliminated node by node, and equalities add J_E' J_E / delta_c, so that what is
/// factorised is positive definite and a band of the splines' coefficients: docs/theory/wb.md, "The linear system".
class System : public ipm::LinearSystem {
 public:
  System(const Layout& layout, const Assembly& assembly, Products& products);

  void set_jacobian(const Eigen::VectorXd&) override {}  // read from the assembly
  void set_hessian(const Eigen::VectorXd&) override {}
  void set_weights(const Eigen::Ref<const Eigen::VectorXd>& slacks,
                   const Eigen::Ref<const Eigen::VectorXd>& bounds) override;
  Factor factor(double delta, double delta_c) override;
  double delta_c() const override { return delta_c_; }
  void solve(const Eigen::VectorXd& a, const Eigen::VectorXd& b, Eigen::VectorXd& dx, Eigen::VectorXd& lambda) override;
  void solve_roughly(const Solution& first_right, const Solution& second_right, Solution& first,
                     Solution& second) override;
  void refine(const Eigen::VectorXd& a, const Eigen::VectorXd& b, Eigen::VectorXd& dx,
              Eigen::VectorXd& lambda) override;
  void multiply_inequalities(const Eigen::VectorXd& x, Eigen::VectorXd& out) const override;
  void add_inequalities_transposed(const Eigen::VectorXd& y, Eigen::VectorXd& out) const override;
  void add_equalities_transposed(const Eigen::VectorXd& y, Eigen::VectorXd& out) const override;

  double residual() const { return residual_; }  ///< of the last refinement, over the right side's largest entry

 private:
  void condense_weights();
  bool factor_node(int k);
  void solve_once(const Eigen::VectorXd& a, const Eigen::VectorXd& b, Eigen::VectorXd& dx, Eigen::VectorXd& lambda);
  void residual(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& dx,
                const Eigen::VectorXd& lambda);

  const Layout& layout_;
  const Assembly& assembly_;
  Products& products_;
  BlockBand band_;
  Eigen::VectorXd slack_weights_, bound_weights_;
  Eigen::VectorXd row_weights_;  ///< of rows once their elastic variables are eliminated
  double delta_ = 0.0, delta_c_ = 0.0, residual_ = 0.0;
  /// Of a node: the factor of its forces' block, and that factor's inverse times their coupling with the coefficients.
  struct Forces {
    Eigen::MatrixXd factor, coupling;
  };
  std::vector<Forces> forces_;
  mutable std::vector<NodeVector> vectors_;  ///< workspace of each node
  Eigen::MatrixXd wide_, window_, placed_, square_;
  Eigen::VectorXd right_, left_a_, left_b_, step_a_, step_b_, work_, rows_, weighted_;
};

}  // namespace mcplan::wb
