#include "base/entire_functions.hpp"

#include <doctest/doctest.h>

#include <cmath>

using mcplan::EntireFunctions;

namespace {

/// F_n(z) term by term; enough terms for |z| <= 40.
long double series(long double z, int n) {
  long double term = 1.0L, sum = 0.0L;
  for (int i = 2; i <= n; ++i) term /= i;
  for (int i = 0; i < 60; ++i) {
    sum += term;
    term *= z / ((2.0L * i + n + 1) * (2.0L * i + n + 2));
  }
  return sum;
}

const double kArguments[] = {-4.0, -0.7, -0.3, -1e-9, 0.0, 1e-12, 1e-5, 0.3, 0.699999, 0.7, 0.7001, 1.0, 3.0, 40.0};

}  // namespace

TEST_CASE("entire functions are their series") {
  for (double z : kArguments)
    for (int n = 0; n <= 5; ++n) {
      CAPTURE(z);
      CAPTURE(n);
      const double truth = static_cast<double>(series(z, n));
      CHECK(std::abs(EntireFunctions(z)(n) - truth) <= 4e-15 * std::max(1.0, std::abs(truth)));
      // F_4 and F_5 of 0.7 by division lose two digits; more than four would show here.
      CHECK(EntireFunctions(z)(n) == doctest::Approx(truth).epsilon(1e-13));
    }
}

TEST_CASE("entire functions obey F_n = 1/n! + z F_{n+2}") {
  const double inverse_factorial[] = {1.0, 1.0, 0.5, 1.0 / 6.0};
  for (double z : kArguments) {
    const EntireFunctions f(z);
    for (int n = 0; n <= 3; ++n) CHECK(f(n) == doctest::Approx(inverse_factorial[n] + z * f(n + 2)).epsilon(1e-14));
  }
}

TEST_CASE("entire functions keep F_0^2 - z F_1^2 = 1") {
  for (double z : kArguments) {
    const EntireFunctions f(z);
    CHECK(f(0) * f(0) - z * f(1) * f(1) == doctest::Approx(1.0).epsilon(1e-12 * std::max(1.0, f(0) * f(0))));
  }
}

TEST_CASE("derivatives of entire functions are those of the series") {
  for (double z : kArguments) {
    const long double h = 1e-6L;
    for (int n = 0; n <= 3; ++n) {
      CAPTURE(z);
      CAPTURE(n);
      const long double z0 = z;
      const double truth = static_cast<double>((series(z0 + h, n) - series(z0 - h, n)) / (2 * h));
      CHECK(EntireFunctions(z).derivative(n) == doctest::Approx(truth).epsilon(1e-10));
    }
  }
}
