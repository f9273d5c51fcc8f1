#include "rhp/pieces/costs.hpp"

#include "rhp/pieces/support.hpp"

namespace mcplan::rhp::tests {

TEST_CASE("the cost of a linear function is the integral of its square") {
  constexpr int kIntervals = 5, kSamples = 2000;
  Random random(1);
  for (int trial = 0; trial < 5; ++trial) {
    const Vector3d y0 = random.three(), y1 = random.three();
    const double duration = random.in(0.1, 1.0), h = duration / kIntervals;
    double integral = 0.0;  // midpoints
    for (int i = 0; i < kSamples; ++i) {
      const double s = (i + 0.5) / kSamples;
      integral += h / kSamples * ((1.0 - s) * y0 + s * y1).squaredNorm();
    }
    VectorXd x(7);
    x << y0, y1, duration;
    CHECK(values(LinearSquareOverTime("cost", 0, 3, 6, kIntervals), x)[0] == doctest::Approx(integral).epsilon(1e-6));
  }
}

TEST_CASE("the cost of a held value is a share of the duration times its square") {
  const VectorXd x = (VectorXd(4) << 1.0, 2.0, -2.0, 0.3).finished();
  CHECK(values(SquareOverTime("cost", 0, 3, 0.25), x)[0] == doctest::Approx(0.25 * 0.3 * 9.0));
}

TEST_CASE("the distance to a target counts squared, with its weight") {
  const SquaredDistance piece("goal", 0, Vector3d(1.0, 2.0, 3.0), 10.0);
  CHECK(values(piece, Vector3d(1.0, 2.5, 2.0))[0] == doctest::Approx(12.5));
}

TEST_CASE("derivatives of the costs") {
  expect_derivatives(SquareOverTime("cost", 0, 3, 0.3), 1);
  expect_derivatives(LinearSquareOverTime("cost", 0, 3, 6, 7), 2);
  expect_derivatives(SquaredDistance("goal", 0, Random(3).three(), 10.0), 3);
  expect_derivatives(SquaredDistance("psi", 0, VectorXd::Zero(6), 0.1), 4);
}

}  // namespace mcplan::rhp::tests
