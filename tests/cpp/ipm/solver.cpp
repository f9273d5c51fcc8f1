#include "mcplan/ipm/solver.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <thread>

#include "mcplan/base/error.hpp"
#include "nlp/problems.hpp"
#include "nlp/valley.hpp"

using namespace mcplan;
using namespace mcplan::nlp;
using namespace mcplan::nlp::tests;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

SolverOptions tight() {
  SolverOptions out;
  out.tolerance = 1e-9;
  out.constraint_tolerance = 1e-9;
  return out;
}

/// A cart [m, m/s] pushed from 0 to 1 in `steps` steps of 0.1 s, |force| <= 4 N, within a lane that bends: a stage
/// problem with dynamics, bounds, a nonlinear row, and a weight that lasts all stages.
struct Cart {
  explicit Cart(int steps, double reach = 1.0) {
    for (int k = 0; k <= steps; ++k) {
      states.push_back(problem.add_variables("state", 2, -kInfinity, kInfinity, {k, k}));
      if (k < steps) inputs.push_back(problem.add_variables("force", 1, -4.0, 4.0, {k, k}));
    }
    const int mass = problem.add_variables("mass", 1, 0.5, 2.0, {0, steps});
    for (int i = 0; i < 2; ++i) {
      problem.set_bounds(states.front() + i, 0.0, 0.0);
      problem.set_bounds(states.back() + i, i == 0 ? reach : 0.0, i == 0 ? reach : 0.0);
    }
    const double h = 0.1;
    for (int k = 0; k < steps; ++k) {
      const int a = states[k], b = states[k + 1], u = inputs[k];
      problem.add_equality(std::make_unique<FunctionPiece>(
          "step", std::vector<int>{a, a + 1, b, b + 1, u, mass}, 2,
          [=](const ConstVector& x, Vector f) {
            f << x[0] + h * x[1] - x[2], x[1] + h * (x[4] - 0.3 * x[1] * x[1]) / x[5] - x[3];
          },
          [=](const ConstVector& x, Matrix J) {
            J.row(0) << 1.0, h, -1.0, 0.0, 0.0, 0.0;
            J.row(1) << 0.0, 1.0 - 0.6 * h * x[1] / x[5], 0.0, -1.0, h / x[5],
                -h * (x[4] - 0.3 * x[1] * x[1]) / (x[5] * x[5]);
          },
          [=](const ConstVector& x, const ConstVector& w, Matrix H) {
            const double m = x[5];
            H(1, 1) = -0.6 * h / m * w[1];
            H(5, 1) = 0.6 * h * x[1] / (m * m) * w[1];
            H(5, 4) = -h / (m * m) * w[1];
            H(5, 5) = 2.0 * h * (x[4] - 0.3 * x[1] * x[1]) / (m * m * m) * w[1];
          }));
      problem.add_cost(squared_norm("effort", {u}));
      problem.add_constraint(squared_norm("speed", {b + 1}), -kInfinity, 1.5);
    }
    problem.add_cost(squared_distance({mass}, VectorXd::Constant(1, 1.0)));
    problem.finish();
  }

  VectorXd start() const { return VectorXd::Constant(problem.variable_count(), 0.6); }

  Problem problem;
  std::vector<int> states, inputs;
};

}  // namespace

TEST_CASE("problem 71 of Hock and Schittkowski: the published optimum and multipliers, with either barrier") {
  const HockSchittkowski71 hs;
  for (const bool adaptive : {false, true}) {
    CAPTURE(adaptive);
    SolverOptions options = tight();
    options.adaptive_barrier = adaptive;
    const Solution s = ipm::solve(hs.problem, hs.x0, options);
    CHECK_MESSAGE(s.outcome == Outcome::converged, s.message);
    CHECK(s.solver == Solver::ipm);
    CHECK((s.x - hs.optimum).lpNorm<Eigen::Infinity>() < 1e-6);
    CHECK(std::abs(s.cost - hs.cost) < 1e-6);
    CHECK(std::abs(s.multipliers[0] + 0.55229366) < 1e-5);
    CHECK(std::abs(s.multipliers[1] - 0.16146857) < 1e-5);
    CHECK(s.worst.value <= 1e-9);
  }
}

TEST_CASE("Rosenbrock's valley, which has no rows") {
  const Valley valley;
  const Solution s = ipm::solve(valley.problem, valley.x0, tight());
  CHECK_MESSAGE(s.outcome == Outcome::converged, s.message);
  CHECK((s.x - Vector2d(1, 1)).lpNorm<Eigen::Infinity>() < 1e-6);
}

TEST_CASE("gradient + Jacobian' multipliers vanishes in the variables that are at no bound") {
  Problem problem;
  problem.add_variables("x", 2, 0.0, 5.0, {0, 0});
  problem.add_variables("y", 1, 0.0, 1.0, {0, 0});
  problem.add_cost(squared_distance({0, 1, 2}, Eigen::Vector3d(1, 2, 7)));
  problem.add_constraint(std::make_unique<LinearPiece>("sum", std::vector<int>{0, 1}, MatrixXd::Ones(1, 2)), -kInfinity,
                         2.0);
  problem.finish();
  const Solution s = ipm::solve(problem, VectorXd::Zero(3), tight());
  CHECK(s.outcome == Outcome::converged);
  CHECK((s.x - Eigen::Vector3d(0.5, 1.5, 1.0)).lpNorm<Eigen::Infinity>() < 1e-7);
  CHECK(s.x[2] <= 1.0);
  CHECK(std::abs(s.multipliers[0] - 1.0) < 1e-6);
}

TEST_CASE("a horizon of stages has the optimum that Ipopt finds, in as many iterations whatever its length") {
  for (const int steps : {10, 20, 60}) {
    const Cart cart(steps, steps == 10 ? 0.6 : 1.0);
    CAPTURE(steps);
    SolverOptions options;
    options.tolerance = options.constraint_tolerance = 1e-8;
    options.gradient_scaling = false;
    const Solution reference = nlp::solve(cart.problem, cart.start(), options);
    const Solution s = ipm::solve(cart.problem, cart.start(), options);
    REQUIRE_MESSAGE(reference.outcome == Outcome::converged, reference.message);
    CHECK_MESSAGE(s.outcome == Outcome::converged, s.message);
    CHECK(std::abs(s.cost - reference.cost) <= 1e-6 * std::abs(reference.cost));
    CHECK((s.x - reference.x).lpNorm<Eigen::Infinity>() < 1e-4);
    CHECK((s.multipliers - reference.multipliers).lpNorm<Eigen::Infinity>() < 1e-3);
    CHECK(s.iterations < 60);
  }
}

TEST_CASE("a last state that takes several inputs to reach is a linear system like any other") {
  // Of a mass from rest to rest with least effort the forces fall linearly: one step of Newton's method finds them.
  const int steps = 12;
  const double h = 0.1;
  Problem problem;
  std::vector<int> states, forces;
  for (int k = 0; k <= steps; ++k) {
    states.push_back(problem.add_variables("state", 2, -kInfinity, kInfinity, {k, k}));
    if (k < steps) forces.push_back(problem.add_variables("force", 1, -kInfinity, kInfinity, {k, k}));
  }
  for (int i = 0; i < 2; ++i) {
    problem.set_bounds(states.front() + i, 0.0, 0.0);
    problem.set_bounds(states.back() + i, 1.0 - i, 1.0 - i);
  }
  MatrixXd A(2, 5);
  A << 1.0, h, 0.5 * h * h, -1.0, 0.0, 0.0, 1.0, h, 0.0, -1.0;
  for (int k = 0; k < steps; ++k) {
    const int a = states[k], b = states[k + 1];
    problem.add_equality(std::make_unique<LinearPiece>("step", std::vector<int>{a, a + 1, forces[k], b, b + 1}, A));
    problem.add_cost(squared_norm("effort", {forces[k]}));
  }
  problem.finish();
  const Solution s = ipm::solve(problem, VectorXd::Constant(problem.variable_count(), 0.6), tight());
  CHECK_MESSAGE(s.outcome == Outcome::converged, s.message);
  CHECK(s.iterations == 1);
  const VectorXd u = s.x(forces);
  for (int k = 2; k < steps; ++k) CHECK(std::abs(u[k] - 2.0 * u[k - 1] + u[k - 2]) < 1e-8 * u[0]);
  CHECK(s.worst.value < 1e-12);
}

TEST_CASE("fixed variables keep their values, and what is decided beforehand is said") {
  Problem some;
  some.add_variables("x", 3, -10.0, 10.0, {0, 0});
  some.set_bounds(1, 4.0, 4.0);
  some.add_cost(squared_distance({0, 1, 2}, Eigen::Vector3d(1, 2, 3)));
  some.add_constraint(std::make_unique<LinearPiece>("sum", std::vector<int>{0, 1, 2}, MatrixXd::Ones(1, 3)), 6.0, 6.0);
  some.finish();
  const Solution s = ipm::solve(some, VectorXd::Zero(3), tight());
  CHECK(s.outcome == Outcome::converged);
  CHECK((s.x - Eigen::Vector3d(0, 4, 2)).lpNorm<Eigen::Infinity>() < 1e-6);

  some.set_bounds(0, 1.0, 1.0);
  some.set_bounds(2, 1.0, 1.0);
  const Solution fixed = ipm::solve(some, VectorXd::Zero(3), tight());
  CHECK(fixed.outcome == Outcome::converged);
  some.set_bounds(2, 2.0, 2.0);
  CHECK(ipm::solve(some, VectorXd::Zero(3), tight()).outcome == Outcome::infeasible);
  some.set_bounds(0, 1.0, -1.0);
  const Solution crossed = ipm::solve(some, VectorXd::Zero(3), tight());
  CHECK(crossed.outcome == Outcome::infeasible);
  CHECK(crossed.message == "the lower bound of x[0] at stage 0 lies above its upper bound");
}

TEST_CASE("equalities that say the same twice are no obstacle") {
  Problem problem;
  problem.add_variables("x", 2, -5.0, 5.0, {0, 0});
  problem.add_cost(squared_distance({0, 1}, Vector2d(3, 1)));
  for (int i = 0; i < 2; ++i)
    problem.add_equality(std::make_unique<LinearPiece>("same", std::vector<int>{0, 1}, MatrixXd::Ones(1, 2)));
  problem.finish();
  const Solution s = ipm::solve(problem, Vector2d(1, 1));
  CHECK_MESSAGE(s.outcome == Outcome::converged, s.message);
  CHECK((s.x - Vector2d(1, -1)).lpNorm<Eigen::Infinity>() < 1e-4);
}

TEST_CASE("equalities that say the same at every stage leave multipliers of the size of one") {
  for (const double scale : {1e-6, 1.0, 3.0}) {
    Problem problem;
    const int steps = 40;
    for (int k = 0; k <= steps; ++k) problem.add_variables("x", 2, -5.0, 5.0, {k, k});
    for (int k = 0; k < steps; ++k) {
      std::vector<int> four{2 * k, 2 * k + 1, 2 * k + 2, 2 * k + 3};
      MatrixXd A(2, 4);
      A << 1.0, 0.1, -1.0, 0.0, 0.0, 1.0, 0.0, -1.0;
      for (const double by : {1.0, scale}) problem.add_equality(std::make_unique<LinearPiece>("step", four, by * A));
    }
    problem.add_cost(squared_distance({0, 1}, Vector2d(1.0, 2.0)));
    problem.add_cost(squared_distance({2 * steps, 2 * steps + 1}, Vector2d(0.0, 0.0)));
    problem.finish();
    const Solution s = ipm::solve(problem, VectorXd::Zero(2 * steps + 2));
    REQUIRE_MESSAGE(s.outcome == Outcome::converged, s.message);
    CHECK(s.multipliers.lpNorm<Eigen::Infinity>() < 1e3 / scale);
    VectorXd dual(s.x.size()), jacobian(static_cast<Eigen::Index>(problem.jacobian_structure().size()));
    problem.gradient(s.x, dual);
    problem.jacobian(s.x, jacobian);
    for (Eigen::Index i = 0; i < jacobian.size(); ++i)
      dual[problem.jacobian_structure()[i].column] += jacobian[i] * s.multipliers[problem.jacobian_structure()[i].row];
    CHECK(dual.lpNorm<Eigen::Infinity>() < 1e-5);
  }
}

TEST_CASE("what cannot be satisfied is not called converged, and its worst row is named") {
  const Cart far(10, 50.0);
  for (const Solver solver : {Solver::ipm, Solver::automatic}) {
    const Solution s = ipm::solve(solver, far.problem, far.start());
    CHECK(s.outcome != Outcome::converged);
    CHECK(s.outcome != Outcome::nearly_converged);
    CHECK(s.worst.value > 1.0);
    CHECK(!s.worst.name.empty());
    CHECK(s.x.allFinite());
    CHECK(s.outcome == Outcome::infeasible);
    CHECK(s.solver == Solver::ipm);  // Ipopt is not asked
  }
}

TEST_CASE("limits of iterations and time, a stop request and a number that is none end with a name of their own") {
  const Cart cart(10, 0.6);
  SolverOptions options;
  options.max_iterations = 2;
  CHECK(ipm::solve(cart.problem, cart.start(), options).outcome == Outcome::iteration_limit);

  options = {};
  double seconds = 0.0;
  options.clock = [&] { return seconds += 1e-3; };
  options.time_limit_s = 0.02;
  const Solution late = ipm::solve(Solver::automatic, cart.problem, cart.start(), options);
  CHECK(late.outcome == Outcome::time_limit);
  CHECK(late.time_s <= 0.022);  // every reading of the clock is a millisecond

  options = {};
  int polls = 0;
  options.stop = [&] { return ++polls == 3; };
  const Solution stopped = ipm::solve(Solver::automatic, cart.problem, cart.start(), options);
  CHECK(stopped.outcome == Outcome::interrupted);
  CHECK(stopped.iterations == 2);

  Problem bad;
  bad.add_variables("x", 1, -1.0, 5.0, {2, 2});
  bad.add_cost(std::make_unique<FunctionPiece>(
      "root", std::vector<int>{0}, 1, [](const ConstVector& x, Vector f) { f[0] = std::sqrt(x[0]); },
      [](const ConstVector& x, Matrix J) { J(0, 0) = 0.5 / std::sqrt(x[0]); },
      [](const ConstVector&, const ConstVector&, Matrix) {}));
  bad.finish_for_values();
  bad.finish();
  const Solution none = ipm::solve(bad, VectorXd::Constant(1, -0.5));
  CHECK(none.outcome == Outcome::numerical_failure);
  CHECK(none.message == "not finite: cost root at stage 2");
  CHECK(none.x.allFinite());
}

TEST_CASE("a start that is no start is refused by name, and what a piece throws arrives") {
  const Cart cart(10);
  CHECK_THROWS_AS(ipm::solve(cart.problem, VectorXd::Zero(2)), InvalidInput);
  VectorXd x0 = cart.start();
  x0[3] = std::nan("");
  CHECK_THROWS_WITH_AS(ipm::solve(cart.problem, x0), doctest::Contains("x0, state[0] at stage 1"), InvalidInput);
  Problem never;
  never.add_variables("x", 2, -kInfinity, kInfinity, {0, 0});
  never.finish();
  for (const bool lower : {true, false}) {
    never.set_bounds(1, lower ? kInfinity : -kInfinity, lower ? kInfinity : -kInfinity);
    for (const Solver solver : {Solver::ipm, Solver::ipopt})
      CHECK_THROWS_WITH_AS(ipm::solve(solver, never, VectorXd::Zero(2)),
                           lower ? "x[1] at stage 0: lower: must be below infinity, got inf"
                                 : "x[1] at stage 0: upper: must be above minus infinity, got -inf",
                           InvalidInput);
  }
  never.set_bounds(1, std::nan(""), 1.0);
  CHECK_THROWS_AS(ipm::solve(never, VectorXd::Zero(2)), InvalidInput);
  const Valley throws([](const ConstVector&) { throw std::runtime_error("from a piece"); });
  CHECK_THROWS_WITH(ipm::solve(throws.problem, throws.x0), "from a piece");
}

TEST_CASE("fifty solves in each of eight threads at once give the same bytes as one after the other") {
  std::vector<VectorXd> expected;
  const auto solve = [](int i) {
    if (i % 3 == 0) {
      const HockSchittkowski71 hs;
      return ipm::solve(hs.problem, hs.x0).x;
    }
    const Cart cart(5 + i % 7, 0.1);
    return ipm::solve(cart.problem, cart.start()).x;
  };
  for (int i = 0; i < 50; ++i) expected.push_back(solve(i));
  std::vector<int> same(8, 0);
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 50; ++i) same[t] += same_bytes(solve(i), expected[i]);
    });
  for (std::thread& thread : threads) thread.join();
  for (const int count : same) CHECK(count == 50);
}
