#include "check_rows.hpp"
#include "mcplan/base/rotation.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

Writer reach_of(const ddp::Problem& problem) {
  return [&problem](const VectorXd& x, const VectorXd&, Rows& rows) { reach_cost(problem, x, rows); };
}

Writer interior_reach_of(const ddp::Problem& problem, const ddp::Pendulum& pendulum, int l) {
  return [&problem, &pendulum, l](const VectorXd& x, const VectorXd& u, Rows& rows) {
    ddp::PendulumStep step;
    std::vector<ddp::Instant> instants;
    make_instants(problem, pendulum, x, u, rows.with_gradient(), step, instants);
    interior_reach_cost(problem, x, instants, l, 7.0, rows);
  };
}

/// A base turned about all axes, every end-effector at its nominal place in the base's frame.
VectorXd nominal(const ddp::Problem& problem) {
  VectorXd x = VectorXd::Zero(problem.layout.nx());
  const Vector3d com(0.3, -0.2, 1.1), rpy(0.3, -0.2, 1.0);
  x.segment<3>(problem.layout.com()) = com;
  x.segment<3>(problem.layout.angle()) = rpy;
  for (int l = 0; l < problem.layout.ends(); ++l)
    x.segment<3>(problem.layout.end(l)) = com + mcplan::rotation_from_rpy(rpy) * problem.limits[l].nominal;
  return x;
}

}  // namespace

TEST_CASE("reach: gradients, at the knot and inside the phase") {
  const ddp::Problem problem = workshop();
  const ddp::Pendulum pendulum(problem.layout, problem.inertia, problem.options.stiffness_input);
  REQUIRE(problem.layout.axis_count() == 3);
  check_rows(problem, reach_of(problem), 44, 0.5, 60);
  for (int l : {0, 3}) check_rows(problem, interior_reach_of(problem, pendulum, l), 45, 0.5, 40);
}

TEST_CASE("reach is a box in the base's frame, planned smaller by its margin; nothing is written inside") {
  const ddp::Problem problem = workshop();
  const VectorXd inside = nominal(problem), u;
  CHECK(values(problem, reach_of(problem),
               (VectorXd(problem.layout.nz()) << inside, VectorXd::Zero(problem.layout.nu())).finished())
            .size() == 0);
  const Eigen::Matrix3d r = mcplan::rotation_from_rpy(inside.segment<3>(problem.layout.angle()));
  const double margin = problem.options.reach_margin_m / 0.7;
  for (int l = 0; l < 4; ++l)
    for (int i = 0; i < 3; ++i) {
      VectorXd x = inside;
      const mcplan::EndEffector& end = problem.robot.end_effectors[l];
      const double to_edge = (end.reach_max_B[i] - end.nominal_B[i]) / 0.7;
      x.segment<3>(problem.layout.end(l)) += (to_edge + 0.05) * r.col(i);
      const double beyond = 0.05 + margin;
      CHECK(cost(problem, reach_of(problem), x, u) == doctest::Approx(0.5 * 100.0 * 100.0 * beyond * beyond));
      x.segment<3>(problem.layout.end(l)) -= (0.0501 + margin) * r.col(i);
      CHECK(cost(problem, reach_of(problem), x, u) == 0.0);
    }
}

TEST_CASE("between the knots the box moves with the CoM") {
  ddp::Options options = phases(6);
  options.interior_points = 2;
  const ddp::Problem problem = workshop(options);
  const ddp::Layout& at = problem.layout;
  const ddp::Pendulum pendulum(at, problem.inertia, problem.options.stiffness_input);
  VectorXd x = nominal(problem), u = VectorXd::Zero(at.nu());
  x.segment(at.angle(), 3).setZero();
  for (int l = 0; l < 4; ++l) x.segment<3>(at.end(l)) = x.segment<3>(at.com()) + problem.limits[l].nominal;
  u[at.duration()] = 1.5;
  x[at.velocity() + 2] = 0.75;  // ballistic: back at the same height after 1.5, 0.25 above it at 0.5 and 1.0
  CHECK(cost(problem, interior_reach_of(problem, pendulum, 0), x, u) ==
        doctest::Approx(2 * 0.5 * 49.0 * std::pow(0.25 - (0.05 / 0.7 - problem.options.reach_margin_m / 0.7), 2)));
  x[at.velocity() + 2] = 0.0;
  u[at.duration()] = 1e-3;
  CHECK(cost(problem, interior_reach_of(problem, pendulum, 0), x, u) == 0.0);
}
