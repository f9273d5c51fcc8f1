#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "mcplan/base/error.hpp"
#include "mcplan/ipm/solver.hpp"
#include "nlp/problems.hpp"

using namespace mcplan;
using namespace mcplan::nlp;
using namespace mcplan::nlp::tests;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

SolverOptions tight() {
  SolverOptions out;
  out.tolerance = out.constraint_tolerance = 1e-8;
  out.gradient_scaling = false;
  return out;
}

/// Points nearest to (3, 1) within a thin shell, 1 <= x^2 + y^2 <= 1.001, and within y <= 0.2.
struct Shell {
  Shell() {
    problem.add_variables("x", 2, -100.0, 100.0, {0, 0});
    problem.add_cost(squared_distance({0, 1}, Vector2d(3.0, 1.0)));
    problem.add_constraint(squared_norm("shell", {0, 1}), 1.0, 1.001);
    problem.add_constraint(std::make_unique<LinearPiece>("lane", std::vector<int>{1}, MatrixXd::Ones(1, 1)), -kInfinity,
                           0.2);
    problem.finish();
  }
  Problem problem;
};

/// Rosenbrock's valley as squares of residuals, 10 (y - x^2) and 1 - x; counts what is asked for.
class Residuals : public Piece {
 public:
  Residuals() : Piece("residuals", {0, 1}, 1) {}

  void values(const ConstVector& x, Vector f) const override {
    f[0] = 100.0 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1.0 - x[0], 2);
  }
  void jacobian(const ConstVector& x, Matrix J) const override {
    const double r = x[1] - x[0] * x[0];
    J << -400.0 * x[0] * r - 2.0 * (1.0 - x[0]), 200.0 * r;
  }
  void hessian(const ConstVector& x, const ConstVector& w, Matrix H) const override {
    ++exact;
    gauss_newton_hessian(x, w, H);
    H(0, 0) -= 400.0 * (x[1] - x[0] * x[0]) * w[0];
  }
  void gauss_newton_hessian(const ConstVector& x, const ConstVector& w, Matrix H) const override {
    H(0, 0) = (800.0 * x[0] * x[0] + 2.0) * w[0];
    H(1, 0) = -400.0 * x[0] * w[0];
    H(1, 1) = 200.0 * w[0];
  }

  mutable int exact = 0;
};

}  // namespace

TEST_CASE("a distant start and scaled rows change neither the optimum nor the multipliers") {
  const Shell shell;
  const Solution reference = nlp::solve(shell.problem, Vector2d(1.0, 0.1), tight());
  REQUIRE(reference.outcome == Outcome::converged);
  for (const Vector2d& start : {Vector2d(1.0, 0.1), Vector2d(60.0, -80.0), Vector2d(1e-3, 99.0)}) {
    CAPTURE(start);
    SolverOptions options = tight();
    options.kernel.distant_start = true;
    const Solution s = ipm::solve(shell.problem, start, options);
    CHECK_MESSAGE(s.outcome == Outcome::converged, s.message);
    CHECK((s.x - reference.x).lpNorm<Eigen::Infinity>() < 1e-6);
    CHECK((s.multipliers - reference.multipliers).lpNorm<Eigen::Infinity>() < 1e-4);
    CHECK(s.worst.value <= 1e-8);
  }
}

TEST_CASE("where any point within the constraints will do, the solve ends at the first") {
  const Shell shell;
  SolverOptions options = tight();
  const Solution whole = ipm::solve(shell.problem, Vector2d(20.0, 20.0), options);
  options.kernel.distant_start = options.kernel.feasible_is_enough = true;
  const Solution s = ipm::solve(shell.problem, Vector2d(20.0, 20.0), options);
  REQUIRE(whole.outcome == Outcome::converged);
  CHECK_MESSAGE(s.outcome == Outcome::converged, s.message);
  CHECK(s.message == "a point within all constraints");
  CHECK(s.worst.value <= 1e-8);
  CHECK(s.iterations < whole.iterations);
  CHECK(s.cost >= whole.cost - 1e-6);
}

TEST_CASE("nothing within all constraints is not called enough") {
  Problem problem;
  problem.add_variables("x", 2, -100.0, 100.0, {0, 0});
  problem.add_constraint(squared_norm("disc", {0, 1}), -kInfinity, 1.0);
  problem.add_constraint(std::make_unique<LinearPiece>("beyond", std::vector<int>{0}, MatrixXd::Ones(1, 1)), 2.0, 3.0);
  problem.finish();
  SolverOptions options = tight();
  options.kernel.distant_start = options.kernel.feasible_is_enough = true;
  const Solution s = ipm::solve(problem, Vector2d(5.0, 5.0), options);
  CHECK(s.outcome == Outcome::infeasible);
  CHECK(s.worst.value > 0.1);
}

TEST_CASE("the blend of Hessians finds the valley's end, and asks for no exact Hessian while rows are violated") {
  for (const bool row : {false, true}) {
    CAPTURE(row);
    Problem problem;
    problem.add_variables("x", 2, -100.0, 100.0, {0, 0});
    auto cost = std::make_unique<Residuals>();
    const Residuals& seen = *cost;
    problem.add_cost(std::move(cost));
    if (row)
      problem.add_constraint(std::make_unique<LinearPiece>("far", std::vector<int>{0}, MatrixXd::Ones(1, 1)), 50.0,
                             60.0);
    problem.finish();
    seen.exact = 0;
    SolverOptions options = tight();
    options.kernel.blend_hessians = true;
    options.initial_barrier = 1e-3;
    if (row) options.max_iterations = 1;
    const Solution s = ipm::solve(problem, Vector2d(-1.2, 1.0), options);
    if (row) {
      CHECK(s.outcome == Outcome::iteration_limit);
      CHECK(seen.exact == 0);
      continue;
    }
    CHECK_MESSAGE(s.outcome == Outcome::converged, s.message);
    CHECK((s.x - Vector2d(1, 1)).lpNorm<Eigen::Infinity>() < 1e-5);
    CHECK(seen.exact > 0);
  }
}

TEST_CASE("the Gauss-Newton Hessian of a problem is that of its costs alone") {
  Problem problem;
  problem.add_variables("x", 2, -kInfinity, kInfinity, {0, 0});
  problem.add_cost(std::make_unique<Residuals>());
  problem.add_cost(squared_distance({0, 1}, Vector2d(3.0, 1.0)));
  problem.add_constraint(squared_norm("disc", {0, 1}), -kInfinity, 1.0);
  problem.finish();
  const Vector2d x(0.7, -0.4);
  VectorXd values(problem.hessian_structure().size());
  problem.gauss_newton_hessian(x, values);
  MatrixXd H = MatrixXd::Zero(2, 2);
  for (std::size_t i = 0; i < problem.hessian_structure().size(); ++i)
    H(problem.hessian_structure()[i].row, problem.hessian_structure()[i].column) += values[i];
  MatrixXd J(2, 2);  // of 10 (y - x^2), 1 - x
  J << -20.0 * x[0], 10.0, -1.0, 0.0;
  const MatrixXd expected = 2.0 * J.transpose() * J + 2.0 * MatrixXd::Identity(2, 2);
  CHECK((H - MatrixXd(expected.triangularView<Eigen::Lower>())).lpNorm<Eigen::Infinity>() < 1e-12);
}

namespace {

/// One variable in [0, width] that is pulled to `target`; `seen`: every x at which the cost was evaluated.
struct Pulled {
  Pulled(double width, double target) {
    problem.add_variables("x", 1, 0.0, width, {0, 0});
    problem.add_cost(squared_distance({0}, VectorXd::Constant(1, target), [this](const ConstVector& x) {
      if (finished) seen.push_back(x[0]);
    }));
    problem.finish();
    finished = true;
  }
  Problem problem;
  std::vector<double> seen;
  bool finished = false;
};

/// lg(mu) of each row of the iteration table.
std::vector<double> barriers(const Problem& problem, const VectorXd& x, SolverOptions options) {
  std::vector<double> out;
  options.logger = [&](LogLevel, const std::string& line) {
    double cost, primal, dual, complementarity, barrier;
    if (std::sscanf(line.c_str(), "%*d%*c %lf %lf %lf %lf %lf", &cost, &primal, &dual, &complementarity, &barrier) == 5)
      out.push_back(barrier);
  };
  REQUIRE(ipm::solve(problem, x, options).outcome == Outcome::converged);
  return out;
}

}  // namespace

TEST_CASE("a start is moved off its bounds by a hundredth, by a tenth where the barrier is probed") {
  for (const bool adaptive : {false, true})
    for (const double width : {1e9, 0.5}) {
      Pulled pulled(width, 0.25);
      SolverOptions options = tight();
      options.adaptive_barrier = adaptive;
      REQUIRE(ipm::solve(pulled.problem, VectorXd::Zero(1), options).outcome == Outcome::converged);
      const double push = adaptive ? 0.1 : 0.01;
      CHECK(pulled.seen.front() == doctest::Approx(push * std::min(1.0, width)));
    }
  Pulled inside(1.0, 0.25);
  SolverOptions options = tight();
  options.adaptive_barrier = true;
  ipm::solve(inside.problem, VectorXd::Constant(1, 0.4), options);
  CHECK(inside.seen.front() == 0.4);
}

TEST_CASE("a probed barrier parameter falls at most to a tenth of the average complementarity") {
  // Far from its bounds the affine step meets no obstacle: what is probed is next to nothing.
  Pulled pulled(1.0, 0.5);
  SolverOptions options = tight();
  options.adaptive_barrier = true;
  options.initial_barrier = 0.1;
  const std::vector<double> kept = barriers(pulled.problem, VectorXd::Constant(1, 0.5), options);
  REQUIRE(kept.size() > 2);
  CHECK(kept[0] == doctest::Approx(-1.0));
  CHECK(kept[1] == doctest::Approx(-2.0).epsilon(0.03));
  // A bound that is none has no part in the average.
  Pulled open(kInfinity, 0.5);
  const std::vector<double> one_sided = barriers(open.problem, VectorXd::Constant(1, 0.5), options);
  REQUIRE(one_sided.size() > 1);
  CHECK(one_sided[1] == doctest::Approx(-2.0).epsilon(0.03));
  options.kernel.distant_start = true;  // as sip solves: no floor
  const std::vector<double> free = barriers(pulled.problem, VectorXd::Constant(1, 0.5), options);
  REQUIRE(free.size() > 1);
  CHECK(free[1] < -3.0);
}

TEST_CASE("a solution with its multipliers and its barrier parameter is where a solve ends at once") {
  const Shell shell;
  for (const bool adaptive : {false, true}) {
    CAPTURE(adaptive);
    SolverOptions options = tight();
    options.adaptive_barrier = adaptive;
    const Solution whole = ipm::solve(shell.problem, Vector2d(1.0, 0.1), options);
    REQUIRE(whole.outcome == Outcome::converged);
    REQUIRE(whole.bound_multipliers.size() == 2);
    CHECK(whole.barrier <= options.tolerance);
    options.initial_barrier = whole.barrier;
    const Solution without = ipm::solve(shell.problem, whole.x, options);
    options.start = {whole.multipliers, whole.bound_multipliers};
    const Solution again = ipm::solve(shell.problem, whole.x, options);
    CHECK_MESSAGE(again.outcome == Outcome::converged, again.message);
    CHECK(again.iterations <= 2);
    CHECK(again.iterations < without.iterations);
    CHECK((again.x - whole.x).lpNorm<Eigen::Infinity>() < 1e-7);
    CHECK((again.multipliers - whole.multipliers).lpNorm<Eigen::Infinity>() < 1e-4);
  }
}

TEST_CASE("a solve that was cut short goes on from its point, its multipliers and its barrier parameter") {
  const Shell shell;
  SolverOptions options = tight();
  const Solution whole = ipm::solve(shell.problem, Vector2d(1.0, 0.1), options);
  SolverOptions cut = options;
  cut.max_iterations = whole.iterations - 3;
  const Solution part = ipm::solve(shell.problem, Vector2d(1.0, 0.1), cut);
  REQUIRE(part.outcome == Outcome::iteration_limit);
  CHECK(part.barrier > 0.0);
  CHECK(part.barrier < options.initial_barrier);
  options.initial_barrier = part.barrier;
  options.start = {part.multipliers, part.bound_multipliers};
  const Solution rest = ipm::solve(shell.problem, part.x, options);
  CHECK_MESSAGE(rest.outcome == Outcome::converged, rest.message);
  CHECK((rest.x - whole.x).lpNorm<Eigen::Infinity>() < 1e-6);
  CHECK(rest.iterations < whole.iterations);
}

TEST_CASE("multipliers of the wrong size or that are no numbers are refused") {
  const Shell shell;
  SolverOptions options = tight();
  options.start.multipliers = VectorXd::Zero(3);  // of two rows
  CHECK_THROWS_AS(ipm::solve(shell.problem, Vector2d(1.0, 0.1), options), InvalidOptions);
  options.start.multipliers = VectorXd::Constant(2, std::nan(""));
  CHECK_THROWS_AS(ipm::solve(shell.problem, Vector2d(1.0, 0.1), options), InvalidOptions);
}
