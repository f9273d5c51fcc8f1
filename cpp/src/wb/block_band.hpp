#pragma once

#include <Eigen/Core>
#include <vector>

namespace mcplan::wb {

/// Cholesky factorisation of a positive definite matrix of square blocks, two blocks of which lie below each diagonal
/// one.
class BlockBand {
 public:
  BlockBand(int blocks, int size);

  void set_zero();

  /// The lower triangle of block (i + below, i), below = 0, 1, 2.
  Eigen::Ref<Eigen::MatrixXd> block(int i, int below);

  /// Replaces the matrix by its factor; false where it is not positive definite.
  bool factor();

  /// Replaces b by the solution.
  void solve(Eigen::Ref<Eigen::VectorXd> b) const;

 private:
  int blocks_, size_;
  std::vector<Eigen::MatrixXd> columns_;  ///< (3 size, size): a diagonal block and those below
};

}  // namespace mcplan::wb
