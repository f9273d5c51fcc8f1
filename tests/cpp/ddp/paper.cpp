#include <doctest/doctest.h>

#include <limits>

#include "ddp/initial_sequence.hpp"
#include "ddp/search.hpp"
#include "mcplan/ddp/switched_ddp.hpp"
#include "mcplan/plan/checker.hpp"
#include "support.hpp"

namespace {

using mcplan::Deadline;
using namespace support;
using namespace mcplan::ddp;
using mcplan::Status;

Options paper() {
  Options out = phases(18);
  out.method = Method::paper;
  out.stiffness_input = StiffnessInput::lambda;
  out.record_history = true;
  return out;
}

}  // namespace

TEST_CASE("the paper's Algorithm 2 switches in every iteration, for its J* starts from infinity") {
  const Problem problem(scenes::flat(), scenes::humanoid44(), paper());
  const Deadline deadline(1e9);
  mcplan::Report report;
  Search search(problem, deadline, report);
  Incumbent now;
  now.trajectory = problem.initial_guess({});
  search.model().expand(now.trajectory, schedule(0.01, 0.0, 0.0));
  now.sequence = initial_sequence(search.model());
  constexpr int kIterations = 20;
  CHECK(search.run_paper(now, kIterations, problem.tuning()) == Ending::done);
  REQUIRE(report.history.size() == kIterations);
  double weight = 0.01;
  for (const mcplan::Iteration& row : report.history) {
    CHECK(row.switches >= 1);
    CHECK(row.neighbours > 0);
    CHECK(row.contact_weight == doctest::Approx(weight));
    CHECK(problem.rules.valid(row.sequence));
    weight = std::min(2.0 * weight, 100.0);
  }
}

TEST_CASE("method paper takes the paper's model, whichever is asked for") {
  std::vector<mcplan::PlanResult> results;
  for (Model model : kModels) {
    Options options = paper();
    options.model = model;
    options.max_iterations = 15;
    results.push_back(SwitchedDdp(scenes::stairs(), scenes::humanoid44(), options).solve());
    for (const mcplan::Phase& phase : results.back().plan.phases)
      CHECK(std::holds_alternative<mcplan::laws::Pendulum>(phase.law));
  }
  CHECK(results[0].report.cost == results[1].report.cost);
  CHECK(results[0].report.cost > 0.0);
}

TEST_CASE("method paper runs on every scene and says honestly how it went") {
  for (const mcplan::Scene& scene : scenes::all_four()) {
    CAPTURE(scene.name);
    Options options = paper();
    if (kSlowBuild) options.max_iterations = 10;
    const mcplan::PlanResult result = SwitchedDdp(scene, scenes::humanoid44(), options).solve();
    CHECK(result.report.iterations > 0);
    CHECK(result.report.iterations <= 100);
    CHECK_FALSE(result.report.message.empty());
    const bool passes = mcplan::check(result.plan, scene, scenes::humanoid44()).ok();
    CHECK((result.report.status == Status::solved) == passes);
    if (result.report.status != Status::solved) {
      CHECK_FALSE(result.report.worst_violation.name.empty());
      CHECK(result.report.worst_violation.value > result.report.worst_violation.tolerance);
    }
  }
}
