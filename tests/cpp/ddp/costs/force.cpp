#include "check_rows.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

enum { before, after, right_pad, left_pad, slope };

struct Bench {
  explicit Bench(const ddp::Options& options)
      : problem(workshop(options)), pendulum(problem.layout, problem.inertia, options.stiffness_input) {}
  ddp::Problem problem;
  ddp::Pendulum pendulum;

  Writer friction(int l, int surface) const {
    return [=](const VectorXd& x, const VectorXd& u, Rows& rows) {
      friction_cost(problem, x, instants(x, u, rows.with_gradient()), l, surface, 3.0, rows);
    };
  }
  Writer force_cap(int l) const {
    return [=](const VectorXd& x, const VectorXd& u, Rows& rows) {
      force_cap_cost(problem, pendulum, x, u, instants(x, u, rows.with_gradient()), l, 3.0, rows);
    };
  }
  std::vector<ddp::Instant> instants(const VectorXd& x, const VectorXd& u, bool with_gradient) const {
    ddp::PendulumStep step;
    std::vector<ddp::Instant> out;
    make_instants(problem, pendulum, x, u, with_gradient, step, out);
    return out;
  }
};

/// CoM at `above` over end-effector 1 for an instant, so that all instants coincide.
struct Standing {
  VectorXd x, u;
  Standing(const ddp::Layout& at, const Vector3d& above) : x(VectorXd::Zero(at.nx())), u(VectorXd::Zero(at.nu())) {
    x.segment<3>(at.com()) = above;
  }
};

}  // namespace

TEST_CASE("friction and force cap: gradients") {
  ddp::Options options = phases(6);
  for (auto input : {ddp::StiffnessInput::mu, ddp::StiffnessInput::lambda}) {
    options.stiffness_input = input;
    const Bench bench(options);
    for (int surface : {before, slope}) check_rows(bench.problem, bench.friction(1, surface), 48, 0.8, 40);
    const Writer capped = [&](const VectorXd& x, const VectorXd& u, Rows& rows) {
      VectorXd stiff = u;
      stiff[bench.problem.layout.stiffness(1)] += input == ddp::StiffnessInput::lambda ? 2.0 : 5.0;
      bench.force_cap(1)(x, stiff, rows);
    };
    check_rows(bench.problem, capped, 49, 0.5, 40);
  }
}

TEST_CASE("friction: the line from contact to CoM stays in the cone about the surface's normal") {
  const Bench bench(phases(6));
  const ddp::Layout& at = bench.problem.layout;
  const double mu = 0.7 - 0.02;  // planned a little tighter than the surface
  const int instants = bench.problem.options.interior_points + 2;
  const auto price = [&](const Vector3d& above, int surface) {
    const Standing s(at, above);
    return cost(bench.problem, bench.friction(1, surface), s.x, s.u) / (instants * 0.5 * 9.0);
  };
  CHECK(price({0, 0, 1}, before) == 0.0);
  CHECK(price({0.67, 0, 1}, before) == 0.0);
  CHECK(price({0.6, 0.8, 1}, before) == doctest::Approx(std::pow(1.0 - mu, 2)));
  CHECK(price({0, 0, -1}, before) == doctest::Approx(mu * mu));  // the contact would have to pull
  // On the slope the cone leans with the normal: what is vertical costs nothing still, downhill does.
  const Vector3d normal = bench.problem.polygons[slope].normal_W();
  CHECK(normal.x() < -0.4);
  CHECK(price(normal, slope) == 0.0);
  CHECK(price({0, 0, 1}, slope) == 0.0);
  CHECK(price({0.2, 0, 1}, slope) > 1e-3);
  // What may be held has no cone.
  CHECK(price({3, 0, 0.1}, right_pad) == 0.0);
}

TEST_CASE("force cap: mu |p - p_l| against the end-effector's largest force, nothing written below it") {
  const Bench bench(phases(6));
  const ddp::Layout& at = bench.problem.layout;
  const double cap = 1750.0 / (44.0 * 9.8);
  const auto price = [&](double stiffness) {
    Standing s(at, {0.6, 0, 0.8});
    s.u[at.stiffness(1)] = stiffness;
    const int instants = bench.problem.options.interior_points + 2;
    return cost(bench.problem, bench.force_cap(1), s.x, s.u) / (instants * 0.5 * 9.0);
  };
  CHECK(price(0.99 * cap) == 0.0);
  CHECK(price(cap + 0.5) == doctest::Approx(0.25));
}

TEST_CASE("torsion: a foot that hardly presses cannot twist; points and grips are not judged by a sole") {
  ddp::Options options = phases(6);
  for (auto input : {ddp::StiffnessInput::mu, ddp::StiffnessInput::lambda}) {
    options.stiffness_input = input;
    const Bench bench(options);
    const ddp::Layout& at = bench.problem.layout;
    const Writer torsion = [&](const VectorXd&, const VectorXd& u, Rows& rows) {
      torsion_cost(bench.problem, bench.pendulum, u, 1, before, 3.0, rows);
    };
    check_rows(bench.problem, torsion, 53, 0.5, 30);
    // Friction 0.68 under a sole 0.05 m to either side, the CoM at 0.6 of its height.
    const double ratio = 0.6 * 0.68 * 0.05 / 0.7;
    CHECK(moment_per_stiffness(bench.problem, 1, before) == doctest::Approx(ratio));
    VectorXd u = VectorXd::Zero(at.nu());
    u[at.stiffness(1)] = input == ddp::StiffnessInput::lambda ? std::sqrt(0.5) : 0.5;
    const int yaw = at.moment(5);  // left foot about z
    for (double sign : {1.0, -1.0}) {
      u[yaw] = sign * 0.499 * ratio;
      CHECK(cost(bench.problem, torsion, VectorXd(), u) == 0.0);
      u[yaw] = sign * (0.5 * ratio + 0.1);
      CHECK(cost(bench.problem, torsion, VectorXd(), u) == doctest::Approx(0.5 * 9.0 * 0.01));
    }
    CHECK(std::isinf(moment_per_stiffness(bench.problem, 2, right_pad)));
    CHECK(std::isinf(moment_per_stiffness(bench.problem, 2, before)));  // a hand is a point
  }
}
