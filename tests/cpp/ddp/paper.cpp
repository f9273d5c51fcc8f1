#include <doctest/doctest.h>

#include <limits>
#include <thread>

#include "ddp/initial_sequence.hpp"
#include "ddp/search.hpp"
#include "mcplan/base/error.hpp"
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

/// As many threads as run at once, at most.
unsigned processors() { return std::thread::hardware_concurrency(); }

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

TEST_CASE("the paper's neighbours are priced in parallel, to the same last bit for any number of threads") {
  std::vector<mcplan::PlanResult> results;
  for (int threads : {1, 2, 4}) {
    Options options = paper();
    options.threads = threads;
    options.max_iterations = 12;
    results.push_back(SwitchedDdp(scenes::gap_with_rail(), scenes::humanoid44(), options).solve());
    const mcplan::Report& report = results.back().report;
    const bool several = threads > 1 && processors() > 1;
    // A loop for each switch, and one more in each iteration that finds no further one.
    CHECK(report.parallel_loops == (several ? report.switches + report.iterations : 0));
    CHECK(report.paper_cost == results.front().report.paper_cost);
    REQUIRE(report.history.size() == results.front().report.history.size());
    for (std::size_t i = 0; i < report.history.size(); ++i) {
      CHECK(report.history[i].cost == results.front().report.history[i].cost);
      CHECK(report.history[i].sequence == results.front().report.history[i].sequence);
    }
  }
}

TEST_CASE("ours shares out the neighbours of many candidates only, and says how often it did") {
  Options options = phases(18);
  options.threads = 2;
  options.max_iterations = 30;
  CHECK(SwitchedDdp(scenes::flat(), scenes::humanoid44(), options).solve().report.parallel_loops == 0);
}

TEST_CASE("the paper's mode tells its own cost and verdict beside the checker's") {
  Options options = paper();
  const mcplan::Report report = SwitchedDdp(scenes::flat(), scenes::humanoid44(), options).solve().report;
  CHECK(report.paper_cost == report.history.back().cost);
  CHECK(report.paper_verdict.find("converged: in the last 10 iterations its cost changed by ") != std::string::npos);
  CHECK(report.message.rfind("the published algorithm: " + report.paper_verdict + ", cost ", 0) == 0);
  options.max_iterations = 5;
  CHECK(SwitchedDdp(scenes::flat(), scenes::humanoid44(), options).solve().report.paper_verdict ==
        "not converged: stopped after 5 iterations");
  CHECK(SwitchedDdp(scenes::flat(), scenes::humanoid44(), phases(18)).solve().report.paper_verdict.empty());
}

TEST_CASE("the paper's mode does what its options say, or refuses them") {
  Options options = paper();
  options.max_iterations = 70;
  CHECK(SwitchedDdp(scenes::flat(), scenes::humanoid44(), options).solve().report.iterations == 70);
  options = paper();
  options.max_iterations = 3;
  options.proximal_weight = 50.0;
  CHECK(SwitchedDdp(scenes::flat(), scenes::humanoid44(), options).solve().report.history[0].proximal_weight == 50.0);
  const auto refused = [](auto change) {
    Options changed = paper();
    change(changed);
    try {
      changed.validate();
    } catch (const mcplan::InvalidOptions& error) {
      return error.field();
    }
    return std::string();
  };
  CHECK(refused([](Options& o) { o.restarts = 5; }) == "restarts");
  CHECK(refused([](Options& o) { o.restarts = 0; }).empty());
  CHECK(refused([](Options& o) { o.interior_points = 2; }) == "interior_points");
  CHECK(refused([](Options& o) { o.friction_sides = 4; }) == "friction_sides");
  CHECK(refused([](Options& o) { o.reach_margin_m = 0.01; }) == "reach_margin_m");
  CHECK(refused([](Options& o) { o.sole_inside = 1.0; }) == "sole_inside");
  CHECK(refused([](Options& o) { o.weights.momentum = 1.0; }) == "weights.momentum");
  CHECK(refused([](Options& o) { o.weights.own["flight"] = 2.0; }) == "weights.flight");
  CHECK(refused([](Options& o) { o.weights.com = 2.0; }).empty());
  SwitchedDdp planner(scenes::flat(), scenes::humanoid44(), paper());
  const mcplan::Plan plan = SwitchedDdp(scenes::flat(), scenes::humanoid44(), phases(18)).solve().plan;
  CHECK_THROWS_AS(planner.solve(plan), mcplan::InvalidOptions);
  CHECK_THROWS_AS(planner.replan(plan, 0.5, plan.knots[1]), mcplan::InvalidOptions);
}
