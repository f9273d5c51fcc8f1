#include "rhp/pieces/torque_bound.hpp"

#include "rhp/pieces/contact_rows.hpp"
#include "rhp/pieces/support.hpp"

namespace mcplan::rhp::tests {
namespace {

/// Variables: c 0-2, foothold 3-4, force from 5 on (three, or the pyramid's four edges for odd seeds), then psi.
struct Point {
  Placement placement;
  ContactPoint point;

  explicit Point(unsigned seed) {
    Random random(seed);
    placement = random_placement(random, 3);
    point = {0, random.three(0.1), 5, {}};
    if (seed % 2 == 1) point.edges_W = pyramid_edges(placement, 0.3, 4, true);
  }
  int psi() const { return 5 + (point.edges_W.cols() > 0 ? 4 : 3); }
  Vector3d torque_W(const VectorXd& x) const {
    const Vector3d where =
        placement.origin_W + x[3] * placement.axes_W.col(0) + x[4] * placement.axes_W.col(1) + point.offset_W;
    return (where - x.head<3>()).cross(walkers::force_W(point, placement, x));
  }
};

}  // namespace

TEST_CASE("the six forms add up to the torque about the CoM") {
  for (double unit : {400.0, 1600.0})
    for (unsigned seed = 0; seed < 10; ++seed) {
      CAPTURE(seed);
      const Point at(seed);
      const VectorXd x = Random(seed + 50).vector(at.psi(), 3.0);
      const VectorXd psi = values(TorqueBound(0, at.placement, at.point, unit), x);
      CHECK(psi.minCoeff() >= 0.0);
      const Vector3d torque = at.torque_W(x);
      for (int i = 0; i < 3; ++i)
        CHECK((psi[2 * i] - psi[2 * i + 1]) / 4.0 * 1.5 * unit == doctest::Approx(torque[i]).epsilon(1e-9));
    }
}

TEST_CASE("a force through the CoM has no torque, and its forms are in pairs equal") {
  Point at(2);
  at.point.offset_W.setZero();
  const Vector3d lever(0.1, -0.2, -0.75);
  VectorXd x = VectorXd::Zero(8);
  x.head<3>() = at.placement.origin_W - lever;
  x.segment<3>(5) = at.placement.axes_W.transpose() * (-2.0 * lever);
  const VectorXd psi = values(TorqueBound(0, at.placement, at.point, 400.0), x);
  for (int i = 0; i < 3; ++i) CHECK(psi[2 * i] == doctest::Approx(psi[2 * i + 1]));
}

TEST_CASE("the cost without psi is the sum of the squares of the forms") {
  const Point at(5);
  const VectorXd x = Random(5).vector(at.psi());
  const VectorXd psi = values(TorqueBound(0, at.placement, at.point, 1600.0), x);
  CHECK(values(TorqueCost(0, at.placement, at.point, 1600.0, 0.3), x)[0] == doctest::Approx(0.3 * psi.squaredNorm()));
}

TEST_CASE("with psi as variables the rows are what is missing to the forms") {
  const Point at(6);
  const VectorXd x = Random(7).vector(at.psi() + 6);
  const VectorXd forms = values(TorqueBound(0, at.placement, at.point, 400.0), x.head(at.psi()));
  CHECK((values(TorqueBound(0, at.placement, at.point, 400.0, at.psi()), x) - (forms - x.tail(6))).norm() < 1e-14);
}

TEST_CASE("derivatives of the relaxation") {
  for (unsigned seed : {8u, 9u}) {
    const Point at(seed);
    expect_derivatives(TorqueBound(0, at.placement, at.point, 400.0), seed);
    expect_derivatives(TorqueBound(0, at.placement, at.point, 400.0, at.psi()), seed);
    expect_derivatives(TorqueCost(0, at.placement, at.point, 400.0, 0.2), seed);
  }
}

}  // namespace mcplan::rhp::tests
