#pragma once

#include <Eigen/Core>
#include <array>

namespace mcplan::sip {

/// Polynomials of s in [-1, 1] as vectors of coefficients: p(s) = sum_k a[k] s^k, degree = a.size() - 1 in
/// 0..max_degree. Bernstein coefficients b of degree n on [-1, 1] are those of
///
///     p(s) = sum_i b[i] C(n, i) u^i (1 - u)^(n - i),    u = (s + 1) / 2,
///
/// and min b <= p(s) <= max b. Nothing here allocates but what is returned as a vector.
using ConstPolynomial = Eigen::Ref<const Eigen::VectorXd>;

inline constexpr int max_degree = 30;

double evaluate(const ConstPolynomial& a, double s);
Eigen::VectorXd derivative(const ConstPolynomial& a);
Eigen::VectorXd integral(const ConstPolynomial& a);  ///< zero at s = 0

/// The same function of another variable: a(middle + half_width s).
Eigen::VectorXd restricted(const ConstPolynomial& a, double middle, double half_width);

/// Definite integral over [-1, 1] of p and of p^2.
double definite_integral(const ConstPolynomial& a);
double definite_integral_of_square(const ConstPolynomial& a);

/// M with b = M a, (degree + 1) x (degree + 1). Every entry is a quotient of two exact integers, of magnitude <= 1.
/// Computed once for each degree. Throws InvalidInput for a degree out of 0..max_degree.
const Eigen::MatrixXd& bernstein_matrix(int degree);

/// Bernstein coefficients of the two halves [-1, 0] and [0, 1] of [-1, 1], each on its own [-1, 1], by de Casteljau's
/// algorithm: means of two numbers only. `left` and `right` have the size of `b`; either may be `b` itself.
void halve_bernstein(const ConstPolynomial& b, Eigen::Ref<Eigen::VectorXd> left, Eigen::Ref<Eigen::VectorXd> right);

/// Places in ascending order.
struct Places {
  std::array<double, 2 * max_degree> s{};
  int count = 0;
};

/// Places in (-1, 1) where the polynomial changes sign: isolated by sign variations of Bernstein coefficients
/// (Descartes' rule) under halving, refined by Newton steps kept in their bracket. Coefficients that rounding cannot
/// tell from zero count as zero: the zero polynomial has no roots, and a place where the polynomial only touches zero
/// may be given or not.
Places roots(const ConstPolynomial& a);

/// Least and largest value over [-1, 1] and where they are: among both ends and all stationary points.
struct Extrema {
  double min = 0.0, max = 0.0;          ///< values
  double at_min = -1.0, at_max = -1.0;  ///< places s
};
Extrema extrema(const ConstPolynomial& a);

}  // namespace mcplan::sip
