#include "mcplan/ddp/best_plan.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "clocks.hpp"
#include "mcplan/ddp/switched_ddp.hpp"
#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;
using mcplan::PlanResult;
using mcplan::Status;

PlanResult solve(const mcplan::Scene& scene, double limit_s, double tick_s = 1e-3) {
  Options options;
  options.time_limit_s = limit_s;
  options.clock = CountingClock(tick_s);
  return SwitchedDdp(scene, scenes::humanoid44(), options).solve();
}

/// The checker's measure, by which accepted plans are equal.
double ratio(const PlanResult& result) {
  const mcplan::Violation worst = mcplan::check(result.plan, result.plan.scene, result.plan.robot).worst();
  return std::max(1.0, violation_ratio(worst));
}

}  // namespace

TEST_CASE("a longer time limit never gives a worse plan by the checker's measure") {
  for (const mcplan::Scene& scene : scenes::all_four()) {
    if (kSlowBuild && scene.name == "gap_with_rail") continue;
    CAPTURE(scene.name);
    double before = std::numeric_limits<double>::infinity(), first = 0.0;
    for (double limit_s : {0.001, 0.01, 0.03, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2}) {
      CAPTURE(limit_s);
      const PlanResult result = solve(scene, limit_s);
      REQUIRE(result.plan.phases.size() == 18);
      CHECK((result.report.status == Status::time_limit || result.report.status == Status::solved));
      const double now = ratio(result);
      MESSAGE(scene.name, ", ", limit_s, ": ", now);
      // Iterates are compared at some hundred instants, here at all.
      CHECK(now <= 1.05 * before);
      before = std::min(before, now);
      if (first == 0.0) first = now;
    }
    CHECK(before < 0.5 * first);
  }
}

TEST_CASE("however short the limit, the plan stands on its surfaces and is no first linearisation") {
  for (const mcplan::Scene& scene : scenes::all_four()) {
    CAPTURE(scene.name);
    const PlanResult result = solve(scene, 1e-6);
    CHECK(result.report.status == Status::time_limit);
    CHECK(result.report.iterations == 0);
    CHECK_NOTHROW(result.plan.validate());
    CHECK(result.report.cost < 1e4);
  }
}

TEST_CASE("an end by the clock says what is violated most, and when") {
  const PlanResult result = solve(scenes::stairs(), 0.01);
  CHECK(result.report.status == Status::time_limit);
  CHECK(result.report.message == "the best plan violates " + result.report.worst_violation.to_string());
  CHECK(result.report.worst_violation.value > result.report.worst_violation.tolerance);
}

TEST_CASE("what is violated is measured in tolerances; where none is allowed it is beyond all others") {
  mcplan::Violation v;
  v.value = 0.03;
  v.tolerance = 0.01;
  CHECK(violation_ratio(v) == doctest::Approx(3.0));
  v.tolerance = 0.0;
  CHECK(violation_ratio(v) > 1e9);
  v.value = 0.0;
  CHECK(violation_ratio(v) == 0.0);
}
