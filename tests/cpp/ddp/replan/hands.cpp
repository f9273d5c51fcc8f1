#include "ddp/replan/hands.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "mcplan/ddp/plan.hpp"
#include "mcplan/ddp/replan.hpp"
#include "scenes.hpp"

namespace {

using namespace mcplan;
using namespace mcplan::ddp;
using Eigen::Vector3d;

/// A floor with a wall to the left of the way.
Scene beside_a_wall(double y) {
  Scene scene = scenes::flat();
  Surface wall;
  wall.name = "wall";
  wall.vertices_W = {{-1, y, 0.7}, {4, y, 0.7}, {4, y, 1.6}, {-1, y, 1.6}};
  wall.end_effectors = {"hand"};
  scene.surfaces.push_back(wall);
  return scene;
}

constexpr double kWall_m = 0.5;

/// A plan without the hand, and what was planned at an instant.
struct Walk {
  Plan plan = ddp::plan(beside_a_wall(kWall_m), scenes::humanoid44()).plan;
  Similarity human = similarity_of(plan.robot, plan.scene.gravity);
  int left_hand = plan.robot.end_effector_index("left_hand");

  std::vector<Rest> hands(double t, const Vector3d& pushed_W, double committed_s = 0.0) const {
    Rest rest = rest_of(plan, t);
    rest.plan.knots.front().com_velocity_W += pushed_W;
    return with_hands(rest, plan.scene, plan.robot, pushed_W, committed_s, human);
  }

  /// Replan after a push that changes the CoM's velocity so [m/s].
  PlanResult pushed(double t, const Vector3d& by_W, const ReplanOptions& options = {}) const {
    Measured measured;
    measured.state = rest_of(plan, t).plan.knots.front();
    measured.state.com_velocity_W += by_W;
    return replan(plan, t, measured, options);
  }
};

/// Contacts of the feet, one after the other.
std::vector<std::vector<int>> without_hands(const Rest& rest) {
  std::vector<std::vector<int>> out;
  for (int k = 0; k <= rest.size(); ++k) {
    const std::vector<int> feet{rest.surface(k, 0), rest.surface(k, 1)};
    if (out.empty() || feet != out.back()) out.push_back(feet);
  }
  return out;
}

int phases_with(const Plan& plan, int e) {
  int count = 0;
  for (const Phase& phase : plan.phases) count += phase.contacts[e].surface >= 0;
  return count;
}

}  // namespace

TEST_CASE("a hand is put in on the side to which the robot is pushed, and lets go again") {
  const Walk walk;
  REQUIRE(phases_with(walk.plan, walk.left_hand) == 0);
  for (const double t : {0.1, 0.9, 1.4}) {
    CAPTURE(t);
    const Rest rest = rest_of(walk.plan, t);
    const std::vector<Rest> found = walk.hands(t, {0, 0.4, 0});
    REQUIRE(!found.empty());
    for (const Rest& with : found) {
      CHECK(with.size() == rest.size() + 2);
      CHECK(with.plan.final_contacts == rest.plan.final_contacts);
      CHECK(with.surface(0, walk.left_hand) == kFree);
      bool touches = false;
      for (int k = 1; k <= with.size(); ++k) {
        int changes = 0;
        for (int e = 0; e < with.plan.end_effector_count(); ++e)
          changes += with.surface(k, e) != with.surface(k - 1, e);
        CHECK(changes <= 1);
        if (with.surface(k, walk.left_hand) == kFree) continue;
        touches = true;
        CHECK(with.plan.knots[k].end_effectors_W[walk.left_hand].y() == doctest::Approx(kWall_m));
      }
      CHECK(touches);
      CHECK(without_hands(with) == without_hands(rest));  // feet do as they would
    }
  }
}

TEST_CASE("no hand is put in without a push to its side, or where nothing is in its reach") {
  const Walk walk;
  CHECK(walk.hands(0.9, Vector3d::Zero()).empty());
  CHECK(walk.hands(0.9, {0.5, 0.1, 0}).empty());
  CHECK(walk.hands(0.9, {0, -0.5, 0}).empty());  // to the right there is no wall
  const Rest rest = rest_of(walk.plan, 0.9);
  CHECK(with_hands(rest, beside_a_wall(1.5), walk.plan.robot, {0, 0.4, 0}, 0.0, walk.human).empty());
}

TEST_CASE("what is committed is not put off for a hand") {
  const Walk walk;
  const double t = 0.9;
  const std::vector<double> times = walk.plan.knot_times();
  const auto next = std::upper_bound(times.begin(), times.end(), t);
  const double first_s = *next - t, second_s = *(next + 1) - t;
  REQUIRE(walk.hands(t, {0, 0.4, 0}).size() == 2);
  const std::vector<Rest> after = walk.hands(t, {0, 0.4, 0}, 0.5 * (first_s + second_s));
  REQUIRE(after.size() == 1);
  CHECK(after.front().plan.phases.front().duration == first_s);
  CHECK(walk.hands(t, {0, 0.4, 0}, 1.01 * second_s).empty());
}

TEST_CASE("a hand at the wall catches pushes that steps do not, and a plan that does without it is not missed") {
  const Walk walk;
  ReplanOptions own_alone;
  own_alone.other_sequences = false;
  int caught = 0;
  for (double t = 0.6; t < 2.5; t += 0.2) {
    CAPTURE(t);
    const PlanResult with = walk.pushed(t, {0, 0.6, 0}), without = walk.pushed(t, {0, 0.6, 0}, own_alone);
    const bool solved = with.report.status == Status::solved;
    if (without.report.status == Status::solved) CHECK(solved);
    if (!solved || without.report.status == Status::solved) continue;
    CHECK(with.report.plan_from == PlanFrom::other_sequence);
    CHECK(phases_with(with.plan, walk.left_hand) > 0);
    ++caught;
  }
  CHECK(caught >= 3);
}

TEST_CASE("without a hard push the plan's own sequence is tried first") {
  const Walk walk;
  const PlanResult result = walk.pushed(0.9, {0, 0.25, 0});
  CHECK(result.report.status == Status::solved);
  CHECK(result.report.plan_from == PlanFrom::same_sequence);
  CHECK(phases_with(result.plan, walk.left_hand) == 0);
}
