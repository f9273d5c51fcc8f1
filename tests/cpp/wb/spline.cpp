#include "wb/spline.hpp"

#include <doctest/doctest.h>

#include <array>
#include <vector>

using mcplan::wb::Spline;

TEST_CASE("splines reproduce cubic polynomials and their derivatives at nodes that are not equally spaced") {
  const std::vector<double> nodes{0.0, 0.1, 0.13, 0.3, 0.31, 0.5, 0.8};
  const int count = static_cast<int>(nodes.size());
  const Spline spline(nodes);
  const auto knot = [&](int i) {
    if (i < 0) return 2.0 * nodes.front() - nodes[-i];
    if (i >= count) return 2.0 * nodes.back() - nodes[2 * (count - 1) - i];
    return nodes[i];
  };
  // Coefficient k of 2 - t + 3 t^2 + 5 t^3 is its blossom at the knots k - 2, k - 1, k, counted from the first node.
  std::vector<double> c;
  for (int k = 0; k < spline.coefficients(); ++k) {
    const double a = knot(k - 2), b = knot(k - 1), d = knot(k);
    c.push_back(2.0 - (a + b + d) / 3.0 + (a * b + a * d + b * d) + 5.0 * a * b * d);
  }
  for (int k = 0; k < count; ++k) {
    const double t = nodes[k];
    const std::array<double, 3> expected{2.0 - t + 3.0 * t * t + 5.0 * t * t * t, -1.0 + 6.0 * t + 15.0 * t * t,
                                         6.0 + 30.0 * t};
    for (int order = 0; order < 3; ++order) {
      double value = 0.0;
      for (int j = 0; j < 3; ++j) value += spline.basis(k, order, j) * c[k + j];
      CHECK(value == doctest::Approx(expected[order]).epsilon(1e-9));
    }
  }
}
