#pragma once

#include <Eigen/Core>
#include <vector>

#include "mcplan/nlp/problem.hpp"

namespace mcplan::ipm {

/// The Jacobian of a problem, in the order of its jacobian_structure(), at one point after another: entries of linear
/// pieces, of a walk's more than half, are evaluated, looked at and scaled once.
class Jacobian {
 public:
  /// scales: of the entries; empty: ones.
  Jacobian(const nlp::Problem& problem, Eigen::VectorXd scales);

  /// False where a number is not finite.
  bool evaluate(const Eigen::VectorXd& x);

  const Eigen::VectorXd& values() const { return values_; }

 private:
  void evaluate_nonlinear(const Eigen::VectorXd& x);

  const nlp::Problem& problem_;
  Eigen::VectorXd scales_, values_;
  bool known_ = false;                                 ///< the entries of linear pieces
  std::vector<const nlp::Problem::Block*> nonlinear_;  ///< constraints
  struct Range {
    int first = 0, count = 0;
  };
  std::vector<Range> ranges_;  ///< of their entries
  Eigen::VectorXd x_, block_;  ///< workspace of a piece
};

}  // namespace mcplan::ipm
