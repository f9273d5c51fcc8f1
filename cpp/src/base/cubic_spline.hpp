#pragma once

#include <Eigen/Core>
#include <array>

namespace mcplan {

/// The four cubic B-splines that are not zero on one interval, as polynomials of s = -1..1 (from its begin to its end):
///
///     value(s) = sum_m (sum_i basis(m, i) c_i) s^m,    i = 0..3 the control points of the interval
///
/// `spacing` are the lengths [s] of the interval (spacing[2]), of the two before and of the two after it: all knots
/// that these splines depend on. Cox's recursion on polynomials; value, first and second derivative in time are
/// continuous from interval to interval whatever the spacing. Scalar may carry derivatives.
template <class Scalar>
Eigen::Matrix<Scalar, 4, 4> cubic_spline_basis(const std::array<Scalar, 5>& spacing) {
  using Polynomial = std::array<Scalar, 4>;
  const Scalar half = spacing[2] * 0.5;
  // Knots 0..5 about the interval's middle; the interval lies between knots 2 and 3.
  const std::array<Scalar, 6> knot{Scalar(-half - spacing[1] - spacing[0]),
                                   Scalar(-half - spacing[1]),
                                   Scalar(-half),
                                   half,
                                   Scalar(half + spacing[3]),
                                   Scalar(half + spacing[3] + spacing[4])};
  const Scalar zero(0.0);
  std::array<Polynomial, 4> spline{};
  for (Polynomial& p : spline) p.fill(zero);
  spline[3][0] = Scalar(1.0);  // degree 0: spline[3] is the one that starts at knot 2
  for (int degree = 1; degree <= 3; ++degree) {
    for (int i = 3 - degree; i <= 3; ++i) {
      // spline[i] starts at knot i - 1 and goes on over degree + 1 intervals.
      Polynomial next;
      next.fill(zero);
      if (i > 3 - degree) {  // (t - t_i) / (t_{i+degree} - t_i) times itself
        const Scalar scale = Scalar(1.0) / (knot[i - 1 + degree] - knot[i - 1]);
        for (int m = 0; m < degree; ++m) {
          next[m] -= spline[i][m] * (scale * knot[i - 1]);
          next[m + 1] += spline[i][m] * (scale * half);
        }
      }
      if (i < 3) {  // (t_{i+degree+1} - t) / (t_{i+degree+1} - t_{i+1}) times the next one
        const Scalar scale = Scalar(1.0) / (knot[i + degree] - knot[i]);
        for (int m = 0; m < degree; ++m) {
          next[m] += spline[i + 1][m] * (scale * knot[i + degree]);
          next[m + 1] -= spline[i + 1][m] * (scale * half);
        }
      }
      spline[i] = next;
    }
  }
  Eigen::Matrix<Scalar, 4, 4> basis;
  for (int i = 0; i < 4; ++i)
    for (int m = 0; m < 4; ++m) basis(m, i) = spline[i][m];
  return basis;
}

/// Spacings about interval `k` of a spline with intervals of these lengths; beyond its ends the end spacing repeats.
template <class Lengths>
std::array<double, 5> spacing_about(const Lengths& lengths, int k) {
  const int last = static_cast<int>(lengths.size()) - 1;
  std::array<double, 5> out{};
  for (int d = -2; d <= 2; ++d) out[d + 2] = lengths[k + d < 0 ? 0 : (k + d > last ? last : k + d)];
  return out;
}

}  // namespace mcplan
