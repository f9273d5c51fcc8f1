#include "check_rows.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

enum { before, after, right_pad, left_pad, slope };

struct Bench {
  explicit Bench(const ddp::Options& options, bool with_slope = true)
      : problem(workshop(options, with_slope)),
        pendulum(problem.layout, problem.inertia, options.stiffness_input, options.model) {}
  ddp::Problem problem;
  ddp::Pendulum pendulum;

  Writer friction(int l, int surface) const {
    return [=](const VectorXd& x, const VectorXd& u, Rows& rows) {
      friction_cost(problem, x, u, instants(x, u), l, surface, 3.0, rows);
    };
  }
  Writer force_cap(int l) const {
    return [=](const VectorXd& x, const VectorXd& u, Rows& rows) {
      force_cap_cost(problem, pendulum, x, u, instants(x, u), l, 3.0, rows);
    };
  }
  std::vector<ddp::Instant> instants(const VectorXd& x, const VectorXd& u) const {
    std::vector<ddp::Instant> out;
    make_instants(problem, pendulum, x, u, out);
    return out;
  }
  /// By how much the friction of end-effector 1 is exceeded when the CoM is `above` it for an instant, so that all
  /// instants coincide; squared. Its force's line may start elsewhere.
  double beyond_cone(const Vector3d& above, int surface, const Vector3d& line = Vector3d::Zero()) const {
    const ddp::Layout& at = problem.layout;
    VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
    x.segment<3>(at.com()) = above;
    u.segment(at.force_line(1), at.force_line_count(1)) = at.offsets(1).force_line.transpose() * line;
    return cost(problem, friction(1, surface), x, u) / ((problem.options.interior_points + 2) * 0.5 * 9.0);
  }
};

constexpr double kFriction = 0.7 - 0.02;  // planned a little tighter than the surface

ddp::Options pyramid(int sides) {
  ddp::Options options = phases(6);
  options.friction_sides = sides;
  return options;
}

}  // namespace

TEST_CASE("friction and force cap: gradients") {
  for (ddp::Model model : kModels)
    for (auto input : {ddp::StiffnessInput::mu, ddp::StiffnessInput::lambda})
      for (int sides : {0, 5}) {
        ddp::Options options = pyramid(sides);
        options.model = model;
        options.stiffness_input = input;
        const Bench bench(options);
        for (int surface : {before, slope}) check_rows(bench.problem, bench.friction(1, surface), 48, 0.8, 40);
        const Writer capped = [&](const VectorXd& x, const VectorXd& u, Rows& rows) {
          VectorXd stiff = u;
          stiff[bench.problem.layout.stiffness(1)] += input == ddp::StiffnessInput::lambda ? 2.0 : 5.0;
          bench.force_cap(1)(x, stiff, rows);
        };
        if (sides == 0) check_rows(bench.problem, capped, 49, 0.5, 40);
      }
}

TEST_CASE("friction: the line from contact to CoM stays in the cone about the surface's normal") {
  for (ddp::Model model : kModels) {
    const Bench bench(phases(6, model));
    CHECK(bench.beyond_cone({0, 0, 1}, before) == 0.0);
    CHECK(bench.beyond_cone({0.67, 0, 1}, before) == 0.0);
    CHECK(bench.beyond_cone({0.6, 0.8, 1}, before) == doctest::Approx(std::pow(1.0 - kFriction, 2)));
    CHECK(bench.beyond_cone({0, 0, -1}, before) == doctest::Approx(kFriction * kFriction));  // it would have to pull
    // On the slope the cone leans with the normal: what is vertical costs nothing still, downhill does.
    const Vector3d normal = bench.problem.polygons[slope].normal_W();
    CHECK(normal.x() < -0.4);
    CHECK(bench.beyond_cone(normal, slope) == 0.0);
    CHECK(bench.beyond_cone({0, 0, 1}, slope) == 0.0);
    CHECK(bench.beyond_cone({0.2, 0, 1}, slope) > 1e-3);
    // What may be held has no cone.
    CHECK(bench.beyond_cone({3, 0, 0.1}, right_pad) == 0.0);
  }
}

TEST_CASE("friction: a force line that starts elsewhere leans elsewhere") {
  const Bench bench(phases(6));
  CHECK(bench.beyond_cone({1.0, 0.1, 1}, before) > 0.1);
  CHECK(bench.beyond_cone({1.0, 0.1, 1}, before, {1.0, 0.1, 0}) == 0.0);
  CHECK(bench.beyond_cone({0, 0, 1}, before, {0.6, 0.8, 0}) == doctest::Approx(std::pow(1.0 - kFriction, 2)));
}

TEST_CASE("a pyramid lies inside the cone, touches it along its edges, and leaves out less the more sides it has") {
  for (int surface : {before, slope}) {
    const Bench cone(pyramid(0));
    const Eigen::Matrix3d frame = cone.problem.sole_frame(surface, 0.0);
    const Vector3d n = frame.col(2);
    double last_share = 0.0;
    for (int sides : {3, 4, 8, 24}) {
      CAPTURE(sides);
      const Bench bench(pyramid(sides));
      REQUIRE(bench.problem.pyramid[surface].size() == static_cast<std::size_t>(sides));
      for (int i = 0; i < sides; ++i) {
        const double middle = 2.0 * M_PI * i / sides, edge = middle + M_PI / sides;
        const auto leaning = [&](double angle, double tangent) -> Vector3d {
          return n + tangent * (std::cos(angle) * frame.col(0) + std::sin(angle) * frame.col(1));
        };
        const double narrow = kFriction * std::cos(M_PI / sides);
        CHECK(bench.beyond_cone(leaning(middle, 0.999 * narrow), surface) == 0.0);
        CHECK(bench.beyond_cone(leaning(middle, narrow + 0.1), surface) >= 0.01 * (1 - 1e-9));
        CHECK(bench.beyond_cone(leaning(edge, 0.999 * kFriction), surface) == 0.0);
        CHECK(bench.beyond_cone(leaning(edge, 1.001 * kFriction), surface) > 0.0);
      }
      // Share of the cone's directions, at unit height, that the pyramid admits: sin(2 pi/n) n / (2 pi).
      Random random(58);
      int admitted = 0;
      constexpr int kDraws = 2000;
      for (int i = 0; i < kDraws; ++i) {
        const double angle = uniform(random, 0, 2.0 * M_PI), tangent = kFriction * std::sqrt(uniform(random, 0, 1.3));
        const Vector3d d = n + tangent * (std::cos(angle) * frame.col(0) + std::sin(angle) * frame.col(1));
        const bool inside = bench.beyond_cone(d, surface) == 0.0;
        if (inside) CHECK(cone.beyond_cone(d, surface) == 0.0);
        admitted += inside;
      }
      const double share = 1.3 * admitted / kDraws, exact = sides * std::sin(2.0 * M_PI / sides) / (2.0 * M_PI);
      CHECK(share == doctest::Approx(exact).epsilon(0.06));
      CHECK(share > last_share);
      last_share = share;
    }
  }
}

TEST_CASE("force cap: mu |p - s_l| against the end-effector's largest force, nothing written below it") {
  for (ddp::Model model : kModels) {
    const Bench bench(phases(6, model));
    const ddp::Layout& at = bench.problem.layout;
    const double cap = 1750.0 / (44.0 * 9.8);
    const auto price = [&](double stiffness, double line) {
      VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
      x.segment<3>(at.com()) = Vector3d(0.6 + line, 0, 0.8);
      if (at.force_line_count(1) > 0) u[at.force_line(1)] = line;
      u[at.stiffness(1)] = stiffness;
      const int instants = bench.problem.options.interior_points + 2;
      return cost(bench.problem, bench.force_cap(1), x, u) / (instants * 0.5 * 9.0);
    };
    for (double line : {0.0, 0.4}) {
      if (model == ddp::Model::lipm && line != 0.0) continue;
      CHECK(price(0.99 * cap, line) == 0.0);
      CHECK(price(cap + 0.5, line) == doctest::Approx(0.25));
    }
  }
}

TEST_CASE("torsion: a foot that hardly presses cannot twist; points and grips are not judged by a sole") {
  for (ddp::Model model : kModels)
    for (auto input : {ddp::StiffnessInput::mu, ddp::StiffnessInput::lambda}) {
      ddp::Options options = phases(6, model);
      options.stiffness_input = input;
      const Bench bench(options, false);  // without the slope: one normal, so one moment a foot
      const ddp::Layout& at = bench.problem.layout;
      const Writer torsion = [&](const VectorXd& x, const VectorXd& u, Rows& rows) {
        torsion_cost(bench.problem, bench.pendulum, x, u, bench.instants(x, u), 1, before, 3.0, rows);
      };
      check_rows(bench.problem, torsion, 53, 0.5, 30);
      // Friction 0.68 under a sole 0.05 m to either side, the CoM at 0.8 of its height, all instants at once.
      const double arm = 0.68 * 0.05 / 0.7, ratio = 0.8 * arm;
      CHECK(torsion_arm(bench.problem, 1, before) == doctest::Approx(arm));
      VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
      x.segment<3>(at.com()) = Vector3d(0.3, -0.2, 0.8);
      u[at.stiffness(1)] = input == ddp::StiffnessInput::lambda ? std::sqrt(0.5) : 0.5;
      const int last = at.moment_count() - 1, yaw = at.moment(last);
      REQUIRE(at.moments()[last].end_effector == 1);
      REQUIRE(at.moments()[last].direction_W == Vector3d::UnitZ());
      for (double sign : {1.0, -1.0}) {
        const int instants = options.interior_points + 2;
        u[yaw] = sign * 0.499 * ratio;
        CHECK(cost(bench.problem, torsion, x, u) == 0.0);
        u[yaw] = sign * (0.5 * ratio + 0.1);
        CHECK(cost(bench.problem, torsion, x, u) == doctest::Approx(instants * 0.5 * 9.0 * 0.01));
      }
      CHECK(std::isinf(torsion_arm(bench.problem, 2, right_pad)));
      CHECK(std::isinf(torsion_arm(bench.problem, 2, before)));  // a hand is a point
    }
}

TEST_CASE("torsion: no moment but about the surface's normal, which is what the centre of pressure does") {
  const Bench bench(phases(6));
  const ddp::Layout& at = bench.problem.layout;
  REQUIRE(at.moment_count() == 6);  // the feet's surfaces have different normals
  const double limit = 0.5 * 100.0 * 100.0;
  for (int surface : {before, slope}) {
    const Writer torsion = [&](const VectorXd& x, const VectorXd& u, Rows& rows) {
      torsion_cost(bench.problem, bench.pendulum, x, u, bench.instants(x, u), 1, surface, 3.0, rows);
    };
    check_rows(bench.problem, torsion, 59, 0.5, 30);
    for (int i = 0; i < 6; ++i) {
      VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
      x[at.com() + 2] = 1.0;
      u[at.stiffness(1)] = 0.5;
      u[at.moment(i)] = 0.005;  // less than the sole bears about its normal
      const bool mine = at.moments()[i].end_effector == 1;
      const bool normal = surface == before && at.moments()[i].direction_W == Vector3d::UnitZ();
      CHECK(cost(bench.problem, torsion, x, u) == doctest::Approx(mine && !normal ? limit * 0.005 * 0.005 : 0.0));
    }
  }
}
