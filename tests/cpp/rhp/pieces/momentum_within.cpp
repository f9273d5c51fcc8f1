#include "rhp/pieces/momentum_within.hpp"

#include <algorithm>

#include "rhp/pieces/linear_forces.hpp"

namespace mcplan::rhp::tests {

/// The cubic of Bernstein's form at s.
Vector3d bernstein(const Vector3d (&b)[4], double s) {
  const double r = 1.0 - s;
  return r * r * r * b[0] + 3.0 * r * r * s * b[1] + 3.0 * r * s * s * b[2] + s * s * s * b[3];
}

TEST_CASE("between nodes the rate of the angular momentum is the cubic of the control points") {
  double bump = 0.0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    const Interval i(seed);
    const Matrix3d axes = Random(seed).rotation();
    const VectorXd inner = values(MomentumRateWithin(kPlaces, axes, kMass, kGravity),
                                  row({i.R0, i.R1, i.begin.velocity, i.a0, i.a1}, i.duration()));
    const Vector3d b[] = {i.R0, axes * inner.head<3>(), axes * inner.tail<3>(), i.R1};
    for (double s : {0.1, 0.25, 0.5, 0.8}) {
      const Vector3d rate = i.contacts.rate(s * i.contacts.h, i.at(s).com);
      CHECK((bernstein(b, s) - rate).norm() < 1e-9 * (1.0 + rate.norm()));
      bump = std::max(bump, (rate - (1.0 - s) * i.R0 - s * i.R1).norm());
    }
  }
  CHECK(bump > 10.0);  // N m that limits at the nodes do not see
}

TEST_CASE("limits of the control points and of both ends hold on the whole of the interval") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    const Interval i(seed);
    const VectorXd inner = values(MomentumRateWithin(kPlaces, Matrix3d::Identity(), kMass, kGravity),
                                  row({i.R0, i.R1, i.begin.velocity, i.a0, i.a1}, i.duration()));
    for (int axis = 0; axis < 3; ++axis) {
      const double highest = std::max({i.R0[axis], i.R1[axis], inner[axis], inner[3 + axis]});
      for (int k = 0; k <= 50; ++k)
        CHECK(i.contacts.rate(k / 50.0 * i.contacts.h, i.at(k / 50.0).com)[axis] <= highest + 1e-9);
    }
  }
}

TEST_CASE("the momentum's cost is the integral of its square, which its values at the two ends do not tell") {
  double ratio = 1.0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    CAPTURE(seed);
    Interval i(seed);
    constexpr int kSamples = 300;
    double integral = 0.0;  // midpoints
    for (int k = 0; k < kSamples; ++k)
      integral += i.contacts.h / kSamples * i.at((k + 0.5) / kSamples).momentum.squaredNorm();
    const double cost = values(MomentumSquareOverTime(kPlaces, kMass, kGravity),
                               row({i.begin.momentum, i.R0, i.R1, i.begin.velocity, i.a0, i.a1}, i.duration()))[0];
    CHECK(cost == doctest::Approx(integral).epsilon(1e-4));
    const double sampled = 0.5 * i.contacts.h * (i.begin.momentum.squaredNorm() + i.end.momentum.squaredNorm());
    ratio = std::max({ratio, cost / sampled, sampled / cost});
  }
  CHECK(ratio > 1.2);
}

TEST_CASE("derivatives of what the momentum does between nodes") {
  expect_derivatives(MomentumRateWithin(kPlaces, Random(5).rotation(), 3.0, kGravity), 14);
  expect_derivatives(MomentumSquareOverTime(kPlaces, 3.0, kGravity), 15);
}

}  // namespace mcplan::rhp::tests
