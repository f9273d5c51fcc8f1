#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "ddp/constants.hpp"
#include "ddp/search.hpp"

namespace mcplan::ddp {
namespace {

/// A guess and a trial are given up when they are foreseen to stay above the best one, of which what the motion can
/// change counts so many times, after so many iterations. Measured on 41 pairs of robot and scene, with 5 trials a
/// round: trials that are given up from iteration 4 on above 1.5 times leave two more pairs above the penalty's cost.
constexpr double kGuessAllowance = 3.0, kTrialAllowance = 2.0;
constexpr int kGuessPatience = 12, kTrialPatience = 6;

}  // namespace

// The polish that the options ask for, at the stages of an attempt.

Ending Search::optimise(Incumbent& now, const polish::Settings& settings, const Tuning& tuning) {
  Ending ending = Ending::done;
  if (should_stop(ending)) return ending;
  const Schedule schedule = full_schedule(tuning);
  polish::Outcome outcome;
  {
    const Stopwatch watch(report_->timing_s, "interior_point");
    polish::InteriorPoint solver(*problem_, now.sequence, tuning);
    if (trace_) trace_->foreseen.emplace_back(static_cast<int>(report_->history.size()), solver.constant());
    outcome = solver.solve(now.trajectory, settings, [&](const Trajectory& at, const polish::Progress& progress) {
      now.trajectory = at;
      now.evaluation = Evaluation();
      now.evaluation.cost = progress.objective;
      now.evaluation.defect_sum = now.evaluation.defect_max = progress.defect;
      Iteration row;
      row.index = ++report_->iterations;
      row.step = progress.step;
      record(std::move(row), now, schedule);
      show(now, tuning);
      if (trace_) trace_->foreseen.emplace_back(static_cast<int>(report_->history.size()), progress.foreseen);
      return !should_stop(ending);
    });
  }
  now.evaluation = evaluate(now, tuning);
  return outcome == polish::Outcome::broke_down ? Ending::broke_down : ending;
}

/// From an earlier plan: it is near an optimum, or its start has been moved.
Ending Search::polish_plan(Incumbent& now, const Tuning& tuning) {
  const Incumbent before = now;
  now.evaluation = evaluate(now, tuning);
  const double merit = now.evaluation.merit();
  polish::Settings settings;
  settings.barrier = now.evaluation.defect_max < kConvergedDefect ? kWarmBarrier : kMovedBarrier;
  settings.max_iterations = kExactGuessIterations;
  settings.tolerance = kRoughTolerance;
  settings.to_the_end = false;
  const Ending ending = optimise(now, settings, tuning);
  if ((ending != Ending::done && ending != Ending::broke_down) || now.evaluation.merit() <= merit) return ending;
  // The filter has led to a worse optimum, or to none.
  Incumbent other = before;
  const double never = std::numeric_limits<double>::infinity();
  const Ending second = polish_guess(other, Origin::sequence, never, tuning);
  if (ending == Ending::broke_down || other.evaluation.merit() < now.evaluation.merit()) now = std::move(other);
  if (!(now.evaluation.merit() <= merit)) {
    now = before;
    now.evaluation = evaluate(now, tuning);
  }
  return second == Ending::broke_down && std::isfinite(now.evaluation.merit()) ? Ending::done : second;
}

Ending Search::polish_guess(Incumbent& now, Origin origin, double give_up_above, const Tuning& tuning) {
  if (!exact_contacts(tuning)) return polish(now, kPolishIterations, kRoughTolerance, give_up_above, tuning);
  if (origin == Origin::plan) return polish_plan(now, tuning);
  if (origin == Origin::sequence) {
    const Ending ending = polish(now, kWarmUpIterations, 0.0, give_up_above, tuning);
    if (ending != Ending::done) return ending;
  }
  polish::Settings settings;
  settings.barrier = kColdBarrier;
  settings.proximal = kColdProximal;
  settings.max_iterations = kExactGuessIterations;
  settings.tolerance = kRoughTolerance;
  settings.give_up_above = give_up_above;
  settings.allowance = kGuessAllowance;
  settings.patience = kGuessPatience;
  settings.to_the_end = false;
  return optimise(now, settings, tuning);
}

Ending Search::polish_trial(Incumbent& now, double give_up_above, const Tuning& tuning) {
  const int iterations = exact_contacts(tuning) ? kWarmUpIterations : kTrialIterations;
  const Ending ending = polish(now, iterations, exact_contacts(tuning) ? 0.0 : kRoughTolerance, give_up_above, tuning);
  if (!exact_contacts(tuning) || ending != Ending::done) return ending;
  polish::Settings settings;
  settings.barrier = kTrialBarrier;
  settings.max_iterations = kExactTrialIterations;
  settings.tolerance = kRoughTolerance;
  settings.give_up_above = give_up_above;
  settings.allowance = kTrialAllowance;
  settings.patience = kTrialPatience;
  settings.to_the_end = false;
  return optimise(now, settings, tuning);
}

Ending Search::polish_last(Incumbent& now, const Tuning& tuning, double tolerance) {
  if (!exact_contacts(tuning)) {
    // Limits are penalties: harder ones at the end bring what is left of a violation below the checker's tolerance.
    Tuning hard = tuning;
    hard.limit_weight *= kHardening;
    const double never = std::numeric_limits<double>::infinity();
    return polish(now, kFinalIterations, tolerance, never, hard);
  }
  polish::Settings settings;
  settings.barrier = kWarmBarrier;
  settings.max_iterations = kExactLastIterations;
  settings.tolerance = tolerance;
  // The filter may lead to a worse optimum: what there was is kept then.
  const Incumbent before = now;
  const Ending ending = optimise(now, settings, tuning);
  if (!(now.evaluation.merit() <= before.evaluation.merit())) now = before;
  return ending;
}

}  // namespace mcplan::ddp
