#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "ddp/plan_conversion.hpp"
#include "ddp/search.hpp"
#include "ddp/stepping_sequence.hpp"
#include "ddp/support.hpp"
#include "mcplan/ddp/plan.hpp"
#include "mcplan/ddp/switched_ddp.hpp"
#include "mcplan/plan/checker.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

mcplan::PlanResult planned(const mcplan::Scene& scene, Polish polish, int threads) {
  Options options;
  options.polish = polish;
  options.threads = threads;
  return plan(scene, scenes::humanoid44(), options);
}

}  // namespace

TEST_CASE("with the interior point stairs are planned at no higher cost, the same for any number of threads") {
  const mcplan::PlanResult penalty = planned(scenes::stairs(), Polish::penalty, 1);
  const mcplan::PlanResult one = planned(scenes::stairs(), Polish::interior_point, 1);
  const mcplan::PlanResult two = planned(scenes::stairs(), Polish::interior_point, 2);
  CHECK(one.report.status == mcplan::Status::solved);
  CHECK(one.report.cost <= penalty.report.cost);
  REQUIRE(one.plan.knots.size() == two.plan.knots.size());
  for (std::size_t k = 0; k < one.plan.knots.size(); ++k) {
    CHECK(one.plan.knots[k].com_W == two.plan.knots[k].com_W);
    CHECK(one.plan.knots[k].angular_momentum_W == two.plan.knots[k].angular_momentum_W);
  }
}

TEST_CASE(
    "plans of the interior point are stationary: a step foresees less than 1e-4 of the cost, defects are closed") {
  for (const mcplan::Scene& scene : scenes::all_four()) {
    CAPTURE(scene.name);
    const mcplan::PlanResult result = planned(scene, Polish::interior_point, 1);
    REQUIRE(result.report.status == mcplan::Status::solved);
    Options options;
    options.phases = static_cast<int>(result.plan.phases.size());
    const Problem problem(scene, scenes::humanoid44(), options);
    Incumbent now = from_plan(problem, result.plan, 0);
    polish::InteriorPoint solver(problem, now.sequence, problem.tuning());
    polish::Settings last;
    last.barrier = 1e-6;
    last.max_iterations = 1;
    solver.solve(now.trajectory, last);
    CHECK(std::abs(solver.gain()) < 1e-4 * solver.objective());
    CHECK(solver.defect() < 1e-5);
  }
}

TEST_CASE("from an earlier plan the interior point never ends above it") {
  for (const mcplan::Scene& scene : scenes::all_four()) {
    CAPTURE(scene.name);
    const mcplan::PlanResult earlier = planned(scene, Polish::penalty, 1);
    Options options;
    options.polish = Polish::interior_point;
    options.phases = static_cast<int>(earlier.plan.phases.size());
    const Problem problem(scene, scenes::humanoid44(), options);
    const mcplan::Deadline deadline(std::numeric_limits<double>::infinity());
    mcplan::Report report;
    Search search(problem, deadline, report);
    Incumbent now = from_plan(problem, earlier.plan, 0);
    const double before = search.evaluate(now, problem.tuning()).merit();
    const double never = std::numeric_limits<double>::infinity();
    CHECK(search.polish_guess(now, Search::Origin::plan, never, problem.tuning()) == Ending::done);
    CHECK(now.evaluation.merit() <= before);
  }
}

TEST_CASE("a plan of the interior point is planned anew from where it is, and accepted") {
  const mcplan::Scene scene = scenes::stairs();
  const mcplan::PlanResult first = planned(scene, Polish::interior_point, 1);
  Options options;
  options.polish = Polish::interior_point;
  for (double ratio : {0.2, 0.5, 0.8}) {
    CAPTURE(ratio);
    const double t = ratio * first.plan.duration();
    const mcplan::PlanState state = first.plan.at(t);
    mcplan::Knot measured;
    measured.com_W = state.com_W;
    measured.com_velocity_W = state.com_velocity_W;
    measured.base_rpy = state.base_rpy;
    measured.base_rpy_rate = state.base_rpy_rate;
    measured.angular_momentum_W = state.angular_momentum_W;
    for (const mcplan::EndEffectorState& end : state.end_effectors) measured.end_effectors_W.push_back(end.position_W);
    const mcplan::PlanResult again = SwitchedDdp(scene, scenes::humanoid44(), options).replan(first.plan, t, measured);
    CHECK(again.report.status == mcplan::Status::solved);
    CHECK(mcplan::check(again.plan, again.plan.scene, again.plan.robot).ok());
  }
}
