#pragma once

#include <Eigen/Core>

namespace mcplan::ipm {

/// Signs of the pivots.
struct PivotCount {
  int positive = 0, negative = 0, zero = 0;
};

/// Eliminate the first `own` unknowns of a symmetric matrix F, of which the lower triangle is given, as L D L' with
/// pivots of size one and two chosen among them (J. R. Bunch, L. Kaufman: Some stable methods for calculating inertia
/// and solving symmetric linear systems, 1977). On return the first `own` columns hold L below the diagonal and the
/// diagonal of D; the rest of F, what is below and right of them, is as it was: the caller subtracts L D L' from it.
///
/// pivots[k]: which of the first `own` unknowns came k-th; off_diagonal[k]: D(k + 1, k) where a pivot of size two
/// begins, else zero. Ends at the first pivot whose size is at most `least`, which is counted as zero.
PivotCount eliminate(Eigen::Ref<Eigen::MatrixXd> F, int own, int* pivots, double* off_diagonal, double least);

}  // namespace mcplan::ipm
