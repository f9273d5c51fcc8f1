#include <doctest/doctest.h>

#include <cmath>

#include "ddp/problem.hpp"
#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;
using Eigen::Vector3d;

}  // namespace

TEST_CASE("left to the planner, the number of steps grows with the way; the paper's scenes have the paper's 18") {
  const auto steps = [](const mcplan::Scene& scene) { return Problem(scene, scenes::humanoid44(), Options{}).steps; };
  for (const mcplan::Scene& scene : scenes::all_four()) CHECK(steps(scene) == 18);
  const auto plain = [&](double length) {
    mcplan::Scene scene = scenes::flat(length);
    scene.surfaces = {scenes::rectangle("ground", -1, length + 1, -5, 5, 0)};
    return scene;
  };
  const int ten = steps(plain(10.0)), twenty = steps(plain(20.0));
  CHECK(ten > 18);
  CHECK(ten >= 2 * 10.0 / 0.6);  // a stride of 0.6 m at most, a swing and a phase of support each
  CHECK(twenty == doctest::Approx(2 * ten).epsilon(0.1));
  CHECK(Problem(plain(10.0), scenes::humanoid44(), phases(12)).steps == 12);
}

TEST_CASE("the reference runs from start to goal and rests at both") {
  for (Model model : kModels) {
    mcplan::Scene scene = scenes::stairs();
    scene.goal.yaw = 0.5;
    const Problem problem(scene, scenes::humanoid44(), phases(16, model));
    const Layout& at = problem.layout;
    const int yaw = at.axis_count() - 1;
    const auto& x = problem.reference.x;
    REQUIRE(x.size() == 17);
    CHECK((x.back().segment<3>(at.com()) * 0.7 - Vector3d(1.6, 0, 1.0)).norm() < 1e-12);
    CHECK(x.back()[at.angle(yaw)] == doctest::Approx(0.5));
    CHECK(x[8][at.com()] * 0.7 == doctest::Approx(0.8));
    for (int k : {0, 16}) CHECK(x[k].segment<3>(at.velocity()).norm() == 0.0);
    for (int k : {0, 16}) CHECK(x[k].segment(at.momentum(), at.axis_count()).norm() == 0.0);
    // v_ref is the derivative of p_ref, and L_ref that of the angles times the inertia.
    const double dt = 2 * problem.duration_initial;
    for (int k = 1; k < 16; ++k) {
      CHECK(x[k][at.velocity()] == doctest::Approx((x[k + 1][at.com()] - x[k - 1][at.com()]) / dt).epsilon(0.1));
      CHECK(
          x[k][at.momentum(yaw)] ==
          doctest::Approx(problem.inertia.z() * (x[k + 1][at.angle(yaw)] - x[k - 1][at.angle(yaw)]) / dt).epsilon(0.1));
    }
  }
}

TEST_CASE("at another pace the reference is that of a problem whose phases are first guessed to last as long") {
  for (Model model : kModels) {
    mcplan::Scene scene = scenes::stairs();
    scene.goal.yaw = 0.5;
    mcplan::ddp::Options options = phases(16, model);
    Problem problem(scene, scenes::humanoid44(), options);
    options.duration_initial_s = 0.25;
    const Problem other(scene, scenes::humanoid44(), options);
    problem.set_pace(other.duration_initial);
    CHECK(problem.duration_initial == other.duration_initial);
    for (int k = 0; k <= 16; ++k) CHECK((problem.reference.x[k] - other.reference.x[k]).norm() < 1e-12);
  }
}

TEST_CASE("where the goal is turned, the reference's feet turn with the base") {
  mcplan::Scene scene = scenes::flat(0.0);
  scene.start.yaw = -0.3;
  scene.goal.yaw = 1.8;
  for (Model model : kModels) {
    const Problem problem(scene, scenes::humanoid44(), phases(16, model));
    const Layout& at = problem.layout;
    for (int k = 0; k <= 16; ++k) {
      const VectorXd& x = problem.reference.x[k];
      const double s = k / 16.0, yaw = -0.3 + 2.1 * s * s * (3 - 2 * s);
      CHECK(problem.rpy(x).z() == doctest::Approx(yaw));
      for (int l : {0, 1}) {
        const double side = l == 0 ? -0.1 / 0.7 : 0.1 / 0.7;  // across the base, the same all the way
        const Vector3d expected(-side * std::sin(yaw), side * std::cos(yaw), 0.0);
        CHECK((x.segment<3>(at.end(l)) - expected).norm() <= 1e-12);
      }
    }
    CHECK(problem.start_yaw == std::vector<double>(2, -0.3));
    CHECK(problem.goal_yaw == 1.8);
  }
}

TEST_CASE("standing soles head where the base does on average, at start and goal as given, swinging ones with it") {
  mcplan::Scene scene = scenes::flat();
  scene.start.yaw = 0.2;
  scene.goal.yaw = 1.0;
  const Problem problem(scene, scenes::humanoid44(), phases(8));
  const Layout& at = problem.layout;
  Trajectory t = problem.initial_guess({});
  const std::vector<double> base{0.25, 0.3, 0.35, 0.5, 0.6, 0.7, 0.9, 0.93, 0.97};
  for (int k = 0; k <= 8; ++k) t.x[k][at.angle(2)] = base[k];
  const ContactState both{0, 0}, right{0, kFree}, left{kFree, 0};
  problem.set_sole_yaw({both, left, both, both, right, both, left, both, both}, t);
  const auto of = [&](int l) {
    std::vector<double> out;
    for (const auto& row : t.sole_yaw) out.push_back(row[l]);
    return out;
  };
  REQUIRE(t.sole_yaw.size() == 9);
  // The right foot stands in phase 0, from 2 to 5 (knots 2 to 6), and from 7 to the end.
  const double right_yaw = (0.35 + 0.5 + 0.6 + 0.7 + 0.9) / 5;
  const std::vector<double> expected_right{0.2, 0.3, right_yaw, right_yaw, right_yaw, right_yaw, 0.9, 1.0, 1.0};
  // The left foot from 0 to 3 (the start's), and from 5 to the end (the goal's).
  const std::vector<double> expected_left{0.2, 0.2, 0.2, 0.2, 0.6, 1.0, 1.0, 1.0, 1.0};
  for (int k = 0; k <= 8; ++k) {
    CAPTURE(k);
    CHECK(of(0)[k] == doctest::Approx(expected_right[k]));
    CHECK(of(1)[k] == doctest::Approx(expected_left[k]));
    // At the knot at which it is lifted a sole still heads as it stood.
    CHECK(t.knot_yaw[k][0] == doctest::Approx(k == 1 ? 0.2 : k == 6 ? right_yaw : expected_right[k]));
    CHECK(t.knot_yaw[k][1] == doctest::Approx(k == 4 ? 0.2 : expected_left[k]));
  }
  // A contact that ends at the last knot but is not the goal's goes by the base again; whoever never steps keeps to the
  // start's.
  problem.set_sole_yaw(ContactSequence(9, both), t);
  for (int l : {0, 1}) CHECK(of(l) == std::vector<double>(9, 0.2));
}

TEST_CASE("a first guess puts the weight on those in contact, or on all when the sequence is open") {
  for (auto input : {StiffnessInput::mu, StiffnessInput::lambda}) {
    Options options = phases(18);
    options.stiffness_input = input;
    const Problem problem(scenes::gap_with_rail(), scenes::humanoid44(), options);
    const auto mu = [&](const VectorXd& u, int l) {
      const double value = u[problem.layout.stiffness(l)];
      return input == StiffnessInput::lambda ? value * value : value;
    };
    const Trajectory open = problem.initial_guess({});
    ContactSequence sequence(19, problem.start_contacts);
    sequence[3] = {kFree, 0, kFree, kFree};
    sequence[5] = {kFree, kFree, 2, 3};
    const Trajectory given = problem.initial_guess(sequence);
    for (int l = 0; l < 4; ++l) {
      CHECK(mu(open.u[4], l) == doctest::Approx(0.25));
      CHECK(mu(given.u[4], l) == doctest::Approx(l < 2 ? 0.5 : 0.0));
      CHECK(mu(given.u[3], l) == doctest::Approx(l == 1 ? 1.0 : 0.0));
      CHECK(mu(given.u[5], l) == doctest::Approx(l < 2 ? 0.0 : 0.5));
    }
    CHECK(given.u.size() == 18);
  }
}
