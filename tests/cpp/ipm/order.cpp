#include "ipm/order.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "ipm/kkt.hpp"
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
  /// twice: the sum is said of another variable, too, so that both say the same of the forces.
  explicit Pushed(const MatrixXd& cone, double upper, bool twice = false) : twice(twice) {
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
    if (twice) {
      const int b = problem.add_variables("again", 3, -kInfinity, kInfinity, {k, k});
      for (int i = 0; i < 3; ++i) sum[i] = b + i;
      problem.add_equality(std::make_unique<LinearPiece>("again", sum, A));
      problem.add_cost(squared_norm("again", {b, b + 1}));
    }
    problem.add_equality(std::make_unique<LinearPiece>("step", step, B));
  }

  static constexpr int kSteps = 4;
  bool twice = false;
  Problem problem;
  std::vector<std::vector<int>> forces;  ///< variables of each
};

MatrixXd square_cone() {
  MatrixXd out(4, 3);
  out << 1.0, 0.0, -0.5, -1.0, 0.0, -0.5, 0.0, 1.0, -0.5, 0.0, -1.0, -0.5;
  return out;
}

/// How many of the forces are a group by themselves.
int alone(const Pushed& pushed) {
  const ipm::Unknowns unknowns(pushed.problem, false);
  int count = 0;
  for (std::vector<int> group : ipm::elimination_order(pushed.problem, unknowns, true)) {
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
  const MatrixXd cone = square_cone();
  MatrixXd wedge(4, 3), few(2, 3);
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

TEST_CASE("sums of inputs are eliminated ahead of their stage, unless they say the same of these twice") {
  for (bool twice : {false, true}) {
    CAPTURE(twice);
    const Pushed pushed(square_cone(), 1.0, twice);
    const ipm::Unknowns unknowns(pushed.problem, false);
    ipm::Kkt kkt(pushed.problem, unknowns);
    const VectorXd x = VectorXd::Zero(pushed.problem.variable_count());
    VectorXd jacobian(static_cast<int>(pushed.problem.jacobian_structure().size()));
    VectorXd hessian(static_cast<int>(pushed.problem.hessian_structure().size()));
    pushed.problem.jacobian(x, jacobian);
    pushed.problem.hessian(x, 1.0, VectorXd::Zero(pushed.problem.row_count()), hessian);
    kkt.set_jacobian(jacobian);
    kkt.set_hessian(hessian);
    const int n = unknowns.free_count(), m = unknowns.equality_count();
    // Velocities and accelerations have no curvature of their own but at the end, `again` in two components of three.
    const VectorXd slacks = VectorXd::Constant(unknowns.slack_count(), 0.7), bounds = VectorXd::Constant(n, 1e-3);
    kkt.set_weights(slacks, bounds);
    const int largest = kkt.largest_front();
    CHECK(kkt.factor(0.0, 0.0) == ipm::Kkt::Factor::good);
    CHECK(kkt.delta_c() == 0.0);
    CHECK((kkt.largest_front() > largest) == twice);
    VectorXd a = VectorXd::LinSpaced(n, -1.0, 1.0), b = VectorXd::LinSpaced(m, 1.0, 2.0), dx(n), lambda(m);
    kkt.solve(a, b, dx, lambda);
    CHECK(kkt.residual() < 1e-9);
  }
}

TEST_CASE("a factorisation stops where the curvature is negative, and says so of the very problems of which it is") {
  for (const double curvature : {-2.0, -1e-3, 1e-3}) {
    CAPTURE(curvature);
    const Pushed pushed(square_cone(), 1.0);
    const ipm::Unknowns unknowns(pushed.problem, false);
    ipm::Kkt kkt(pushed.problem, unknowns);
    VectorXd jacobian(static_cast<int>(pushed.problem.jacobian_structure().size()));
    pushed.problem.jacobian(VectorXd::Zero(pushed.problem.variable_count()), jacobian);
    kkt.set_jacobian(jacobian);
    // Curvature of the forces by the rows alone; of velocities by `curvature`.
    const VectorXd hessian = VectorXd::Zero(static_cast<int>(pushed.problem.hessian_structure().size()));
    kkt.set_hessian(hessian);
    for (int stage = 1; stage <= Pushed::kSteps; ++stage) {
      VectorXd bounds = VectorXd::Zero(unknowns.free_count());
      for (int i = 0; i < unknowns.free_count(); ++i) {
        const std::string name = pushed.problem.variable_name(unknowns.free[i]);
        const bool here = pushed.problem.variable_stages(unknowns.free[i]).first == stage;
        if (name.rfind("velocity", 0) == 0 && here) bounds[i] = curvature;
      }
      kkt.set_weights(VectorXd::Constant(unknowns.slack_count(), 1e-3), bounds);
      // Two equal forces move the next velocity by 0.2 of one of them: 0.04 times its curvature, and 0.002 to 0.004 of
      // the rows.
      const ipm::Kkt::Factor expected = curvature < -1.0 ? ipm::Kkt::Factor::wrong_inertia : ipm::Kkt::Factor::good;
      CHECK(kkt.factor(0.0, 0.0) == expected);
    }
  }
}
