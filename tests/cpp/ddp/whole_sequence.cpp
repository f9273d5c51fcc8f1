#include "ddp/whole_sequence.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

/// Minimum of the local model, with what the sequence's contact changes cost.
double full_price(LocalModel& model, const ContactSequence& sequence) {
  ValueFunctions values(model);
  REQUIRE(values.backward(sequence, model.steps()));
  return values.minimum(0) + change_cost(model.problem(), sequence);
}

constexpr std::size_t kNoLimit = 1000000;

}  // namespace

TEST_CASE("the price of a whole sequence is that of its own Riccati recursion, and no worse than the present one's") {
  std::uint64_t seed = 500;
  for (Model of : kModels)
    for (const mcplan::Scene& scene : scenes::all_four())
      for (double weight : {0.01, 1.0, 100.0}) {
        if (kSlowBuild && weight != 1.0) continue;
        CAPTURE(name(of));
        const Problem problem(scene, scenes::humanoid44(), phases(12, of));
        Random random(++seed);
        CAPTURE(scene.name);
        CAPTURE(seed);
        const Trajectory trajectory = shaken_guess(problem, random, 0.05);
        const ContactSequence sequence = random_sequence(problem, random);
        LocalModel model(problem);
        model.expand(trajectory, schedule(weight, 100.0, 10.0));
        ValueFunctions values(model);
        REQUIRE(values.backward(sequence, 12));
        REQUIRE(values.forward(sequence, 0));
        const double present = full_price(model, sequence);
        const PricedSequence found = best_whole_sequence(SequenceGraph(problem, kNoLimit), model, values);
        REQUIRE(found.sequence.size() == 13);
        CHECK(problem.rules.valid(found.sequence));
        CHECK(found.sequence.front() == problem.start_contacts);
        CHECK(found.sequence.back() == problem.goal_contacts);
        CHECK(std::abs(full_price(model, found.sequence) - found.cost) <= 1e-8 * std::abs(found.cost));
        // The present sequence's own nodes have rank `present`; taking the best successor at each node only lowers it.
        CHECK(found.cost <= present + 1e-8 * std::abs(present));
      }
}

TEST_CASE("against all 183 sequences of six steps: never below the best, and near it") {
  const Problem problem(scenes::flat(0.4), scenes::humanoid44(), phases(6));
  const std::vector<ContactSequence> all = every_sequence(problem);
  int optimal = 0, median_rank = 0;
  constexpr int kCases = 12;
  std::vector<int> ranks;
  for (int i = 0; i < kCases; ++i) {
    Random random(520 + i);
    const Trajectory trajectory = shaken_guess(problem, random, 0.05);
    LocalModel model(problem);
    model.expand(trajectory, schedule(2.0, 100.0, 1.0));
    const ContactSequence sequence = random_sequence(problem, random);
    ValueFunctions values(model);
    REQUIRE(values.backward(sequence, 6));
    REQUIRE(values.forward(sequence, 0));
    const PricedSequence found = best_whole_sequence(SequenceGraph(problem, kNoLimit), model, values);
    REQUIRE_FALSE(found.sequence.empty());
    double best = std::numeric_limits<double>::infinity();
    int better = 0;
    for (const ContactSequence& other : all) {
      const double cost = full_price(model, other);
      best = std::min(best, cost);
      better += cost < found.cost * (1.0 - 1e-9);
    }
    CHECK(found.cost >= best * (1.0 - 1e-9));
    optimal += better == 0;
    ranks.push_back(better);
  }
  std::sort(ranks.begin(), ranks.end());
  median_rank = ranks[kCases / 2];
  MESSAGE("whole-sequence move is the global best in ", optimal, " of ", kCases, "; median rank ", median_rank,
          ", worst ", ranks.back(), " of 183");
  CHECK(median_rank <= 9);  // in the best twentieth, from a random sequence, in at least half of the cases
}

TEST_CASE("too many states for the budget: nothing, and no time spent") {
  const Problem problem(scenes::gap_with_rail(), scenes::humanoid44(), phases(12));
  const Trajectory guess = problem.initial_guess({});
  Random random(540);
  const ContactSequence sequence = random_sequence(problem, random);
  LocalModel model(problem);
  model.expand(guess, schedule(1.0, 0.0, 10.0));
  ValueFunctions values(model);
  REQUIRE(values.backward(sequence, 12));
  REQUIRE(values.forward(sequence, 0));
  const PricedSequence all = best_whole_sequence(SequenceGraph(problem, kNoLimit), model, values);
  CHECK(all.riccati_steps > 100);
  const PricedSequence some = best_whole_sequence(SequenceGraph(problem, 50), model, values);
  CHECK(some.sequence.empty());
  CHECK(some.riccati_steps == 0);
  const SequenceGraph enough(problem, static_cast<std::size_t>(all.riccati_steps));
  CHECK(best_whole_sequence(enough, model, values).sequence == all.sequence);
}
