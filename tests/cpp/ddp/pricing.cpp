#include "ddp/pricing.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

constexpr double kLeastProximal = 3.0;  ///< at which the search prices neighbours

struct Setting {
  mcplan::Scene scene;
  double weight, interior, proximal;
  Model model;
};

std::vector<Setting> settings() {
  std::vector<Setting> out;
  for (Model model : kModels)
    for (const mcplan::Scene& scene : scenes_of_all_kinds())
      for (double weight : {0.01, 1.0, 100.0})
        for (double proximal : {1e-2, kLeastProximal, 10.0})
          for (double interior : {0.0, 100.0})
            if (!kSlowBuild || out.size() % 5 == 0)
              out.push_back({scene, weight, interior, proximal, model});
            else
              out.push_back({});
  return out;
}

/// Minimum of the local model with a sequence, by a whole Riccati recursion.
double full_price(LocalModel& model, const ContactSequence& sequence) {
  ValueFunctions values(model);
  REQUIRE(values.backward(sequence, model.steps()));
  return values.minimum(0);
}

}  // namespace

TEST_CASE("every neighbour is priced like a full recompute, and the best one is the best one") {
  std::uint64_t seed = 200;
  double worst = 0.0, worst_firm = 0.0;  // with a weaker proximal weight than the search has, and from there on
  int priced = 0, with_friction = 0, with_reach = 0;
  for (const Setting& s : settings()) {
    ++seed;
    if (s.scene.surfaces.empty()) continue;
    CAPTURE(s.scene.name);
    CAPTURE(s.weight);
    CAPTURE(s.interior);
    CAPTURE(s.proximal);
    CAPTURE(seed);
    CAPTURE(name(s.model));
    const Problem problem(s.scene, scenes::humanoid44(), phases(18, s.model));
    Random random(seed);
    Trajectory trajectory = shaken_guess(problem, random, 0.05);
    const ContactSequence sequence = random_sequence(problem, random);
    problem.set_sole_yaw(sequence, trajectory);
    LocalModel model(problem);
    const Schedule weights = schedule(s.weight, s.interior, s.proximal);
    model.expand(trajectory, weights);
    Evaluator evaluate(problem);
    const CostTerms terms = evaluate(trajectory, sequence, weights).terms;
    with_friction += terms[cost_term_index("friction")] > 0.0;
    with_reach += terms[cost_term_index("interior_reach")] > 0.0;
    ValueFunctions values(model);
    REQUIRE(values.backward(sequence, 18));
    REQUIRE(values.forward(sequence, 0));
    double least = values.minimum(0), most = least;
    for (int k = 1; k <= 18; ++k) {
      least = std::min(least, values.minimum(k));
      most = std::max(most, values.minimum(k));
    }
    const double spread = (most - least) / std::abs(least);
    CAPTURE(spread);
    Pricing pricing(1);
    const std::vector<Neighbour> all = pricing.all(model, values, sequence);

    std::size_t i = 0;
    double best = std::numeric_limits<double>::infinity();
    ContactSequence best_sequence;
    for (int k = 1; k < 18; ++k)
      for (const ContactState& state : problem.rules.neighbours(sequence, k)) {
        REQUIRE(i < all.size());
        CHECK(all[i].step == k);
        CHECK(all[i].state == state);
        ContactSequence changed = sequence;
        changed[k] = state;
        const double exact = full_price(model, changed);
        const double error = std::abs(all[i].cost - exact) / std::abs(exact);
        double& worst_here = s.proximal >= kLeastProximal ? worst_firm : worst;
        worst_here = std::max(worst_here, error);
        // With a weaker one than the search ever has the Riccati recursions themselves lose digits: min U_k + V_k
        // differs from step to step by as much.
        CHECK(error <= (s.proximal >= kLeastProximal ? 1e-9 : 1e-9 + 10.0 * spread));
        if (exact < best) {
          best = exact;
          best_sequence = changed;
        }
        ++i;
        ++priced;
      }
    CHECK(i == all.size());
    const Neighbour* chosen = cheapest(all);
    REQUIRE(chosen);
    CHECK(best_sequence[chosen->step] == chosen->state);
    CHECK(best_sequence[chosen->step] != sequence[chosen->step]);
  }
  MESSAGE("neighbours priced: ", priced, ", worst relative error: ", worst_firm,
          ", below the least proximal weight of the search: ", worst, "; friction active in ", with_friction,
          " cases, reach between the knots in ", with_reach);
  CHECK(priced > 100);
  CHECK(with_friction > (kSlowBuild ? 1 : 20));
}

TEST_CASE("prices are the same to the last bit for 1, 2 and 4 threads") {
  const Problem problem(scenes::gap_with_rail(), scenes::humanoid44(), phases(18));
  Random random(300);
  const Trajectory trajectory = shaken_guess(problem, random, 0.05);
  const ContactSequence sequence = random_sequence(problem, random);
  LocalModel model(problem);
  model.expand(trajectory, schedule(10.0, 100.0, 10.0));
  ValueFunctions values(model);
  REQUIRE(values.backward(sequence, 18));
  REQUIRE(values.forward(sequence, 0));
  Pricing one(1);
  const std::vector<Neighbour> expected = one.all(model, values, sequence);
  for (int threads : {2, 4})
    for (int repeat = 0; repeat < 5; ++repeat) {
      // A fresh expansion, so that the threads also meet blocks that are not made yet.
      model.expand(trajectory, schedule(10.0, 100.0, 10.0));
      Pricing several(threads);
      const std::vector<Neighbour>& all = several.all(model, values, sequence);
      REQUIRE(all.size() == expected.size());
      for (std::size_t i = 0; i < all.size(); ++i) {
        CHECK(all[i].cost == expected[i].cost);
        CHECK(all[i].state == expected[i].state);
      }
    }
}

TEST_CASE("any contact state of a step can be priced, also one two switches away") {
  for (Model of : kModels)
    for (const mcplan::Scene& scene : {scenes::gap_with_rail(), gap_with_walls()}) {
      const Problem problem(scene, scenes::humanoid44(), phases(10, of));
      Random random(310);
      const Trajectory trajectory = shaken_guess(problem, random, 0.05);
      const ContactSequence sequence = random_sequence(problem, random);
      LocalModel model(problem);
      model.expand(trajectory, schedule(10.0, 100.0, 10.0));
      ValueFunctions values(model);
      REQUIRE(values.backward(sequence, 10));
      REQUIRE(values.forward(sequence, 0));
      const std::vector<ContactState> states = problem.rules.all_states(1000);
      StepPricing pricing;
      REQUIRE(pricing.prepare(model, values, 5, states));
      for (const ContactState& state : states) {
        ContactSequence changed = sequence;
        changed[5] = state;
        const double exact = full_price(model, changed);
        CHECK(std::abs(pricing.price(state) - exact) <= 1e-9 * std::abs(exact));
      }
    }
}

TEST_CASE("the cheapest of several, the first of equals, none of none") {
  CHECK(cheapest({}) == nullptr);
  const std::vector<Neighbour> some{{1, {}, 3.0}, {2, {}, 1.0}, {3, {}, 1.0}};
  CHECK(cheapest(some)->step == 2);
}
