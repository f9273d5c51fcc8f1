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
    std::vector<ddp::Instant> instants;
    make_instants(problem, pendulum, x, u, instants);
    interior_reach_cost(problem, x, instants, l, 7.0, rows);
  };
}

Writer sole_turn_of(const ddp::Problem& problem, const ddp::Pendulum& pendulum, double sole_yaw) {
  return [&problem, &pendulum, sole_yaw](const VectorXd& x, const VectorXd& u, Rows& rows) {
    std::vector<ddp::Instant> instants;
    make_instants(problem, pendulum, x, u, instants);
    sole_turn_cost(problem, instants, 1, sole_yaw, 7.0, rows);
  };
}

ddp::Pendulum pendulum_of(const ddp::Problem& problem) {
  return {problem.layout, problem.inertia, problem.options.stiffness_input, problem.model};
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

TEST_CASE("reach and turn of the sole: gradients, at the knot and inside the phase") {
  for (ddp::Model model : kModels) {
    const ddp::Problem problem = workshop(phases(6, model));
    const ddp::Pendulum pendulum = pendulum_of(problem);
    REQUIRE(problem.layout.axis_count() == 3);
    check_rows(problem, reach_of(problem), 44, 0.5, 60);
    for (int l : {0, 3}) check_rows(problem, interior_reach_of(problem, pendulum, l), 45, 0.1, 40);
    // The paper's model knows no headings of soles.
    for (double yaw : {-0.4, 1.2}) {
      const Writer sole_turn = sole_turn_of(problem, pendulum, yaw);
      if (model == ddp::Model::wrench)
        check_rows(problem, sole_turn, 60, 0.1, 40);
      else
        CHECK(values(problem, sole_turn, VectorXd::Zero(problem.layout.nz())).size() == 0);
    }
  }
}

TEST_CASE("reach is a box in the base's frame, planned smaller by its margin; nothing is written inside") {
  for (ddp::Model model : kModels) {
    const ddp::Problem problem = workshop(phases(6, model));
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
}

TEST_CASE("between the knots the box moves with the CoM") {
  for (ddp::Model model : kModels) {
    ddp::Options options = phases(6, model);
    options.interior_points = 2;
    const ddp::Problem problem = workshop(options);
    const ddp::Layout& at = problem.layout;
    const ddp::Pendulum pendulum = pendulum_of(problem);
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
}

TEST_CASE("between the knots the box turns with the base, at the angle of the instant") {
  ddp::Options options = phases(6);
  options.interior_points = 1;
  const ddp::Problem problem = workshop(options);
  const ddp::Layout& at = problem.layout;
  const ddp::Pendulum pendulum = pendulum_of(problem);
  // In flight without gravity's share: the middle of the phase is where the CoM was, the base has turned half way.
  VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
  const double h = 0.4, turned = 0.6;
  u[at.duration()] = h;
  x[at.velocity() + 2] = 0.25 * h;
  x[at.momentum(2)] = problem.inertia[2] * turned / h;
  const auto price = [&](double yaw) {
    x.segment<3>(at.end(0)) = mcplan::rotation_from_rpy({0, 0, yaw}) * problem.limits[0].nominal;
    return cost(problem, interior_reach_of(problem, pendulum, 0), x, u);
  };
  CHECK(price(0.5 * turned) <= 1e-20);
  // 0.1 m cos 1.2 = 0.036 m aside of the base, where the box begins at 0.05 m.
  CHECK(price(0.5 * turned + 1.2) > 1e-3);
  CHECK(price(0.5 * turned - 1.2) > 1e-3);
}

TEST_CASE("the sole may be turned against the base by its range, at every instant") {
  ddp::Options options = phases(6);
  options.interior_points = 1;
  const ddp::Problem problem = workshop(options);  // a range of [-0.3, 0.5] rad
  const ddp::Layout& at = problem.layout;
  const ddp::Pendulum pendulum = pendulum_of(problem);
  VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
  u[at.duration()] = 0.4;
  x[at.angle(2)] = 0.2;
  const auto price = [&](double yaw) {
    return cost(problem, sole_turn_of(problem, pendulum, yaw), x, u) / (0.5 * 49.0);
  };
  CHECK(price(-0.09) == 0.0);
  CHECK(price(0.69) == 0.0);
  CHECK(price(-0.2) == doctest::Approx(3 * 0.01));  // three instants
  CHECK(price(0.8) == doctest::Approx(3 * 0.01));
  // Turning under the standing sole, by 0.4 rad: 0, 0.2 and 0.4 rad beyond.
  x[at.momentum(2)] = problem.inertia[2];
  CHECK(price(-0.1) == doctest::Approx(0.04 + 0.16).epsilon(1e-6));
}
