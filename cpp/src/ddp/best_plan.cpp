#include "ddp/best_plan.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "ddp/constants.hpp"
#include "ddp/plan_conversion.hpp"
#include "ddp/reachable_surfaces.hpp"

namespace mcplan::ddp {

double BestPlan::sample_s(const Plan& plan, Look look) {
  if (look == Look::full) return Tolerances().sample_s;
  const double per_phase = look == Look::late ? kLookInstantsPerPhaseLate : kLookInstantsPerPhase;
  const double instants = std::max(kLookInstants, per_phase * static_cast<double>(plan.phases.size()));
  return std::max(Tolerances().sample_s, plan.duration() / instants);
}

double violation_ratio(const Violation& v) {
  if (v.tolerance > 0.0) return v.value / v.tolerance;
  return v.value > 0.0 ? 1e9 * (1.0 + v.value) : 0.0;
}

BestPlan::Finished BestPlan::converted(Search& search, const std::vector<int>& surfaces, const Incumbent& now,
                                       const Tuning& tuning, bool swing_heights) const {
  Finished out;
  out.plan = to_plan(search.problem(), now, swing_heights);
  out.plan.measured_start = measured_start_;
  put_back(out.plan, *scene_, surfaces);
  out.evaluation = search.evaluate(now, tuning);
  return out;
}

/// Ends a check when time is up; null without a limit.
StopRequest BestPlan::when_passed() const {
  if (!deadline_->limited()) return nullptr;
  return [this] { return deadline_->passed(); };
}

/// True when the checker accepts the plan, or what it sees of it at few instants. A look that `stop` ends says nothing.
bool BestPlan::judge(Finished& finished, const Problem& problem, Look look, const StopRequest& stop) const {
  Tolerances tolerances;
  if (!problem.options.one_switch_per_step) tolerances.switches = std::numeric_limits<int>::max();
  tolerances.sample_s = sample_s(finished.plan, look);
  const CheckResult result = check(finished.plan, *scene_, problem.robot, tolerances, stop);
  if (!result.complete) return false;
  finished.sample_s = tolerances.sample_s;
  finished.ok = result.ok() && look == Look::full;
  finished.sampled = look != Look::full;
  finished.worst = result.worst();
  finished.warnings = result.warnings;
  return result.ok();
}

void BestPlan::take(Finished&& finished) {
  const bool better =
      !best_ || (finished.ok && !best_->ok) ||
      (finished.ok == best_->ok && (finished.ok ? finished.evaluation.merit() < best_->evaluation.merit()
                                                : violation_ratio(finished.worst) < violation_ratio(best_->worst)));
  if (better) best_ = std::move(finished);
}

bool BestPlan::finish(Search& search, const std::vector<int>& surfaces, Incumbent now, const Tuning& tuning) {
  // If the contacts cannot be met exactly, the plan is kept as it is, and the checker says what is wrong with it.
  const StopRequest late = when_passed();
  search.make_exact(now, tuning, late);
  if (best_ && late && late()) return best_->ok;
  const Stopwatch watch(search.report().timing_s, "check");
  Finished finished = converted(search, surfaces, now, tuning, !(late && late()));
  finished.sampled = true;
  judge(finished, search.problem(), Look::full, late);
  if (finished.sampled && best_) return best_->ok;
  if (finished.sampled) judge(finished, search.problem(), Look::late);
  take(std::move(finished));
  return best_->ok;
}

void BestPlan::keep(Search& search, const std::vector<int>& surfaces, const Incumbent& now, const Tuning& tuning) {
  if (!deadline_->limited()) return;
  const double begin_s = deadline_->elapsed_s();
  if (best_ && (begin_s < next_s_ || deadline_->remaining_s() < cost_s_)) return;
  if (ok() && !(search.evaluate(now, tuning).merit() < kCheaper * best_->evaluation.merit())) return;
  Incumbent iterate = now;
  const double until_s = begin_s + std::max(deadline_->remaining_s(), 0.0) + (best_ ? 0.0 : kGrace_s);
  int rounds = 0;
  search.make_exact(iterate, tuning, [&] {
    const double now_s = deadline_->elapsed_s();
    const bool hopeless = !best_ && ++rounds == 2 && begin_s + kExactRoundsMin * (now_s - begin_s) > until_s;
    return hopeless || now_s >= until_s;
  });
  const bool late = deadline_->passed();
  if (best_ && late) return;
  const Stopwatch watch(search.report().timing_s, "check");
  Finished finished = converted(search, surfaces, iterate, tuning, !late);
  const double converted_s = deadline_->elapsed_s();
  const Look look = deadline_->remaining_s() <= 0.0 ? Look::late : Look::few;
  if (best_ && look == Look::late) return;
  finished.sampled = true;
  const bool accepted = judge(finished, search.problem(), look, best_ ? when_passed() : nullptr);
  if (finished.sample_s == 0.0) return;
  instant_s_ = (deadline_->elapsed_s() - converted_s) * finished.sample_s / finished.plan.duration();
  if (accepted && full_look_s(finished.plan) <= deadline_->remaining_s())
    judge(finished, search.problem(), Look::full, when_passed());
  take(std::move(finished));
  const double end_s = deadline_->elapsed_s();
  cost_s_ = end_s - begin_s;
  next_s_ = end_s + std::min(++kept_, kPauseMax) * cost_s_;
}

void BestPlan::settle(const Problem& problem, Report& report) {
  if (!best_ || !best_->sampled || full_look_s(best_->plan) > std::max(deadline_->remaining_s(), kGrace_s)) return;
  const Stopwatch watch(report.timing_s, "check");
  const double until_s = deadline_->elapsed_s() + std::max(deadline_->remaining_s(), kGrace_s);
  judge(*best_, problem, Look::full, [&] { return deadline_->elapsed_s() >= until_s; });
}

/// What a check in full will take, from what the last one at few instants took.
double BestPlan::full_look_s(const Plan& plan) const {
  return instant_s_ * plan.duration() / sample_s(plan, Look::full);
}

}  // namespace mcplan::ddp
