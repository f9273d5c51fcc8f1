#include "planar/sip/taylor_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mcplan/base/error.hpp"
#include "planar/sip/polynomial.hpp"

namespace mcplan::sip {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();  // 2u: twice what one operation may err

/// Above a non-negative bound that took at most a hundred operations to compute, underflow included.
double outward(double bound) { return bound * (1.0 + 128.0 * kEpsilon) + 1e-290; }

/// Bounds of p over [-1, 1]: extreme Bernstein coefficients. Each is a sum of n + 1 products with factors of magnitude
/// <= 1 that are themselves rounded.
Range hull(const Coefficients& a, double remainder) {
  const int n = static_cast<int>(a.size()) - 1;
  const Eigen::MatrixXd& m = bernstein_matrix(n);
  double low = std::numeric_limits<double>::infinity(), high = -low, magnitude = 0.0;
  for (int k = 0; k <= n; ++k) magnitude += std::abs(a[k]);
  for (int i = 0; i <= n; ++i) {
    double b = 0.0;
    for (int k = 0; k <= n; ++k) b += m(i, k) * a[k];
    low = std::min(low, b);
    high = std::max(high, b);
  }
  const double margin = outward(remainder + (n + 4) * kEpsilon * magnitude);
  // NaN must not be taken for a bound: min and max above ignore it, the margin carries it.
  return {low - margin, high + margin};
}

Range horner(const Coefficients& a, double remainder, double s) {
  const int n = static_cast<int>(a.size()) - 1;
  double value = a[n], magnitude = std::abs(a[n]);
  for (int k = n - 1; k >= 0; --k) {
    value = value * s + a[k];
    magnitude = magnitude * std::abs(s) + std::abs(a[k]);
  }
  const double margin = outward(remainder + (2 * n + 4) * kEpsilon * magnitude);
  return {value - margin, value + margin};
}

/// What is left of the majorant's series after s^n, sum_{k>n} E_k, with k E_k = sum_m m |a_m| E_{k-m} and E_0 = 1, and
/// the sum up to there. Summed upward, without the cancellation of E(1) - sum_{k<=n} E_k, until the rest is negligible:
/// with A = sum_m m |a_m| and d the degree, E_k <= (A / k) max(E_{k-1} .. E_{k-d}), so that past K, where
/// q = A / (K + 1) < 1, every d further terms are at most q times the ones before: rest <= d q / (1 - q) max(last d).
/// Infinite where A is so large that a sine is better bounded by 1.
struct Majorant {
  double head = 0.0, tail = 0.0;
};
Majorant majorant(const Coefficients& a, int degree) {
  constexpr int max_terms = 160;
  std::array<double, max_order + 1> weight{};
  double sum = 0.0;
  for (int m = 1; m <= degree; ++m) sum += weight[m] = m * std::abs(a[m]);
  const int n = static_cast<int>(a.size()) - 1;
  Majorant out;
  if (sum == 0.0) return {1.0, 0.0};
  std::array<double, max_terms + 1> term;
  term[0] = out.head = 1.0;
  for (int k = 1; k <= max_terms; ++k) {
    double next = 0.0;
    for (int m = 1; m <= std::min(k, degree); ++m) next += weight[m] * term[k - m];
    term[k] = next / k;
    (k <= n ? out.head : out.tail) += term[k];
    const double q = sum / (k + 1);
    if (k <= n || k < degree || !(q < 0.5)) continue;
    double last = 0.0;
    for (int i = 0; i < degree; ++i) last = std::max(last, term[k - i]);
    const double rest = degree * q / (1.0 - q) * last;
    if (rest <= 1e-3 * out.tail || rest < 1e-40) {
      constexpr double above = 1.0 + 1e-12;  // for the rounding of at most 160 steps
      return {out.head * above, (out.tail + rest) * above};
    }
  }
  return {out.head, std::numeric_limits<double>::infinity()};
}

}  // namespace

UncertainPolynomial UncertainPolynomial::operator+(const UncertainPolynomial& other) const {
  const UncertainPolynomial& longer = a.size() >= other.a.size() ? *this : other;
  const UncertainPolynomial& shorter = a.size() >= other.a.size() ? other : *this;
  UncertainPolynomial out = longer;
  out.a.head(shorter.a.size()) += shorter.a;
  out.error = outward(error + other.error + kEpsilon * out.a.cwiseAbs().sum());
  return out;
}

UncertainPolynomial UncertainPolynomial::operator-(const UncertainPolynomial& other) const {
  UncertainPolynomial minus = other;
  minus.a = -minus.a;
  return *this + minus;
}

UncertainPolynomial UncertainPolynomial::scaled(double factor, double factor_error) const {
  UncertainPolynomial out = *this;
  const double magnitude = a.cwiseAbs().sum();
  out.a *= factor;
  out.error = outward((error + kEpsilon * magnitude) * std::abs(factor) + factor_error * (magnitude + error));
  return out;
}

UncertainPolynomial UncertainPolynomial::derivative() const {
  UncertainPolynomial out;
  const Eigen::Index n = a.size() - 1;
  if (n == 0) return out;
  out.a.resize(n);
  for (Eigen::Index k = 1; k <= n; ++k) out.a[k - 1] = k * a[k];
  out.error = outward(n * error + kEpsilon * out.a.cwiseAbs().sum());
  return out;
}

UncertainPolynomial UncertainPolynomial::restricted(double middle, double half_width) const {
  UncertainPolynomial out = *this;
  const Eigen::Index n = a.size() - 1;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = n - 1; k >= i; --k) out.a[k] += middle * out.a[k + 1];
  double power = 1.0;
  for (Eigen::Index k = 0; k <= n; ++k, power *= half_width) out.a[k] *= power;
  // The coefficients' error grows by (|middle| + half_width)^k <= 1; 2n operations lead to each, n more to its scale.
  out.error = outward(error + (2 * n + 1) * kEpsilon * a.cwiseAbs().sum());
  return out;
}

Range UncertainPolynomial::range() const { return hull(a, error); }
Range UncertainPolynomial::at(double s) const { return horner(a, error, s); }

TaylorModel TaylorModel::constant(int order, double value, double error) {
  if (order < 0 || order > max_order) throw InvalidOptions("order", "must be in 0.." + text(max_order), text(order));
  TaylorModel out(order);
  out.a_[0] = value;
  out.rounding_ = error;
  return out;
}

TaylorModel TaylorModel::of(int order, const UncertainPolynomial& p) {
  TaylorModel out = constant(order, 0.0);
  const Eigen::Index kept = std::min<Eigen::Index>(order + 1, p.a.size());
  out.a_.head(kept) = p.a.head(kept);
  out.rounding_ = p.error;
  if (kept < p.a.size()) out.truncation_ = outward(p.a.tail(p.a.size() - kept).cwiseAbs().sum());
  return out;
}

void TaylorModel::require_order_of(const TaylorModel& other) const {
  if (order() != other.order())
    throw InvalidInput("order", "must be that of the other model, " + text(other.order()), text(order()));
}

TaylorModel& TaylorModel::operator+=(const TaylorModel& other) {
  require_order_of(other);
  a_ += other.a_;
  truncation_ = outward(truncation_ + other.truncation_);
  rounding_ = outward(rounding_ + other.rounding_ + kEpsilon * a_.cwiseAbs().sum());
  return *this;
}

TaylorModel& TaylorModel::operator-=(const TaylorModel& other) { return *this += -other; }

TaylorModel TaylorModel::operator-() const {
  TaylorModel out = *this;
  out.a_ = -out.a_;
  return out;
}

TaylorModel TaylorModel::operator*(const TaylorModel& other) const {
  require_order_of(other);
  const int n = order();
  TaylorModel out(n);
  std::array<double, max_order + 2> rest{};  // rest[k] = sum_{j>=k} |b_j|
  for (int j = n; j >= 0; --j) rest[j] = rest[j + 1] + std::abs(other.a_[j]);
  double sum = 0.0, beyond = 0.0;
  for (int i = 0; i <= n; ++i) {
    const double factor = a_[i], magnitude = std::abs(factor);
    sum += magnitude;
    beyond += magnitude * rest[n + 1 - i];
    for (int j = 0; j <= n - i; ++j) out.a_[i + j] += factor * other.a_[j];
  }
  const double other_sum = rest[0];
  out.truncation_ = outward(beyond + sum * other.truncation_ + truncation_ * (other_sum + other.truncation_));
  out.rounding_ =
      outward(sum * other.rounding_ + rounding_ * (other_sum + other.rounding_) + truncation_ * other.rounding_ +
              rounding_ * other.truncation_ + (n + 3) * kEpsilon * sum * other_sum);
  return out;
}

TaylorModel TaylorModel::scaled(double factor, double factor_error) const {
  TaylorModel out(order());
  return out.add_scaled(factor, *this, factor_error);
}

TaylorModel& TaylorModel::add_scaled(double factor, const TaylorModel& other, double factor_error) {
  require_order_of(other);
  const double magnitude = other.a_.cwiseAbs().sum(), scale = std::abs(factor);
  a_ += factor * other.a_;
  truncation_ = outward(truncation_ + scale * other.truncation_);
  rounding_ = outward(rounding_ + scale * (other.rounding_ + kEpsilon * magnitude) +
                      factor_error * (magnitude + other.remainder()) + kEpsilon * a_.cwiseAbs().sum());
  return *this;
}

TaylorModel TaylorModel::integral() const {
  const int n = order();
  TaylorModel out(n);
  for (int k = 0; k < n; ++k) out.a_[k + 1] = a_[k] / (k + 1);
  out.truncation_ = outward(truncation_ + std::abs(a_[n]) / (n + 1));
  out.rounding_ = outward(rounding_ + kEpsilon * out.a_.cwiseAbs().sum());
  return out;
}

TaylorModel::SineCosine TaylorModel::sine_cosine() const {
  const int n = order();
  int degree = n;
  while (degree > 0 && a_[degree] == 0.0) --degree;
  const Majorant e = majorant(a_, degree);
  SineCosine out{TaylorModel(n), TaylorModel(n)};
  TaylorModel &sine = out.sine, &cosine = out.cosine;
  if (!(e.tail < 1.0)) {  // NaN as well
    sine.truncation_ = cosine.truncation_ = 1.0;
    return out;
  }
  // k S_k = sum_m m a_m C_{k-m},  k C_k = -sum_m m a_m S_{k-m}.
  sine.a_[0] = std::sin(a_[0]);
  cosine.a_[0] = std::cos(a_[0]);
  for (int k = 1; k <= n; ++k) {
    double up = 0.0, down = 0.0;
    for (int m = 1; m <= std::min(k, degree); ++m) {
      up += m * a_[m] * cosine.a_[k - m];
      down += m * a_[m] * sine.a_[k - m];
    }
    sine.a_[k] = up / k;
    cosine.a_[k] = -down / k;
  }
  // The start errs by less than 2 eps (an ulp of the library's sine), each step by (degree + 3) u of what majorises it;
  // by induction the k-th coefficient errs by at most (2 + k (degree + 3)) eps E_k. An error of the angle counts fully.
  sine.truncation_ = cosine.truncation_ = outward(truncation_ + e.tail);
  sine.rounding_ = cosine.rounding_ = outward(rounding_ + (2 + n * (degree + 3)) * kEpsilon * e.head);
  return out;
}

Range TaylorModel::range() const { return hull(a_, remainder()); }
Range TaylorModel::at(double s) const { return horner(a_, remainder(), s); }

}  // namespace mcplan::sip
