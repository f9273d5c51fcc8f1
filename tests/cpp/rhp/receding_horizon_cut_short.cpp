// Cycles that a limit cuts short: RecedingHorizon executes what is usable and says where it is from.

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "mcplan/plan/checker.hpp"
#include "mcplan/rhp/receding_horizon.hpp"
#include "rhp/execution.hpp"
#include "rhp/walkers.hpp"

namespace mcplan::rhp::tests {
namespace {

/// A clock that stands still, or goes on by a second at every look: a limit of two seconds then falls at once.
struct SwitchedClock {
  std::shared_ptr<double> time_s = std::make_shared<double>(0.0), tick_s = std::make_shared<double>(0.0);
  double operator()() const { return *time_s += *tick_s; }
};

Options kernel(Fidelity fidelity, int lookahead) {
  Options options = walkers::quick(fidelity, lookahead);
  options.solver = nlp::Solver::ipm;
  return options;
}

RecedingHorizon planner(const Options& options) { return {walkers::uneven(), walkers::robot(), options}; }

/// Largest violation over its tolerance, of a plan of one step.
double worst_ratio(const Plan& plan) {
  double worst = 0.0;
  for (const Violation& v : check(plan, plan.scene, plan.robot).constraints)
    worst = std::max(worst, v.value / v.tolerance);
  return worst;
}

}  // namespace

TEST_CASE("a best point is executed where the checker finds it usable, and is never called solved") {
  for (Fidelity fidelity : {Fidelity::single, Fidelity::point}) {
    Options options = kernel(fidelity, 2);
    const Cycle whole = planner(options).step();
    REQUIRE(whole.status == Status::solved);
    CHECK(whole.step_from == StepFrom::converged);
    int usable = 0;
    for (int limit = 1; limit < whole.iterations; ++limit) {
      CAPTURE(limit);
      options.max_iterations = limit;
      auto walker = planner(options);
      const Cycle cycle = walker.step();
      CHECK(cycle.status == Status::iteration_limit);
      CHECK(cycle.executed == (cycle.step_from != StepFrom::none));
      if (!cycle.executed) {
        CHECK(walker.result().plan.phases.empty());
        CHECK(cycle.message.find("not usable") != std::string::npos);
        continue;
      }
      ++usable;
      CHECK(cycle.step_from == StepFrom::iterate);
      CHECK(worst_ratio(walker.executed()) <= kUsableRatio);
      CHECK(walker.result().report.status == Status::iteration_limit);
      CHECK(walker.state().com_W == walker.executed().knots.back().com_W);
    }
    CHECK(usable > 0);
    CHECK(usable < whole.iterations - 1);
  }
}

TEST_CASE("after a cycle that was cut short without a step the next one goes on where it stopped") {
  for (Fidelity fidelity : {Fidelity::single, Fidelity::point}) {
    Options options = kernel(fidelity, 2);
    auto once = planner(options);
    const Cycle whole = once.step();
    options.max_iterations = 4;
    auto walker = planner(options);
    int iterations = 0, calls = 0;
    Cycle cycle;
    while (!cycle.executed && calls < 40) {
      cycle = walker.step();
      CHECK(cycle.index == calls++);
      CHECK(cycle.iterations <= 4);
      iterations += cycle.iterations;
    }
    CAPTURE(cycle.message);
    CHECK(cycle.executed);
    CHECK(calls > 1);
    CHECK(iterations <= 2 * whole.iterations);
    CHECK((walker.executed().knots.back().com_W - once.executed().knots.back().com_W).norm() < 0.1);
  }
}

TEST_CASE("a walk goes on with a cycle that the time limit cuts short without a step") {
  Options options = kernel(Fidelity::point, 2);
  options.cycles = 2;
  options.time_limit_s = 0.05;
  const SwitchedClock clock;
  *clock.tick_s = 1e-3;
  options.clock = clock;
  const Walk walk = planner(options).walk();
  CAPTURE(walk.report.message);
  CHECK(walk.success);
  CHECK(walk.plan.phases.size() == 6);
  REQUIRE(walk.cycles.size() > 2);
  CHECK_FALSE(walk.cycles.front().executed);
  CHECK(std::count_if(walk.cycles.begin(), walk.cycles.end(), [](const Cycle& cycle) { return cycle.executed; }) == 2);
  // No call gets anywhere.
  *clock.tick_s = 1.0;
  const Walk nowhere = planner(options).walk();
  CHECK_FALSE(nowhere.success);
  CHECK(nowhere.report.status == Status::time_limit);
  CHECK(nowhere.cycles.size() == kFurtherCalls + 1);
}

TEST_CASE("from another state nothing is gone on with") {
  Options options = kernel(Fidelity::point, 2);
  options.max_iterations = 3;
  auto walker = planner(options);
  REQUIRE_FALSE(walker.step().executed);
  State measured = walker.state();
  measured.com_W.x() += 0.01;
  const Cycle elsewhere = walker.step(measured);
  auto fresh = planner(options);
  CHECK(elsewhere.cost == fresh.step(measured).cost);
}

TEST_CASE("where time runs out at once, the step that the last plan predicted is executed, and says so") {
  Options options = kernel(Fidelity::single, 3);
  options.time_limit_s = 2.0;
  const SwitchedClock clock;
  options.clock = clock;
  auto walker = planner(options);
  REQUIRE(walker.step().step_from == StepFrom::converged);
  const Plan horizon = walker.horizon();
  const State before = walker.state();
  *clock.tick_s = 1.0;

  const Cycle second = walker.step();
  CAPTURE(second.message);
  CHECK(second.status == Status::time_limit);
  REQUIRE(second.step_from == StepFrom::previous_plan);
  CHECK(second.executed);
  const Plan step = walker.executed();
  REQUIRE(step.phases.size() == 3);
  CHECK(step.knots.front().com_W == before.com_W);
  for (int q = 0; q < 3; ++q) {
    CHECK(step.phases[q].duration == horizon.phases[3 + q].duration);
    CHECK((step.knots[q + 1].com_W - horizon.knots[4 + q].com_W).norm() < 1e-12);
    CHECK(step.knots[q + 1].end_effectors_W == horizon.knots[4 + q].end_effectors_W);
  }
  CHECK(step.final_contacts[walkers::right] == walkers::uneven().surface_index("right_1"));
  CHECK(worst_ratio(step) <= kUsableRatio);
  CHECK(second.duration_s == doctest::Approx(step.duration()));
  CHECK(second.distance_m == doctest::Approx(step.knots.back().com_W.x() - before.com_W.x()));
  CHECK(second.acceleration_cost > 0.0);
  CHECK(walker.result().plan.phases.size() == 6);
  CHECK(walker.result().report.status == Status::time_limit);

  // The last step of a horizon leads where no next one is found.
  const Cycle third = walker.step();
  CHECK(third.step_from == StepFrom::none);
  CHECK(walker.result().plan.phases.size() == 6);
  *clock.tick_s = 0.0;
  const Cycle again = walker.step();
  CAPTURE(again.message);
  CHECK(again.step_from == StepFrom::converged);
  CHECK(walker.result().plan.phases.size() == 9);
}

TEST_CASE("costs of a predicted step are those that a cycle has for it") {
  Options options = kernel(Fidelity::single, 2);
  auto walker = planner(options);
  const Cycle cycle = walker.step();
  REQUIRE(cycle.executed);
  const Walker same(walkers::uneven(), walkers::robot(), options);
  const RunningCost cost = running_cost(same, walker.executed());
  CHECK(cost.acceleration == doctest::Approx(cycle.acceleration_cost).epsilon(1e-5));
  CHECK(cost.momentum == doctest::Approx(cycle.momentum_cost).epsilon(1e-4));
}

TEST_CASE("predicted steps of a reduced model, which let the angular momentum grow, are not usable") {
  Options options = kernel(Fidelity::point, 3);
  options.time_limit_s = 2.0;
  const SwitchedClock clock;
  options.clock = clock;
  auto walker = planner(options);
  REQUIRE(walker.step().executed);
  *clock.tick_s = 1.0;
  const Cycle cycle = walker.step();
  CHECK(cycle.step_from == StepFrom::none);
  CHECK_FALSE(cycle.executed);
  CHECK(cycle.message.find("predicted is not usable: angular_momentum") != std::string::npos);
}

}  // namespace mcplan::rhp::tests
