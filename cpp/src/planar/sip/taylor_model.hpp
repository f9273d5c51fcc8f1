#pragma once

#include <Eigen/Core>

#include "mcplan/planar/sip/options.hpp"

namespace mcplan::sip {

inline constexpr int max_order = 12;

/// Coefficients of s^0, s^1, ..., kept without the heap.
using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_order + 1, 1>;

/// A polynomial of s in [-1, 1] whose coefficients are those given, but for an error: the sum of the absolute errors of
/// all coefficients is at most `error`. Unlike a Taylor model it may be differentiated, because it is known what kind
/// of function the error is.
struct UncertainPolynomial {
  Coefficients a = Coefficients::Zero(1);
  double error = 0.0;

  /// Of the sum. Degrees may differ.
  UncertainPolynomial operator+(const UncertainPolynomial& other) const;
  UncertainPolynomial operator-(const UncertainPolynomial& other) const;

  /// Times a constant that is within `factor_error` of `factor`.
  UncertainPolynomial scaled(double factor, double factor_error = 0.0) const;

  UncertainPolynomial derivative() const;

  /// As a function of another variable in [-1, 1]: p(middle + half_width s), where |middle| + half_width <= 1.
  UncertainPolynomial restricted(double middle, double half_width) const;

  /// Bounds of its values over [-1, 1], and at one place.
  Range range() const;
  Range at(double s) const;
};

/// A function of s in [-1, 1] known as a polynomial of order n and a bound of what is left over:
///
///     |f(s) - sum_{k<=n} a_k s^k| <= remainder    for all s in [-1, 1]
///
/// The remainder has two parts, which are carried apart to be reported: `truncation`, powers beyond n, and `rounding`,
/// for the floating-point arithmetic that made the coefficients (rounding to nearest, relative error u = 2^-53 of each
/// operation; the bounds themselves are rounded outward). With them
///
///     f g:     truncation sum_{i+j>n} |a_i| |b_j| + |a|_1 r_g + r_f |b|_1 + r_f r_g,    rounding (n + 3) 2u |a|_1
///     |b|_1 sin f:   series of the sine, majorised by E(s) = exp(sum_{k>=1} |a_k| s^k): truncation sum_{k>n} E_k
///
/// |a|_1 being the sum of |a_k|. There is no derivative: nothing is known about that of what is left over.
/// Theory: docs/theory/sip_certificate.md.
class TaylorModel {
 public:
  TaylorModel() = default;  ///< zero, of order 0

  /// A constant. Throws InvalidOptions for an order out of 0..max_order.
  static TaylorModel constant(int order, double value, double error = 0.0);

  /// Powers beyond `order` go into the truncation.
  static TaylorModel of(int order, const UncertainPolynomial& p);

  int order() const { return static_cast<int>(a_.size()) - 1; }
  const Coefficients& coefficients() const { return a_; }
  double truncation() const { return truncation_; }
  double rounding() const { return rounding_; }
  double remainder() const { return truncation_ + rounding_; }

  // Orders must agree; InvalidInput otherwise.
  TaylorModel& operator+=(const TaylorModel& other);
  TaylorModel& operator-=(const TaylorModel& other);
  TaylorModel operator+(const TaylorModel& other) const { return TaylorModel(*this) += other; }
  TaylorModel operator-(const TaylorModel& other) const { return TaylorModel(*this) -= other; }
  TaylorModel operator-() const;
  TaylorModel operator*(const TaylorModel& other) const;

  /// Times a constant that is within `factor_error` of `factor`.
  TaylorModel scaled(double factor, double factor_error = 0.0) const;

  /// this += factor other, the commonest step of linear combinations.
  TaylorModel& add_scaled(double factor, const TaylorModel& other, double factor_error = 0.0);

  /// Integral from 0 to s.
  TaylorModel integral() const;

  struct SineCosine;
  SineCosine sine_cosine() const;

  /// Bounds of f over [-1, 1]: Bernstein hull and remainder.
  Range range() const;

  /// Bounds of f at one place.
  Range at(double s) const;

 private:
  explicit TaylorModel(int order) : a_(Coefficients::Zero(order + 1)) {}
  void require_order_of(const TaylorModel& other) const;

  Coefficients a_ = Coefficients::Zero(1);
  double truncation_ = 0.0, rounding_ = 0.0;
};

struct TaylorModel::SineCosine {
  TaylorModel sine, cosine;
};

}  // namespace mcplan::sip
