#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace mcplan::wb {

/// Cubic B-splines with continuous accelerations whose knots are nodes t_0 .. t_N and three more at each end, mirrored.
///
/// Of the N + 3 basis functions three are not zero at node k: those of the coefficients k, k + 1, k + 2.
class Spline {
 public:
  explicit Spline(const std::vector<double>& nodes_s);

  /// Derivative `order` (0, 1, 2) of basis function k + j at node k, j = 0, 1, 2.
  double basis(int k, int order, int j) const { return basis_[k][order][j]; }

  int nodes() const { return static_cast<int>(basis_.size()); }
  int coefficients() const { return nodes() + 2; }

 private:
  std::vector<std::array<std::array<double, 3>, 3>> basis_;
};

}  // namespace mcplan::wb
