#include "ddp/elimination.hpp"

#include <algorithm>
#include <cmath>

namespace mcplan::ddp {
namespace {

using Eigen::Index;

/// out[0 ... rows) -= sum_p by[p] column_p, for P columns that follow upon each other `stride` apart, the last P of a
/// matrix whose entries of one row are by[p].
template <int P>
inline void subtract(double* __restrict out, Index rows, const double* __restrict columns, Index stride,
                     const double (&by)[P]) {
  for (Index i = 0; i < rows; ++i) {
    double sum = out[i];
    for (int p = 0; p < P; ++p) sum -= by[p] * columns[p * stride + i];
    out[i] = sum;
  }
}

/// The last P of n variables.
template <int P>
bool eliminate(double* h, Index n, Index stride) {
  const Index left = n - P;
  double* const pivots = h + left * stride;
  for (int p = P - 1; p >= 0; --p) {
    double* const column = pivots + p * stride;
    const double pivot = column[left + p];
    if (!(pivot > 0.0)) return false;
    const double root = std::sqrt(pivot), inverse = 1.0 / root;
    for (Index i = 0; i < left + p; ++i) column[i] *= inverse;
    column[left + p] = root;
    for (int q = 0; q < p; ++q) subtract<1>(pivots + q * stride, left + q + 1, column, stride, {column[left + q]});
  }
  for (Index j = 0; j < left; ++j) {
    // Whole chunks of four rows, so that vectors have no remainder: what lies below the diagonal is nobody's.
    double by[P];
    for (int p = 0; p < P; ++p) by[p] = pivots[p * stride + j];
    subtract<P>(h + j * stride, std::min((j + 4) / 4 * 4, n), pivots, stride, by);
  }
  return true;
}

}  // namespace

bool eliminate_last(Eigen::MatrixXd& h, int count) {
  constexpr int kPanel = 4;
  Index n = h.rows();
  const Index left = n - count, stride = h.outerStride();
  for (; n - left >= kPanel; n -= kPanel)
    if (!eliminate<kPanel>(h.data(), n, stride)) return false;
  for (; n > left; --n)
    if (!eliminate<1>(h.data(), n, stride)) return false;
  return true;
}

}  // namespace mcplan::ddp
