#include "ipm/order.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "mcplan/ipm/solver.hpp"
#include "nlp/problems.hpp"

using namespace mcplan;
using namespace mcplan::nlp;
using namespace mcplan::nlp::tests;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// A point mass pushed by forces f without bounds of their own, each within `cone` f <= upper: v_k+1 = v_k + 0.1 a_k
/// with a_k the sum of two forces.
struct Pushed {
  explicit Pushed(const MatrixXd& cone, double upper) {
    int before = -1;
    for (int k = 0; k <= kSteps; ++k) {
      const int v = problem.add_variables("velocity", 3, -kInfinity, kInfinity, {k, k});
      if (k == 0)
        for (int i = 0; i < 3; ++i) problem.set_bounds(v + i, 0.0, 0.0);
      if (before >= 0) add_push(before, v, k - 1, cone, upper);
      before = v;
    }
    problem.add_cost(squared_distance({before, before + 1, before + 2}, VectorXd::Constant(3, 0.5)));
    problem.finish();
  }

  void add_push(int v, int next, int k, const MatrixXd& cone, double upper) {
    const int a = problem.add_variables("acceleration", 3, -kInfinity, kInfinity, {k, k});
    std::vector<int> sum{a, a + 1, a + 2}, step{v, v + 1, v + 2, next, next + 1, next + 2, a, a + 1, a + 2};
    for (int i = 0; i < 2; ++i) {
      const int f = problem.add_variables("force", 3, -kInfinity, kInfinity, {k, k});
      forces.push_back({f, f + 1, f + 2});
      problem.add_constraint(std::make_unique<LinearPiece>("cone", forces.back(), cone), -kInfinity, upper);
      problem.add_cost(squared_norm("effort", {f}));
      sum.insert(sum.end(), forces.back().begin(), forces.back().end());
    }
    const MatrixXd I = MatrixXd::Identity(3, 3);
    MatrixXd A(3, 9), B(3, 9);
    A << I, -I, -I;
    B << I, -I, 0.1 * I;
    problem.add_equality(std::make_unique<LinearPiece>("sum", sum, A));
    problem.add_equality(std::make_unique<LinearPiece>("step", step, B));
  }

  static constexpr int kSteps = 4;
  Problem problem;
  std::vector<std::vector<int>> forces;  ///< variables of each
};

/// How many of the forces are a group by themselves.
int alone(const Pushed& pushed) {
  const ipm::Unknowns unknowns(pushed.problem, false);
  int count = 0;
  for (std::vector<int> group : ipm::elimination_order(pushed.problem, unknowns)) {
    std::sort(group.begin(), group.end());
    for (const std::vector<int>& force : pushed.forces) {
      std::vector<int> own;
      for (int variable : force) own.push_back(unknowns.index_of[variable]);
      count += group == own;
    }
  }
  return count;
}

}  // namespace

TEST_CASE("inputs that rows bound are eliminated by themselves, those that rows leave free are not") {
  MatrixXd cone(4, 3), wedge(4, 3), few(2, 3);
  cone << 1.0, 0.0, -0.5, -1.0, 0.0, -0.5, 0.0, 1.0, -0.5, 0.0, -1.0, -0.5;
  wedge << 1.0, 0.0, -0.5, -1.0, 0.0, -0.5, 2.0, 0.0, -0.5, -2.0, 0.0, -0.5;  // no row sees the second component
  few << 1.0, 0.0, -0.5, 0.0, 1.0, -0.5;
  const Pushed bounded(cone, 1.0), open(wedge, 1.0), half(few, 1.0);
  CHECK(alone(bounded) == 2 * Pushed::kSteps);
  CHECK(alone(open) == 0);
  CHECK(alone(half) == 0);
  for (const Pushed* pushed : {&bounded, &open, &half}) {
    SolverOptions options;
    options.tolerance = options.constraint_tolerance = 1e-8;
    const VectorXd start = VectorXd::Zero(pushed->problem.variable_count());
    const Solution reference = nlp::solve(pushed->problem, start, options);
    const Solution s = ipm::solve(pushed->problem, start, options);
    REQUIRE(reference.outcome == Outcome::converged);
    CHECK(s.outcome == Outcome::converged);
    CHECK(std::abs(s.cost - reference.cost) < 1e-6);
  }
}
