#include "ddp/initial_sequence.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

double cost_with(const Problem& problem, const Trajectory& trajectory, const Schedule& weights,
                 const ContactSequence& sequence) {
  Evaluator evaluate(problem);
  return evaluate(trajectory, sequence, weights).cost;
}

}  // namespace

TEST_CASE("the cheapest valid sequence for a frozen trajectory, against all 183 of them") {
  Options options = phases(6);
  options.weights.own["contact_change"] = 0.0;  // counts in the search's later stages only
  const Problem problem(scenes::flat(), scenes::humanoid44(), options);
  const std::vector<ContactSequence> all = every_sequence(problem);
  CHECK(all.size() == 183);
  for (std::uint64_t seed = 400; seed < 420; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Trajectory trajectory = shaken_guess(problem, random, 0.3);
    const Schedule weights = schedule(uniform(random, 0.1, 10.0), 100.0, 10.0);
    LocalModel model(problem);
    model.expand(trajectory, weights);
    double best = std::numeric_limits<double>::infinity();
    for (const ContactSequence& sequence : all)
      best = std::min(best, cost_with(problem, trajectory, weights, sequence));
    const ContactSequence found = initial_sequence(model);
    REQUIRE(found.size() == 7);
    CHECK(problem.rules.valid(found));
    CHECK(found.front() == problem.start_contacts);
    CHECK(found.back() == problem.goal_contacts);
    CHECK(cost_with(problem, trajectory, weights, found) == doctest::Approx(best).epsilon(1e-12));
  }
}

TEST_CASE("permissions and the scene's rules hold, on every scene") {
  for (const mcplan::Scene& scene : scenes::all_four())
    for (bool one_switch : {true, false}) {
      Options options = phases(18);
      options.one_switch_per_step = one_switch;
      const Problem problem(scene, scenes::humanoid44(), options);
      const Trajectory guess = problem.initial_guess({});
      LocalModel model(problem);
      model.expand(guess, schedule(0.01, 0.0, 0.0));
      const ContactSequence found = initial_sequence(model);
      REQUIRE(found.size() == 19);
      CHECK(problem.rules.valid(found));
      CHECK(found.back() == problem.goal_contacts);
    }
}

TEST_CASE("no sequence when the steps are too few: two feet to another surface take four switches") {
  for (int steps : {1, 2, 3, 4, 5}) {
    const Problem problem(scenes::gap(), scenes::humanoid44(), phases(steps));
    const Trajectory guess = problem.initial_guess({});
    LocalModel model(problem);
    model.expand(guess, schedule(1.0, 0.0, 0.0));
    CHECK(initial_sequence(model).empty() == (steps < 4));
  }
}

TEST_CASE("a beam narrower than the states still joins start and goal, at no lower cost") {
  const Problem problem(scenes::gap_with_rail(), scenes::humanoid44(), phases(18));
  Random random(430);
  const Trajectory trajectory = shaken_guess(problem, random, 0.1);
  const Schedule weights = schedule(1.0, 0.0, 0.0);
  LocalModel model(problem);
  model.expand(trajectory, weights);
  const ContactSequence wide = initial_sequence(model), narrow = initial_sequence(model, 8);
  REQUIRE_FALSE(wide.empty());
  REQUIRE_FALSE(narrow.empty());
  CHECK(problem.rules.valid(narrow));
  CHECK(cost_with(problem, trajectory, weights, narrow) >= cost_with(problem, trajectory, weights, wide));
}
