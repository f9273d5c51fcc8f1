#include <doctest/doctest.h>

#include "rhp/guess.hpp"
#include "rhp/horizon.hpp"
#include "rhp/walkers.hpp"

namespace mcplan::rhp::tests {

TEST_CASE("the first phase of a horizon, and no other, may last longer by a landing") {
  Options options = walkers::quick(Fidelity::single);
  options.landing_s = 0.25;
  const Walker walker(walkers::uneven(), walkers::robot(), options);
  const Footsteps footsteps = footsteps_of(walker);
  HorizonRequest request;
  request.state = walker.start();
  request.steps = options.lookahead;
  request.footholds_W = nominal_footholds(walker, request.state, footsteps, 0, options.lookahead);
  request.guess = [&](const Horizon& built) { return nominal_guess(walker, request.state, built); };
  const Horizon horizon = build_horizon(walker, footsteps, request);
  REQUIRE(horizon.phases.size() == 6);
  for (const Horizon::Phase& phase : horizon.phases) {
    const Range range = phase.swing >= 0 ? options.single_support_s : options.double_support_s;
    const double longer = phase.first_node == 0 ? options.landing_s : 0.0;
    CHECK(horizon.problem.variable_lower()[phase.duration] == range.min);
    CHECK(horizon.problem.variable_upper()[phase.duration] == range.max + longer);
  }
}

}  // namespace mcplan::rhp::tests
