#include <doctest/doctest.h>

#include <array>

#include "allocations.hpp"
#include "mcplan/rhp/receding_horizon.hpp"
#include "rhp/walkers.hpp"

using namespace mcplan;
using namespace mcplan::rhp;

TEST_CASE("after the first iteration a horizon's solve asks for no memory, its pieces included") {
#ifdef MCPLAN_TEST_COUNTS_ALLOCATIONS
  for (Fidelity fidelity : {Fidelity::single, Fidelity::rectangle, Fidelity::point}) {
    CAPTURE(static_cast<int>(fidelity));
    std::array<long, 400> seen{};  // at the begin of each iteration
    int count = 0;
    Options options = walkers::quick(fidelity);
    options.solver = nlp::Solver::ipm;
    options.stop = [&] {
      if (count < static_cast<int>(seen.size())) seen[count++] = allocations;
      return false;
    };
    RecedingHorizon planner(walkers::uneven(), walkers::robot(), options);
    const Cycle cycle = planner.step();
    REQUIRE_MESSAGE(cycle.status == Status::solved, cycle.message);
    REQUIRE(count > 5);
    int grown = 0;
    for (int i = 2; i < count; ++i) grown += seen[i] != seen[i - 1];
    CHECK(grown <= 2);  // rows that were left out and matter after all make a second program
  }
#else
  MESSAGE("allocations are not counted on this platform");
#endif
}
