#include "ipm/pivoting.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mcplan::ipm {
namespace {

using Eigen::MatrixXd;
using Matrix = Eigen::Ref<MatrixXd>;

/// (1 + sqrt(17)) / 8: bounds the growth of pivots of both sizes alike.
const double kAlpha = (1.0 + std::sqrt(17.0)) / 8.0;

/// Exchange the own unknowns a < b, in rows and columns, those of L so far included.
void exchange(Matrix& F, int a, int b, int* pivots) {
  if (a == b) return;
  const int n = static_cast<int>(F.rows());
  for (int j = 0; j < a; ++j) std::swap(F(a, j), F(b, j));
  std::swap(F(a, a), F(b, b));
  for (int i = a + 1; i < b; ++i) std::swap(F(i, a), F(b, i));
  for (int i = b + 1; i < n; ++i) std::swap(F(i, a), F(i, b));
  std::swap(pivots[a], pivots[b]);
}

/// Place of the largest entry off the diagonal of column k, from row or column `from` on; rows beyond the own ones are
/// eliminated later and bound no choice.
int largest_off_diagonal(const Matrix& F, int own, int k, int from, double& size) {
  int at = -1;
  size = 0.0;
  for (int j = from; j < k; ++j)
    if (std::abs(F(k, j)) > size) size = std::abs(F(k, at = j));
  for (int i = k + 1; i < own; ++i)
    if (std::abs(F(i, k)) > size) size = std::abs(F(at = i, k));
  return at;
}

/// Columns k + 1 ... own - 1, all rows, after a pivot of size one; column k becomes L's.
void update_one(Matrix& F, int own, int k) {
  const int n = static_cast<int>(F.rows());
  const double inverse = 1.0 / F(k, k);
  // Two columns at a time: each reading of column k serves both.
  int j = k + 1;
  for (; j + 1 < own; j += 2) {
    const double first = F(j, k) * inverse, second = F(j + 1, k) * inverse;
    if (first == 0.0 && second == 0.0) continue;
    F(j, j) -= first * F(j, k);
    const auto from = F.col(k).segment(j + 1, n - j - 1);
    auto left = F.col(j).segment(j + 1, n - j - 1);
    auto right = F.col(j + 1).segment(j + 1, n - j - 1);
    for (int i = 0; i < n - j - 1; ++i) {
      left[i] -= first * from[i];
      right[i] -= second * from[i];
    }
  }
  if (j < own) F.col(j).segment(j, n - j) -= F(j, k) * inverse * F.col(k).segment(j, n - j);
  F.col(k).segment(k + 1, n - k - 1) *= inverse;
}

/// The same after a pivot of size two, whose off-diagonal entry is c.
void update_two(Matrix& F, int own, int k, double c) {
  const int n = static_cast<int>(F.rows());
  const double p = F(k, k) / c, q = F(k + 1, k + 1) / c, scale = 1.0 / (c * (p * q - 1.0));
  for (int j = k + 2; j < own; ++j) {
    const double a = F(j, k), b = F(j, k + 1);
    if (a == 0.0 && b == 0.0) continue;
    const double first = scale * (q * a - b), second = scale * (p * b - a);
    F.col(j).segment(j, n - j) -= first * F.col(k).segment(j, n - j) + second * F.col(k + 1).segment(j, n - j);
  }
  for (int i = k + 2; i < n; ++i) {
    const double a = F(i, k), b = F(i, k + 1);
    F(i, k) = scale * (q * a - b);
    F(i, k + 1) = scale * (p * b - a);
  }
  F(k + 1, k) = 0.0;
}

}  // namespace

PivotCount eliminate(Eigen::Ref<MatrixXd> F, int own, int* pivots, double* off_diagonal, double least) {
  PivotCount count;
  for (int i = 0; i < own; ++i) {
    pivots[i] = i;
    off_diagonal[i] = 0.0;
  }
  for (int k = 0; k < own;) {
    double column = 0.0, other = 0.0;
    const double diagonal = std::abs(F(k, k));
    const int candidate = largest_off_diagonal(F, own, k, k, column);
    bool two = false;
    if (diagonal < kAlpha * column) {
      largest_off_diagonal(F, own, candidate, k, other);
      if (diagonal * other >= kAlpha * column * column) {
        // The diagonal entry will do.
      } else if (std::abs(F(candidate, candidate)) >= kAlpha * other) {
        exchange(F, k, candidate, pivots);
      } else {
        exchange(F, k + 1, candidate, pivots);
        two = true;
      }
    }
    if (!(two || std::abs(F(k, k)) > least)) {  // NaN, too
      ++count.zero;
      return count;
    }
    if (two) {
      const double c = F(k + 1, k);
      const double determinant = (F(k, k) / c) * (F(k + 1, k + 1) / c) - 1.0;
      if (!(std::abs(determinant) > 0.0)) {
        ++count.zero;
        return count;
      }
      const int positive = determinant < 0.0 ? 1 : F(k, k) > 0.0 ? 2 : 0;
      count.positive += positive;
      count.negative += 2 - positive;
      off_diagonal[k] = c;
      update_two(F, own, k, c);
      k += 2;
    } else {
      ++(F(k, k) > 0.0 ? count.positive : count.negative);
      update_one(F, own, k);
      ++k;
    }
  }
  return count;
}

}  // namespace mcplan::ipm
