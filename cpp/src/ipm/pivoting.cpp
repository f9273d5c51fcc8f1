#include "ipm/pivoting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

#include "ipm/chunk.hpp"

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

/// Largest entry off the diagonal of column k, from row or column `from` on; rows beyond the own ones are eliminated
/// later and bound no choice.
double largest_off_diagonal(const Matrix& F, int own, int k, int from) {
  double size = 0.0;
  for (int j = from; j < k; ++j) size = std::max(size, std::abs(F(k, j)));
  const double* column = &F(0, k);
  int i = k + 1;
  Chunk sizes = Chunk::Zero();
  for (; i + kChunk <= own; i += kChunk) sizes = sizes.max(ConstChunkAt(column + i).abs());
  for (; i < own; ++i) size = std::max(size, std::abs(column[i]));
  return std::max(size, sizes.maxCoeff());
}

/// The first row below the diagonal of column k whose entry has this size.
int row_of_size(const Matrix& F, int own, int k, double size) {
  for (int i = k + 1; i < own; ++i)
    if (std::abs(F(i, k)) == size) return i;
  return -1;
}

/// Columns k + 1 ... own - 1, all rows, after a pivot of size one; column k becomes L's. Above their diagonal, where
/// nothing is read, columns get something, too: chunks begin at multiples of their length.
void update_one(Matrix& F, int own, int k) {
  const int n = static_cast<int>(F.rows());
  double* pivot_column = &F(0, k);
  const long stride = F.outerStride();
  const double pivot = pivot_column[k], inverse = 1.0 / pivot;
  int j = k + 1;
  const auto subtract = [&](auto count) {
    constexpr int kCount = decltype(count)::value;
    std::array<double, kCount> factors;
    for (int c = 0; c < kCount; ++c) factors[c] = pivot_column[j + c] * inverse;
    double* columns = &F(0, j);
    int i = j / kChunk * kChunk;
    j += kCount;
    if (std::all_of(factors.begin(), factors.end(), [](double factor) { return factor == 0.0; })) return;
    for (; i + kChunk <= n; i += kChunk) {
      const Chunk from = ConstChunkAt(pivot_column + i);
      for (int c = 0; c < kCount; ++c) ChunkAt(columns + c * stride + i) -= factors[c] * from;
    }
    for (; i < n; ++i)
      for (int c = 0; c < kCount; ++c) columns[c * stride + i] -= factors[c] * pivot_column[i];
  };
  // Each reading of column k serves several others, which then begin in the same row.
  while (j < own && j % kChunk != 0) subtract(std::integral_constant<int, 1>());
  while (j + kChunk <= own) subtract(std::integral_constant<int, kChunk>());
  while (j < own) subtract(std::integral_constant<int, 1>());
  int i = k / kChunk * kChunk;
  for (; i + kChunk <= n; i += kChunk) ChunkAt(pivot_column + i) *= inverse;
  for (; i < n; ++i) pivot_column[i] *= inverse;
  pivot_column[k] = pivot;
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

/// All of a small matrix, in registers, as long as each diagonal entry in its turn is a good pivot; false where one is
/// not, with F as it was.
template <int Size>
bool eliminate_in_order(Matrix& F, double least, PivotCount& count) {
  std::array<Eigen::Array<double, Size, 1>, Size> columns;
  for (int k = 0; k < Size; ++k) columns[k] = F.col(k);
  std::array<double, Size> diagonal;
  for (int k = 0; k < Size; ++k) {
    double largest = 0.0;
    for (int i = k + 1; i < Size; ++i) largest = std::max(largest, std::abs(columns[k][i]));
    const double size = std::abs(diagonal[k] = columns[k][k]);
    if (!(size > least && size >= kAlpha * largest)) return false;
    const double inverse = 1.0 / diagonal[k];
    for (int j = k + 1; j < Size; ++j) columns[j] -= columns[k][j] * inverse * columns[k];
    columns[k] *= inverse;
  }
  for (int k = 0; k < Size; ++k) {
    ++(diagonal[k] > 0.0 ? count.positive : count.negative);
    F(k, k) = diagonal[k];
    for (int i = k + 1; i < Size; ++i) F(i, k) = columns[k][i];
  }
  return true;
}

}  // namespace

PivotCount eliminate(Eigen::Ref<MatrixXd> F, int own, int* pivots, double* off_diagonal, double least) {
  PivotCount count;
  for (int i = 0; i < own; ++i) {
    pivots[i] = i;
    off_diagonal[i] = 0.0;
  }
  if (own == 8 && F.rows() == 8 && eliminate_in_order<8>(F, least, count)) return count;
  for (int k = 0; k < own;) {
    const double diagonal = std::abs(F(k, k)), column = largest_off_diagonal(F, own, k, k);
    bool two = false;
    const int candidate = diagonal < kAlpha * column ? row_of_size(F, own, k, column) : -1;
    if (candidate >= 0) {
      const double other = largest_off_diagonal(F, own, candidate, k);
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
