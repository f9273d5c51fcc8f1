#pragma once

#include <Eigen/Core>
#include <vector>

#include "ddp/pendulum.hpp"

namespace mcplan::ddp {

/// [A B] = dx+/dz of a step of the Pendulum by its nonzeros, a column at a time: up to 13 of the rows of x, 6 of them
/// angles and momenta, fewer for end-effectors that bear nothing. Keeps its memory from step to step; one object serves
/// one thread.
class StepJacobian {
 public:
  void make(const Layout& at, const PendulumStep& step);

  /// The upper triangle of H (nz x nz) += J'VJ for V (nx x nx), symmetric. Below H's diagonal anything may be left.
  void add_congruent(const Eigen::MatrixXd& v, Eigen::MatrixXd& h);

  Eigen::MatrixXd dense() const;  ///< nx x nz, for tests

 private:
  struct Term {
    Eigen::Index row;
    double by;
  };
  void add(Eigen::Index row, double by) {
    if (by != 0.0) terms_.push_back({row, by});
  }
  void add_point(int row, const Eigen::Vector3d& by) {
    for (int i = 0; i < 3; ++i) add(row + i, by[i]);
  }
  /// The terms of angles and momenta, and the end of a column.
  void end_column(const Layout& at, const PendulumStep& step);
  /// out[0 ... rows) += M J_column, M's columns `stride` apart.
  void combine(int column, const double* m, Eigen::Index stride, Eigen::Index rows, double* out) const;

  Eigen::Index nx_ = 0;
  std::vector<Term> terms_;
  std::vector<int> ends_;  ///< where the terms of a column end
  Eigen::MatrixXd product_, transposed_;
};

}  // namespace mcplan::ddp
