#include "ddp/attempts.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <vector>

#include "clocks.hpp"
#include "mcplan/ddp/switched_ddp.hpp"
#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;
using mcplan::PlanResult;
using mcplan::Status;

PlanResult solve(const mcplan::Scene& scene, const Options& options) {
  return SwitchedDdp(scene, scenes::humanoid44(), options).solve();
}

/// Attempts at a scene with all of its surfaces.
struct Bench {
  explicit Bench(const mcplan::Scene& scene_in, const Options& options = {})
      : scene(scene_in),
        best(scene, deadline),
        attempts(Problem(scene, scenes::humanoid44(), options), all(scene), deadline, best, report) {}
  static std::vector<int> all(const mcplan::Scene& scene) {
    std::vector<int> out;
    for (int i = 0; i < static_cast<int>(scene.surfaces.size()); ++i) out.push_back(i);
    return out;
  }
  mcplan::Scene scene;
  mcplan::Deadline deadline{std::numeric_limits<double>::infinity()};
  mcplan::Report report;
  BestPlan best;
  Attempts attempts;
};

}  // namespace

TEST_CASE("one attempt is enough where the checker accepts its plan, and repeats to the last bit") {
  Bench first(scenes::flat()), second(scenes::flat());
  CHECK(first.attempts.run(nullptr) == Ending::done);
  CHECK(second.attempts.run(nullptr) == Ending::done);
  REQUIRE(first.best.ok());
  REQUIRE(second.best.ok());
  CHECK(first.best.best()->evaluation.cost == second.best.best()->evaluation.cost);
  CHECK(first.report.iterations == second.report.iterations);
}

TEST_CASE("while the checker rejects what comes out, as many restarts follow as the options allow") {
  // Feet that cannot be as far ahead as the goal is in six phases: every plan violates something.
  int last = 0;
  for (int restarts : {0, 1, 2}) {
    Options options = phases(6);
    options.restarts = restarts;
    Bench bench(scenes::flat(6.0), options);
    bench.attempts.run(nullptr);
    CHECK_FALSE(bench.best.ok());
    CHECK(bench.report.iterations > last);
    last = bench.report.iterations;
  }
}

// Durations that are guessed first set the speed of the reference, and with it costs: what compares is where the
// default ends from the plan of another guess.
TEST_CASE("in few phases a plan costs no more than that from any first guess of the durations") {
  for (const mcplan::Scene& scene : {scenes::flat(), scenes::stairs()}) {
    CAPTURE(scene.name);
    const PlanResult result = solve(scene, phases(10));
    REQUIRE(result.report.status == Status::solved);
    for (const double duration_s : {0.0, 0.2, 0.3, 0.45}) {
      CAPTURE(duration_s);
      Options single = phases(10);
      single.restarts = 0;
      single.duration_initial_s = duration_s;
      const PlanResult other = solve(scene, single);
      if (other.report.status != Status::solved) continue;
      const PlanResult from_other = SwitchedDdp(scene, scenes::humanoid44(), phases(10)).solve(other.plan);
      CHECK(result.report.cost <= 1.001 * from_other.report.cost);
    }
  }
}

TEST_CASE("the time limit is kept, and gives a plan with its status") {
  // Every look at the clock takes 1 ms: soon after the limit the clock must no longer be looked at. Making the first
  // plan takes a dozen.
  for (double limit_s : {0.001, 0.05}) {
    CAPTURE(limit_s);
    const CountingClock clock(0.001);
    Options options;
    options.phases = 60;
    options.time_limit_s = limit_s;
    options.clock = clock;
    const PlanResult result = solve(scenes::gap_with_rail(), options);
    CHECK(result.report.status == Status::time_limit);
    CHECK(result.report.time_s <= limit_s + 0.02);
    CHECK(result.plan.phases.size() == 60);
    CHECK_NOTHROW(result.plan.validate());
    CHECK(result.report.message.find("violates") != std::string::npos);
    CHECK(result.report.worst_violation.value > result.report.worst_violation.tolerance);
  }
}

TEST_CASE("a stop request interrupts, the iteration limit stops; both give a plan") {
  int polls = 0;
  Options options;
  options.stop = [&] { return ++polls > 6; };
  const PlanResult stopped = solve(scenes::stairs(), options);
  CHECK(stopped.report.status == Status::interrupted);
  CHECK(stopped.report.iterations == 6);
  CHECK(stopped.plan.phases.size() == 18);

  options.stop = nullptr;
  for (int limit : {1, 9}) {
    options.max_iterations = limit;
    const PlanResult limited = solve(scenes::stairs(), options);
    CHECK(limited.report.status == Status::iteration_limit);
    CHECK(limited.report.iterations == limit);
    CHECK_NOTHROW(limited.plan.validate());
  }
}

TEST_CASE("too few phases: no_sequence, with advice and without a plan") {
  const PlanResult result = solve(scenes::gap(), phases(3));
  CHECK(result.report.status == Status::no_sequence);
  CHECK(result.report.message.find("phases") != std::string::npos);
  CHECK(result.plan.phases.empty());
}

TEST_CASE("on open ground the walk comes from the stepping guesses: what the search finds without them costs more") {
  Options alone;
  alone.stepping_guesses = false;
  const PlanResult with = solve(scenes::flat(), {}), without = solve(scenes::flat(), alone);
  REQUIRE(with.report.status == Status::solved);
  REQUIRE(without.report.status == Status::solved);
  CHECK(with.report.cost < 0.9 * without.report.cost);
  // Where surfaces decide it, they change nothing.
  CHECK(solve(scenes::stairs(), {}).report.cost == solve(scenes::stairs(), alone).report.cost);
}
