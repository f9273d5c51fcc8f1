#include "check_rows.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

/// The workshop whose left foot is taken for a point foot of a robot that is tracked.
ddp::Problem on_a_point(const ddp::Options& options) {
  ddp::Problem problem = workshop(options);
  problem.limits[1].balances = true;
  return problem;
}

}  // namespace

TEST_CASE("upright: gradients, in discovery and between the knots") {
  const ddp::Problem problem = on_a_point(phases(6));
  for (double interior_weight : {0.0, 3.0})
    check_rows(problem, term(problem, "upright", {2, 1, 0, 100.0, interior_weight}), 61, 0.3, 40);
}

TEST_CASE("upright: the tangent of the force against the vertical, of balancing feet alone") {
  const ddp::Problem problem = on_a_point(phases(6));
  const ddp::Layout& at = problem.layout;
  const auto price = [&](int l, double tilt) {
    VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
    x.segment<3>(at.com()) = Vector3d(0.6 + tilt, 0.1, 1.0);
    x.segment<3>(at.end(l)) = Vector3d(0.2, 0.3, 0.0);
    u.segment<2>(at.force_line(l)) << 0.4, -0.2;
    return cost(problem, term(problem, "upright", {2, l, 0, 100.0, 0.0}), x, u);
  };
  CHECK(price(1, 0.0) == doctest::Approx(0.0));
  CHECK(price(1, 0.2) == doctest::Approx(0.5 * 0.04));
  CHECK(price(0, 0.2) == 0.0);
}
