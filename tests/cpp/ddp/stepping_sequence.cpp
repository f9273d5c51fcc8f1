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

TEST_CASE("four point feet step as in a crawl: of either side the rear one, then the one ahead of it") {
  mcplan::Robot robot = scenes::humanoid44();
  robot.tracked = true;
  const mcplan::EndEffector foot = robot.end_effectors[0];
  robot.end_effectors.clear();
  for (const auto& [name, x, y] : {std::tuple("rf", 0.3, -0.2), std::tuple("lf", 0.3, 0.2),
                                   std::tuple("rh", -0.3, -0.2), std::tuple("lh", -0.3, 0.2)}) {
    mcplan::EndEffector& end = robot.end_effectors.emplace_back(foot);
    end.name = name;
    end.half_size.setZero();
    end.nominal_B = {x, y, -robot.com_height};
    end.reach_min_B = end.nominal_B - Eigen::Vector3d(0.2, 0.1, 0.1);
    end.reach_max_B = end.nominal_B + Eigen::Vector3d(0.2, 0.1, 0.3);
  }
  const Problem problem(scenes::flat(), robot, phases(30));
  REQUIRE(balances_on_points(problem));
  const ContactSequence sequence = stepping_sequence(problem, 0);
  REQUIRE(!sequence.empty());
  std::vector<int> order;
  for (int k = 1; k <= 8; ++k)
    for (int l = 0; l < 4; ++l)
      if (sequence[k][l] == kFree) order.push_back(l);
  CHECK(order == std::vector<int>{2, 0, 3, 1});
  robot.tracked = false;
  const Problem untracked(scenes::flat(), robot, phases(30));
  CHECK_FALSE(balances_on_points(untracked));
  CHECK(untracked.load_min == 0.0);
  CHECK(problem.load_min > 0.0);
  CHECK(problem.friction[0] < untracked.friction[0]);
}
