#include "ddp/stepping_sequence.hpp"

#include <doctest/doctest.h>

#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

}  // namespace

TEST_CASE("feet step in turn, from start to goal, over valid states") {
  for (const mcplan::Scene& scene : {scenes::flat(), scenes::stairs()})
    for (int steps : {12, 17, 18, 30})
      for (int mover : {0, 1}) {
        CAPTURE(scene.name);
        CAPTURE(steps);
        const Problem problem(scene, scenes::humanoid44(), phases(steps));
        const ContactSequence sequence = stepping_sequence(problem, mover);
        REQUIRE(sequence.size() == static_cast<std::size_t>(steps + 1));
        CHECK(problem.rules.valid(sequence));
        CHECK(sequence.front() == problem.start_contacts);
        CHECK(sequence.back() == problem.goal_contacts);
        // One foot at a time, the other one next.
        int last = -1;
        for (int k = 1; k <= steps; ++k)
          for (int l : {0, 1}) {
            if (sequence[k][l] != kFree || sequence[k - 1][l] == kFree) continue;
            CHECK(sequence[k][1 - l] != kFree);
            CHECK(l != last);
            last = l;
          }
        CHECK(sequence[1][mover] == kFree);
      }
}

TEST_CASE("nobody stands at both ends, nobody steps") {
  mcplan::Scene scene = scenes::flat();
  scene.start.contacts = {{"right_foot", "ground"}};
  scene.goal.contacts = {{"left_foot", "ground"}};
  const Problem problem(scene, scenes::humanoid44(), phases(10));
  CHECK(stepping_sequence(problem, 0).empty());
}
