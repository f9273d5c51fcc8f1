#include "ddp/replan/trials.hpp"

#include <algorithm>
#include <sstream>
#include <string>

#include "ddp/best_plan.hpp"
#include "ddp/constants.hpp"
#include "model/text.hpp"

namespace mcplan::ddp {
namespace {

/// Steps that catch a push are solved once more where they miss limits by up to so many tolerances: they are few.
/// Chosen.
constexpr double kRecoveryMiss = 60.0;

Status status_of(const Trial& trial) {
  if (trial.ok()) return Status::solved;
  if (trial.ending == Ending::time_limit || !trial.seen_in_full()) return Status::time_limit;
  if (trial.ending == Ending::interrupted) return Status::interrupted;
  if (trial.ending == Ending::iteration_limit) return Status::iteration_limit;
  return trial.exact && violation_ratio(trial.check.worst()) <= kAcceptable ? Status::acceptable : Status::infeasible;
}

const char* name_of(PlanFrom from) {
  if (from == PlanFrom::same_sequence) return "the plan's own sequence";
  if (from == PlanFrom::stop) return "a stand";
  if (from == PlanFrom::recovery) return "steps that catch a push";
  return from == PlanFrom::other_sequence ? "other steps or a hand" : "the plan as it was planned";
}

std::string message_of(const Trial& best, const Report& report) {
  std::ostringstream message;
  if (report.plan_from == PlanFrom::previous_plan)
    message << "nothing better than the plan as it was planned was found in time";
  else if (best.ok())
    message << "the checker accepts the plan (" << name_of(report.plan_from) << ")";
  else if (!best.exact)
    message << "the contacts could not be made exact";
  else if (!best.check.complete || best.check.ok())
    message << "stopped before the checker had seen the plan in full";
  else
    message << "the best plan violates " << report.worst_violation.to_string();
  if (!report.start_violations.empty())
    message << "; the measured state violates " << report.start_violations.front().to_string();
  if (!best.ok()) message << "; all limits are kept until " << model::digits(report.kept_until_s, "%.3g") << " s";
  return message.str();
}

}  // namespace

bool Trials::done() const { return solved() || too_late() || (best_ && iterations_left(best_->phases) < kWorthwhile); }

bool Trials::acceptable() const {
  if (!best_) return false;
  const Status status = status_of(*best_);
  return status == Status::solved || status == Status::acceptable;
}

void Trials::make(const Now& now, const Rest& rest, PlanFrom from, bool apart) {
  const double begin_s = now_->deadline->elapsed_s();
  std::optional<Trial> trial = attempt(now, rest, apart, nullptr);
  Again again;
  const bool few = from == PlanFrom::recovery;
  again.hold_joints = trial && (few || !held_joints_) && asks_too_much_of_joints(*trial);
  if (trial && !again.hold_joints && misses_by_little(*trial, few ? kRecoveryMiss : kAcceptable))
    again.missed = trial->check.violations();
  const bool worth_it = again.hold_joints || !again.missed.empty();
  if (worth_it) again.from = trial->plan;
  take(std::move(trial), from);
  held_joints_ = held_joints_ || (again.hold_joints && !few);
  // What is missed by little takes few iterations: they are not counted.
  const bool uncounted = apart || !again.missed.empty();
  if (worth_it && !(uncounted ? solved() || too_late() : done())) take(attempt(now, rest, uncounted, &again), from);
  longest_s_ = std::max(longest_s_, now_->deadline->elapsed_s() - begin_s);
}

void Trials::take(std::optional<Trial> trial, PlanFrom from) {
  tell(trial, from);
  if (!trial || (best_ && !better(*trial, *best_))) return;
  if (sound_only_ && status_of(*trial) == Status::infeasible) return;
  best_ = std::move(trial);
  best_ratio_ = ratio_;
  report_->plan_from = from;
}

std::optional<Trial> Trials::attempt(const Now& now, const Rest& rest, bool apart, const Again* again) {
  const int iterations = best_ && !apart ? iterations_left(best_->phases) : kReplanIterations;
  std::optional<Trial> trial = try_out(now, rest, *report_, iterations, again);
  if (trial && !apart) work_ += trial->work;
  return trial;
}

void Trials::tell(const std::optional<Trial>& trial, PlanFrom from) const {
  const Logger& logger = now_->options->search.logger;
  if (!logger) return;
  std::ostringstream line;
  line << "replan, " << name_of(from) << ": ";
  if (!trial)
    line << "the scene's rules do not allow it";
  else
    line << trial->plan.phases.size() << " phases, cost " << model::digits(trial->evaluation.cost, "%.4g") << ", "
         << (trial->ok() ? std::string("accepted") : trial->check.worst().to_string());
  logger(LogLevel::info, line.str());
}

int Trials::iterations_left(int phases) const {
  const int left = now_->options->max_work - work_;
  return std::clamp(left / std::max(1, phases), 0, kReplanIterations);
}

void conclude(Trials& trials, Report& report, PlanResult& out) {
  std::optional<Trial>& best = trials.best();
  if (!best) {
    report.status = Status::no_sequence;
    report.message = "the scene's rules allow no sequence that goes on from the measured contacts";
    return;
  }
  look_closely(*best, trials.now());
  report.status = status_of(*best);
  report.worst_violation = best->check.worst();
  report.start_violations = best->check.start;
  report.kept_until_s = best->exact ? best->kept_until_s() : 0.0;
  report.checked_until_s = best->check.checked_until_s;
  report.warnings = best->check.warnings;
  report.cost = best->evaluation.cost;
  report.message = message_of(*best, report);
  if (trials.best_ratio() < 1.0)
    report.message += "; " + model::digits(trials.best_ratio(), "%.2g") + " of the velocity command is followed";
  out.plan = std::move(best->plan);
}

}  // namespace mcplan::ddp
