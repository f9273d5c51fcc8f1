#include <cstddef>
#include <limits>
#include <utility>

#include "ddp/constants.hpp"
#include "ddp/search.hpp"

namespace mcplan::ddp {
namespace {

/// A guess and a trial are given up when their merit is foreseen to stay above so many times the best one's: the
/// barrier falls last, and with it a good part of the merit. Measured on flat: with 1 the best of the four guesses is
/// given up.
constexpr double kGuessAllowance = 1.5, kTrialAllowance = 1.1;

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
    outcome = solver.solve(now.trajectory, settings, [&](const Trajectory& at, const polish::Progress& progress) {
      now.trajectory = at;
      now.evaluation = Evaluation();
      now.evaluation.cost = progress.objective;
      now.evaluation.defect_sum = now.evaluation.defect_max = progress.defect;
      Iteration row;
      row.index = ++report_->iterations;
      row.step = progress.step;
      record(std::move(row), now, schedule);
      if (watcher_) watcher_(now, tuning);
      return !should_stop(ending);
    });
  }
  now.evaluation = evaluate(now, tuning);
  return outcome == polish::Outcome::broke_down ? Ending::broke_down : ending;
}

Ending Search::polish_guess(Incumbent& now, double give_up_above, const Tuning& tuning) {
  if (!exact_contacts()) return polish(now, kPolishIterations, kRoughTolerance, give_up_above, tuning);
  polish::Settings settings;
  settings.barrier = kColdBarrier;
  settings.max_iterations = kExactGuessIterations;
  settings.tolerance = kRoughTolerance;
  settings.give_up_above = kGuessAllowance * give_up_above;
  return optimise(now, settings, tuning);
}

Ending Search::polish_trial(Incumbent& now, double give_up_above, const Tuning& tuning) {
  if (!exact_contacts()) return polish(now, kTrialIterations, kRoughTolerance, give_up_above, tuning);
  polish::Settings settings;
  settings.barrier = kTrialBarrier;
  settings.max_iterations = kExactTrialIterations;
  settings.tolerance = kRoughTolerance;
  settings.give_up_above = kTrialAllowance * give_up_above;
  return optimise(now, settings, tuning);
}

Ending Search::polish_last(Incumbent& now, const Tuning& tuning) {
  if (!exact_contacts()) {
    // Limits are penalties: harder ones at the end bring what is left of a violation below the checker's tolerance.
    Tuning hard = tuning;
    hard.limit_weight *= kHardening;
    const double never = std::numeric_limits<double>::infinity();
    return polish(now, kFinalIterations, kFinalTolerance, never, hard);
  }
  polish::Settings settings;
  settings.barrier = kWarmBarrier;
  settings.max_iterations = kExactLastIterations;
  settings.tolerance = kFinalTolerance;
  // The filter may lead to a worse optimum: what there was is kept then.
  const Incumbent before = now;
  const Ending ending = optimise(now, settings, tuning);
  if (!(now.evaluation.merit() <= before.evaluation.merit())) now = before;
  return ending;
}

}  // namespace mcplan::ddp
