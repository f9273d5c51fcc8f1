#include "plan/convex_min.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

TEST_CASE("a convex function is least where it is said to be, in the middle or at an end") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1.0, 2.0);
  for (int i = 0; i < 200; ++i) {
    const double least = number(random), slope = 0.2 + std::abs(number(random));
    const auto square = [&](double s) { return slope * (s - least) * (s - least); };
    const auto bent = [&](double s) { return std::max(slope * (least - s), 2.0 * slope * (s - least)); };
    const double inside = std::clamp(least, 0.0, 1.0);
    CHECK(std::abs(mcplan::convex_min(square) - inside) < 1e-5);
    CHECK(std::abs(mcplan::convex_min(bent) - inside) < 1e-5);
  }
}
