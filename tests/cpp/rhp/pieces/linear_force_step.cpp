#include "rhp/pieces/linear_force_step.hpp"

#include "rhp/pieces/linear_forces.hpp"

namespace mcplan::rhp::tests {
TEST_CASE("steps under linear forces are zero on an integration by Runge and Kutta") {
  const LinearForceVelocity velocity(kPlaces);
  const LinearForcePosition position(kPlaces);
  const LinearForceMomentum momentum(kPlaces, kMass, kGravity);
  for (unsigned seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    const Interval i(seed);
    CHECK(values(velocity, row({i.begin.velocity, i.end.velocity, i.a0, i.a1}, i.duration())).norm() < 1e-11);
    CHECK(values(position, row({i.begin.com, i.end.com, i.begin.velocity, i.a0, i.a1}, i.duration())).norm() < 1e-11);
    CHECK(values(momentum,
                 row({i.begin.momentum, i.end.momentum, i.R0, i.R1, i.begin.velocity, i.a0, i.a1}, i.duration()))
              .norm() < 1e-8);
  }
}

TEST_CASE("none of the terms of the momentum step can be left out") {
  Vector3d least = Vector3d::Constant(1e9);
  double most = 0.0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Interval i(seed);
    const double h = i.contacts.h;
    const Vector3d trapezoid = i.begin.momentum + h / 2.0 * (i.R0 + i.R1), up = Vector3d::UnitZ();
    const Vector3d terms[] = {-kMass * h * h / 6.0 * i.begin.velocity.cross(i.a0 - i.a1),
                              kMass * h * h * h / 12.0 * i.a0.cross(i.a1),
                              kMass * kGravity * h * h * h / 24.0 * (i.a0 + i.a1).cross(up)};
    most = std::max(most, (i.end.momentum - trapezoid).norm());
    for (int k = 0; k < 3; ++k) {
      const Vector3d others = trapezoid + terms[(k + 1) % 3] + terms[(k + 2) % 3];
      least[k] = std::min(least[k], (i.end.momentum - others).norm());
    }
  }
  CHECK(most > 0.05);  // kg m^2/s in a single interval, by the trapezoidal rule alone
  for (int k = 0; k < 3; ++k) CHECK(least[k] > 1e-6);
}

TEST_CASE("derivatives of the steps under linear forces") {
  expect_derivatives(LinearForceVelocity(kPlaces), 11);
  expect_derivatives(LinearForcePosition(kPlaces), 12);
  expect_derivatives(LinearForceMomentum(kPlaces, 3.0, kGravity), 13);
}

}  // namespace mcplan::rhp::tests
