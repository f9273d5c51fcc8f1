#include "planar/sip/attempts.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "mcplan/base/error.hpp"
#include "mcplan/planar/plan_files.hpp"
#include "mcplan/planar/sip/certificate.hpp"
#include "mcplan/planar/sip/planner.hpp"
#include "slow_build.hpp"
#include "tasks.hpp"

using namespace mcplan::sip;
using mcplan::Status;
using mcplan::nlp::Solver;

namespace {

Options with(Solver solver, Forces forces, bool cost) {
  Options options;
  options.solver = solver;
  options.forces = forces;
  if (!cost) options.torque_weight = 0.0;
  return options;
}

}  // namespace

TEST_CASE("Ipopt comes alone, the kernel alone, and after it where both may be asked") {
  for (const bool cost : {false, true}) {
    Options options;
    CHECK(attempts_for(options, cost).front().solver == Solver::ipopt);
    options.solver = Solver::ipm;
    CHECK(attempts_for(options, cost).size() == 1);
    CHECK(attempts_for(options, cost).front().solver == Solver::ipm);
    options.solver = Solver::automatic;
    CHECK(attempts_for(options, cost).front().solver == Solver::ipm);
    CHECK(attempts_for(options, cost).back().solver == Solver::ipopt);
  }
}

TEST_CASE("the kernel finds motions within all constraints, whatever the weights of forces, and says that it did") {
  for (const Forces forces : {Forces::uniform, Forces::per_body, Forces::per_point}) {
    CAPTURE(static_cast<int>(forces));
    const Result result = Planner(planar_tasks::cartwheel(), with(Solver::ipm, forces, false)).solve();
    CHECK_MESSAGE(result.report.status == Status::solved, result.report.message);
    CHECK(result.solver == Solver::ipm);
    CHECK(check(result.plan).ok());
  }
}

TEST_CASE("the kernel's cheapest cartwheel costs what Ipopt's does, and is proved") {
  const Result reference = Planner(planar_tasks::cartwheel(), with(Solver::ipopt, Forces::per_point, true)).solve();
  const Result result = Planner(planar_tasks::cartwheel(), with(Solver::ipm, Forces::per_point, true)).solve();
  REQUIRE(reference.report.status == Status::solved);
  CHECK_MESSAGE(result.report.status == Status::solved, result.report.message);
  CHECK(reference.solver == Solver::ipopt);
  CHECK(result.solver == Solver::ipm);
  CHECK(result.report.cost <= 1.01 * reference.report.cost);
  CHECK(certify(result.plan).proved());
  if (kSlowBuild) return;
  // The same bytes again, and with both allowed, since the kernel does not fail.
  CHECK(Planner(planar_tasks::cartwheel(), with(Solver::ipm, Forces::per_point, true)).solve().plan == result.plan);
  CHECK(Planner(planar_tasks::cartwheel(), with(Solver::automatic, Forces::per_point, true)).solve().plan ==
        result.plan);
}

TEST_CASE("second derivatives may be chosen for the kernel, but it has no history of them") {
  Options options = with(Solver::ipm, Forces::uniform, true);
  for (const HessianChoice hessian : {HessianChoice::exact, HessianChoice::gauss_newton}) {
    options.hessian = hessian;
    CHECK_NOTHROW(options.validate());
    CHECK(attempts_for(options, true).front().hessian == hessian);
    CHECK_FALSE(attempts_for(options, true).front().kernel.blend_hessians);
  }
  options.hessian = HessianChoice::limited_memory;
  std::string field;
  try {
    options.validate();
  } catch (const mcplan::InvalidOptions& error) {
    field = error.field();
  }
  CHECK(field == "hessian");
}

TEST_CASE("a history of first derivatives is Ipopt's where there is a cost, and says nothing where there is none") {
  Options options = with(Solver::automatic, Forces::uniform, true);
  options.hessian = HessianChoice::limited_memory;
  for (const Attempt& attempt : attempts_for(options, true)) {
    CHECK(attempt.solver == Solver::ipopt);
    CHECK(attempt.hessian == HessianChoice::limited_memory);
  }
  CHECK(attempts_for(options, false).front().solver == Solver::ipm);
}

TEST_CASE("each kind of forces gives way to the one with one more kind of weights, and the last to none") {
  CHECK(freer(Forces::uniform) == Forces::per_body);
  CHECK(freer(Forces::per_body) == Forces::per_point);
  CHECK_FALSE(freer(Forces::per_point).has_value());
  CHECK_FALSE(freer(Forces::parameters).has_value());  // they have no weights
}

TEST_CASE("a try is the kernel's alone, has few iterations and changes nothing else") {
  for (const Solver solver : {Solver::automatic, Solver::ipm}) {
    Options options = with(solver, Forces::per_body, true);
    options.hessian = HessianChoice::limited_memory;
    for (const int max : {0, 1, kTrialIterations - 1, kTrialIterations, kTrialIterations + 1, 100000}) {
      options.max_iterations = max;
      const Options trial = trial_of(options);
      CHECK(trial.solver == Solver::ipm);
      CHECK(trial.max_iterations == std::min(max, kTrialIterations));
      CHECK(trial.forces == options.forces);
      CHECK(trial.hessian == options.hessian);
      CHECK(trial.torque_weight == options.torque_weight);
      CHECK(trial.time_limit_s == options.time_limit_s);
      for (const bool cost : {false, true})
        if (trial.hessian != HessianChoice::limited_memory || !cost)
          for (const Attempt& attempt : attempts_for(trial, cost)) CHECK(attempt.solver == Solver::ipm);
    }
  }
}

TEST_CASE("no attempt has more iterations than are allowed, and the kernel begins far away without a cost alone") {
  for (const Solver solver : {Solver::ipopt, Solver::ipm, Solver::automatic})
    for (const HessianChoice hessian : {HessianChoice::automatic, HessianChoice::exact, HessianChoice::gauss_newton})
      for (const bool cost : {false, true})
        for (const int max : {3, 250, 5000}) {
          Options options = with(solver, Forces::uniform, cost);
          options.hessian = hessian;
          options.max_iterations = max;
          const std::vector<Attempt> attempts = attempts_for(options, cost);
          REQUIRE_FALSE(attempts.empty());
          for (const Attempt& attempt : attempts) {
            CHECK(attempt.max_iterations <= max);
            CHECK(attempt.initial_barrier > 0.0);
            const bool kernel = attempt.solver == Solver::ipm;
            CHECK(attempt.kernel.distant_start == (kernel && !cost));
            CHECK(attempt.kernel.feasible_is_enough == (kernel && !cost));
            CHECK(attempt.kernel.blend_hessians == (kernel && cost && hessian == HessianChoice::automatic));
          }
        }
}

TEST_CASE("motors that are far too weak are said to be: nothing within all constraints is near") {
  mcplan::PlanarTask task = planar_tasks::cartwheel();
  for (auto& body : task.robot.bodies) body.torque_max *= 0.08;
  for (const Forces forces : {Forces::uniform, Forces::per_body}) {
    if (kSlowBuild && forces == Forces::per_body) continue;
    const Result result = Planner(task, with(Solver::ipm, forces, false)).solve();
    CHECK_MESSAGE(result.report.status == Status::infeasible, result.report.message);
    CHECK(result.report.worst_violation.name == "torque");
    CHECK(result.report.message.find("torque at") != std::string::npos);
  }
}
