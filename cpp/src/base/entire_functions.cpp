#include "mcplan/base/entire_functions.hpp"

#include <cmath>

namespace mcplan {
namespace {

/// Horner's scheme of F_n for small |z|. Ten terms: the first one left out is below z^10 / 20! = 5e-22 at |z| = 0.7.
double series(double z, int n) {
  constexpr int kTerms = 10;
  double sum = 1.0;
  for (int i = kTerms - 1; i >= 1; --i) sum = 1.0 + sum * z / ((2.0 * i + n) * (2.0 * i + n - 1.0));
  for (int i = 2; i <= n; ++i) sum /= i;
  return sum;
}

}  // namespace

EntireFunctions::EntireFunctions(double z) {
  // F_4 and F_5 by division lose digits like 1/z^2, so the series reaches as far as z = 0.7.
  constexpr double kSeriesRange = 0.7;
  if (std::abs(z) < kSeriesRange) {
    // Downward recurrence F_n = 1/n! + z F_{n+2}: no cancellation for positive z, harmless for |z| < 1.
    values_[5] = series(z, 5);
    values_[4] = series(z, 4);
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
