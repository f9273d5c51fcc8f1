#include "base/entire_functions.hpp"

#include <cmath>

namespace mcplan {
namespace {

/// Coefficients 1 / (2i + n)! of F_n. Nine terms: the first one left out is below z^9 / 22! = 4e-23 at |z| = 0.7.
constexpr int kTerms = 9;
constexpr std::array<double, kTerms> coefficients(int n) {
  std::array<double, kTerms> out{};
  double factorial = 1.0;
  for (int i = 2; i <= n; ++i) factorial *= i;
  for (int i = 0; i < kTerms; ++i) {
    if (i > 0) factorial *= (2.0 * i + n) * (2.0 * i + n - 1.0);
    out[i] = 1.0 / factorial;
  }
  return out;
}

/// Horner's scheme for small |z|.
double series(double z, const std::array<double, kTerms>& c) {
  double sum = c[kTerms - 1];
  for (int i = kTerms - 2; i >= 0; --i) sum = c[i] + sum * z;
  return sum;
}

}  // namespace

EntireFunctions::EntireFunctions(double z) {
  // F_4 and F_5 by division lose digits like 1/z^2, so the series reaches as far as z = 0.7.
  constexpr double kSeriesRange = 0.7;
  if (std::abs(z) < kSeriesRange) {
    // Downward recurrence F_n = 1/n! + z F_{n+2}: no cancellation for positive z, harmless for |z| < 1.
    static constexpr auto kFifth = coefficients(5), kFourth = coefficients(4);
    values_[5] = series(z, kFifth);
    values_[4] = series(z, kFourth);
    values_[3] = 1.0 / 6.0 + z * values_[5];
    values_[2] = 0.5 + z * values_[4];
    values_[1] = 1.0 + z * values_[3];
    values_[0] = 1.0 + z * values_[2];
    return;
  }
  const double root = std::sqrt(std::abs(z));
  if (z > 0.0) {
    values_[0] = std::cosh(root);
    values_[1] = std::sinh(root) / root;
    const double half = std::sinh(0.5 * root);
    values_[2] = 2.0 * half * half / z;
  } else {
    values_[0] = std::cos(root);
    values_[1] = std::sin(root) / root;
    const double half = std::sin(0.5 * root);
    values_[2] = -2.0 * half * half / z;
  }
  values_[3] = (values_[1] - 1.0) / z;
  values_[4] = (values_[2] - 0.5) / z;
  values_[5] = (values_[3] - 1.0 / 6.0) / z;
}

}  // namespace mcplan
