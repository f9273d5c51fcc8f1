#include "check_rows.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

enum { before, after, right_pad, left_pad, slope };

struct Bench {
  explicit Bench(const ddp::Options& options) : problem(workshop(options)) {}
  ddp::Problem problem;

  Writer friction(int l, int surface) const { return term(problem, "friction", {2, l, surface, 100.0, 3.0}); }
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

TEST_CASE("friction: gradients") {
  for (ddp::Model model : kModels)
    for (auto input : {ddp::StiffnessInput::mu, ddp::StiffnessInput::lambda})
      for (int sides : {0, 5}) {
        ddp::Options options = pyramid(sides);
        options.model = model;
        options.stiffness_input = input;
        const Bench bench(options);
        for (int surface : {before, slope}) check_rows(bench.problem, bench.friction(1, surface), 48, 0.8, 40);
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

TEST_CASE("friction is held between the knots alone, and only where the options ask for it") {
  ddp::Options options = phases(6);
  for (bool friction : {true, false})
    for (double interior : {0.0, 3.0}) {
      options.friction = friction;
      const ddp::Problem problem = workshop(options);
      VectorXd x = VectorXd::Zero(problem.layout.nx()), u = VectorXd::Zero(problem.layout.nu());
      x.segment<3>(problem.layout.com()) = Vector3d(3, 0, 1);
      const double price = cost(problem, term(problem, "friction", {2, 1, before, 100.0, interior}), x, u);
      CHECK((price > 0.0) == (friction && interior > 0.0));
    }
}
