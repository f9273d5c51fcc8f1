#include <doctest/doctest.h>

#include "mcplan/ipm/solver.hpp"
#include "rhp/guess.hpp"
#include "rhp/horizon.hpp"
#include "rhp/random_start.hpp"
#include "rhp/walkers.hpp"

using namespace mcplan;
using namespace mcplan::rhp;

TEST_CASE("from uniformly random starts the kernel finds the optimum that it finds from the straight walk") {
  const Walker walker(walkers::uneven(), walkers::robot(), walkers::quick(Fidelity::point, 2));
  const Footsteps footsteps = footsteps_of(walker);
  HorizonRequest request;
  request.state = walker.start();
  request.steps = 2;
  request.footholds_W = nominal_footholds(walker, request.state, footsteps, 0, request.steps);
  request.guess = [&](const Horizon& horizon) { return nominal_guess(walker, request.state, horizon); };
  const Horizon horizon = build_horizon(walker, footsteps, request);
  nlp::SolverOptions options;
  options.adaptive_barrier = true;
  options.gradient_scaling = false;
  const nlp::Solution nominal = ipm::solve(horizon.problem, horizon.guess, options);
  REQUIRE(nominal.outcome == nlp::Outcome::converged);
  for (unsigned seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    const nlp::Solution random = ipm::solve(horizon.problem, random_start(horizon, seed), options);
    CHECK_MESSAGE(random.outcome == nlp::Outcome::converged, random.message);
    CHECK(random.cost == doctest::Approx(nominal.cost).epsilon(1e-7));
  }
}
