#include "mcplan/rhp/pieces/torque_bound.hpp"

#include "rhp/pieces/support.hpp"

namespace mcplan::rhp::tests {
namespace {

/// Variables: c 0-2, foothold 3-4, force 5-7, psi 8-13.
struct Point {
  Placement placement;
  ContactPoint point;

  explicit Point(unsigned seed) {
    Random random(seed);
    placement = random_placement(random, 3);
    point = {0, random.three(0.1), 5};
  }
  Vector3d torque_W(const VectorXd& x) const {
    const Vector3d where = placement.origin_W + x[3] * placement.axes_W.col(0) + x[4] * placement.axes_W.col(1) + point.offset_W;
    const Vector3d force = 100.0 * (placement.axes_W * x.segment<3>(5));
    return (where - x.head<3>()).cross(force);
  }
};

}  // namespace

TEST_CASE("the six forms add up to the torque about the CoM") {
  for (double unit : {400.0, 1600.0})
    for (unsigned seed = 0; seed < 10; ++seed) {
      CAPTURE(seed);
      const Point at(seed);
      const VectorXd x = Random(seed + 50).vector(8, 3.0);
      const VectorXd psi = values(TorqueBound(0, at.placement, at.point, unit), x);
      CHECK(psi.minCoeff() >= 0.0);
      const Vector3d torque = at.torque_W(x);
      for (int i = 0; i < 3; ++i)
        CHECK((psi[2 * i] - psi[2 * i + 1]) / 4.0 * 1.5 * unit == doctest::Approx(torque[i]).epsilon(1e-9));
    }
}

TEST_CASE("a force through the CoM has no torque, and its forms are in pairs equal") {
  Point at(3);
  at.point.offset_W.setZero();
  const Vector3d lever(0.1, -0.2, -0.75);
  VectorXd x = VectorXd::Zero(8);
  x.head<3>() = at.placement.origin_W - lever;
  x.segment<3>(5) = at.placement.axes_W.transpose() * (-2.0 * lever);
  const VectorXd psi = values(TorqueBound(0, at.placement, at.point, 400.0), x);
  for (int i = 0; i < 3; ++i) CHECK(psi[2 * i] == doctest::Approx(psi[2 * i + 1]));
}

TEST_CASE("the cost without psi is the sum of the squares of the forms") {
  const Point at(4);
  const VectorXd x = Random(5).vector(8);
  const VectorXd psi = values(TorqueBound(0, at.placement, at.point, 1600.0), x);
  CHECK(values(TorqueCost(0, at.placement, at.point, 1600.0, 0.3), x)[0] == doctest::Approx(0.3 * psi.squaredNorm()));
}

TEST_CASE("with psi as variables the rows are what is missing to the forms") {
  const Point at(6);
  const VectorXd x = Random(7).vector(14);
  const VectorXd forms = values(TorqueBound(0, at.placement, at.point, 400.0), x.head(8));
  CHECK((values(TorqueBound(0, at.placement, at.point, 400.0, 8), x) - (forms - x.tail(6))).norm() < 1e-14);
}

TEST_CASE("derivatives of the relaxation") {
  for (unsigned seed : {8u, 9u}) {
    const Point at(seed);
    expect_derivatives(TorqueBound(0, at.placement, at.point, 400.0), seed);
    expect_derivatives(TorqueBound(0, at.placement, at.point, 400.0, 8), seed);
    expect_derivatives(TorqueCost(0, at.placement, at.point, 400.0, 0.2), seed);
  }
}

}  // namespace mcplan::rhp::tests
