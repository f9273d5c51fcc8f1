#include <doctest/doctest.h>

#include <cmath>

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
