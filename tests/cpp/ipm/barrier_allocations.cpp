#include <doctest/doctest.h>

#include <array>
#include <memory>

#include "allocations.hpp"
#include "mcplan/ipm/solver.hpp"
#include "nlp/problems.hpp"

using namespace mcplan;
using namespace mcplan::nlp;
using namespace mcplan::nlp::tests;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

/// A cart on a track that is to come near a far target, in 30 stages, with a cap on the sum of squares of each state.
/// Not asked for where allocations are not counted.
[[maybe_unused]] void fill(Problem& problem) {
  constexpr int kStages = 30;
  MatrixXd step(2, 5);
  step << 1.0, 0.1, 0.005, -1.0, 0.0, 0.0, 1.0, 0.1, 0.0, -1.0;
  int before = problem.add_variables("state", 2, 0.0, 0.0, {0, 0});
  for (int k = 0; k < kStages; ++k) {
    const int push = problem.add_variables("push", 1, -1.0, 1.0, {k, k});
    const int after = problem.add_variables("state", 2, -10.0, 10.0, {k + 1, k + 1});
    problem.add_equality(
        std::make_unique<LinearPiece>("step", std::vector<int>{before, before + 1, push, after, after + 1}, step));
    problem.add_constraint(squared_norm("cap", {after, after + 1}), -kInfinity, 4.0);
    problem.add_cost(squared_distance({after, after + 1}, Vector2d(3.0, 0.0)));
    before = after;
  }
  problem.finish();
}

}  // namespace

TEST_CASE("after the first iteration the kernel asks for no memory") {
#ifdef MCPLAN_TEST_COUNTS_ALLOCATIONS
  { CHECK((allocations = 0, VectorXd(5).setZero(), allocations) == 1); }  // the counter sees Eigen
  Problem problem;
  fill(problem);
  for (const bool adaptive : {false, true}) {
    CAPTURE(adaptive);
    std::array<long, 100> seen{};  // at the begin of each iteration
    int count = 0;
    SolverOptions options;
    options.adaptive_barrier = adaptive;
    options.stop = [&] {
      if (count < static_cast<int>(seen.size())) seen[count++] = allocations;
      return false;
    };
    const Solution s = ipm::solve(problem, VectorXd::Zero(problem.variable_count()), options);
    REQUIRE_MESSAGE(s.outcome == Outcome::converged, s.message);
    REQUIRE(count > 5);
    for (int i = 2; i < count; ++i) CHECK_MESSAGE(seen[i] == seen[i - 1], "iteration " << i);
  }
#else
  MESSAGE("allocations are not counted on this platform");
#endif
}
