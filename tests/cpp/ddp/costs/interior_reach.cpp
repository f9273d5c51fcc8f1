#include "check_rows.hpp"
#include "mcplan/base/rotation.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

Writer interior_reach_of(const ddp::Problem& problem, int l) {
  return term(problem, "interior_reach", {2, l, 0, 3.0, 7.0});
}

}  // namespace

TEST_CASE("reach: gradients inside the phase") {
  for (ddp::Model model : kModels) {
    const ddp::Problem problem = workshop(phases(6, model));
    REQUIRE(problem.layout.axis_count() == 3);
    for (int l : {0, 3}) check_rows(problem, interior_reach_of(problem, l), 45, 0.1, 40);
  }
}

TEST_CASE("between the knots the box moves with the CoM") {
  for (ddp::Model model : kModels) {
    ddp::Options options = phases(6, model);
    options.interior_points = 2;
    const ddp::Problem problem = workshop(options);
    const ddp::Layout& at = problem.layout;
    VectorXd x = nominal(problem), u = VectorXd::Zero(at.nu());
    x.segment(at.angle(), 3).setZero();
    for (int l = 0; l < 4; ++l) x.segment<3>(at.end(l)) = x.segment<3>(at.com()) + problem.limits[l].nominal;
    u[at.duration()] = 1.5;
    x[at.velocity() + 2] = 0.75;  // ballistic: back at the same height after 1.5, 0.25 above it at 0.5 and 1.0
    CHECK(cost(problem, interior_reach_of(problem, 0), x, u) ==
          doctest::Approx(2 * 0.5 * 49.0 * std::pow(0.25 - (0.05 / 0.7 - problem.options.reach_margin_m / 0.7), 2)));
    x[at.velocity() + 2] = 0.0;
    u[at.duration()] = 1e-3;
    CHECK(cost(problem, interior_reach_of(problem, 0), x, u) == 0.0);
  }
}

TEST_CASE("between the knots the box turns with the base, at the angle of the instant") {
  ddp::Options options = phases(6);
  options.interior_points = 1;
  const ddp::Problem problem = workshop(options);
  const ddp::Layout& at = problem.layout;
  // In flight without gravity's share: the middle of the phase is where the CoM was, the base has turned half way.
  VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
  const double h = 0.4, turned = 0.6;
  u[at.duration()] = h;
  x[at.velocity() + 2] = 0.25 * h;
  x[at.momentum(2)] = problem.inertia[2] * turned / h;
  const auto price = [&](double yaw) {
    x.segment<3>(at.end(0)) = mcplan::rotation_from_rpy({0, 0, yaw}) * problem.limits[0].nominal;
    return cost(problem, interior_reach_of(problem, 0), x, u);
  };
  CHECK(price(0.5 * turned) <= 1e-20);
  // 0.1 m cos 1.2 = 0.036 m aside of the base, where the box begins at 0.05 m.
  CHECK(price(0.5 * turned + 1.2) > 1e-3);
  CHECK(price(0.5 * turned - 1.2) > 1e-3);
}
