#pragma once

#include <Eigen/Core>

namespace mcplan::sip {

/// A number with first and second derivatives with respect to up to kSize variables (forward mode): for formulas too
/// branched to differentiate by hand and too small to matter.
struct Jet {
  static constexpr int kSize = 5;
  using Gradient = Eigen::Matrix<double, kSize, 1>;
  using Hessian = Eigen::Matrix<double, kSize, kSize>;

  double value = 0.0;
  Gradient gradient = Gradient::Zero();
  Hessian hessian = Hessian::Zero();

  Jet() = default;
  Jet(double number) : value(number) {}  // NOLINT: numbers are jets

  /// scale * the variable of this index, at `at`.
  static Jet variable(double at, int index, double scale = 1.0) {
    Jet out(scale * at);
    out.gradient[index] = scale;
    return out;
  }

  Jet& operator+=(const Jet& other) {
    value += other.value;
    gradient += other.gradient;
    hessian += other.hessian;
    return *this;
  }
  Jet& operator-=(const Jet& other) {
    value -= other.value;
    gradient -= other.gradient;
    hessian -= other.hessian;
    return *this;
  }
  Jet operator-() const { return Jet() - *this; }
  friend Jet operator+(Jet a, const Jet& b) { return a += b; }
  friend Jet operator-(Jet a, const Jet& b) { return a -= b; }

  friend Jet operator*(const Jet& a, const Jet& b) {
    Jet out(a.value * b.value);
    out.gradient = a.value * b.gradient + b.value * a.gradient;
    out.hessian = a.value * b.hessian + b.value * a.hessian + a.gradient * b.gradient.transpose() +
                  b.gradient * a.gradient.transpose();
    return out;
  }

  /// u(a): outer derivatives first and second.
  static Jet chain(const Jet& a, double value, double first, double second) {
    Jet out(value);
    out.gradient = first * a.gradient;
    out.hessian = first * a.hessian + second * a.gradient * a.gradient.transpose();
    return out;
  }
  friend Jet operator/(const Jet& a, const Jet& b) {
    const double inverse = 1.0 / b.value;
    return a * chain(b, inverse, -inverse * inverse, 2.0 * inverse * inverse * inverse);
  }
};

}  // namespace mcplan::sip
