#include <doctest/doctest.h>

#include "mcplan/nlp/solver.hpp"
#include "nlp/problems.hpp"

using namespace mcplan;
using namespace mcplan::nlp;
using namespace mcplan::nlp::tests;

TEST_CASE("problem 71 of Hock and Schittkowski: optimum, multipliers, no output") {
  const HockSchittkowski71 hs;
  SolverOptions options;
  options.tolerance = 1e-9;
  const Solution s = solve(hs.problem, hs.x0, options);
  CAPTURE(s.message);
  CHECK(s.status == Status::solved);
  CHECK((s.x - hs.optimum).lpNorm<Eigen::Infinity>() < 1e-6);
  CHECK(std::abs(s.cost - hs.cost) < 1e-6);
  MESSAGE(s.iterations << " " << s.time_s << " " << s.evaluation_s << " " << s.linear_solver_s << " "
                       << s.multipliers.transpose());
}
