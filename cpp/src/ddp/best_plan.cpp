#include "mcplan/ddp/best_plan.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "mcplan/ddp/constants.hpp"
#include "mcplan/ddp/plan_conversion.hpp"
#include "mcplan/ddp/reachable_surfaces.hpp"

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
                                       const Tuning& tuning) const {
  Finished out;
  out.plan = to_plan(search.problem(), now);
  out.plan.measured_start = measured_start_;
  put_back(out.plan, *scene_, surfaces);
  out.evaluation = search.evaluate(now, tuning);
  return out;
}

/// True when the checker accepts the plan, or what it sees of it at few instants.
bool BestPlan::judge(Finished& finished, const Problem& problem, Look look) const {
  Tolerances tolerances;
  if (!problem.options.one_switch_per_step) tolerances.switches = std::numeric_limits<int>::max();
  tolerances.sample_s = sample_s(finished.plan, look);
  const CheckResult result = check(finished.plan, *scene_, problem.robot, tolerances);
  finished.ok = result.ok() && look == Look::full;
  finished.sampled = look != Look::full;
  finished.worst = result.worst();
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
  search.make_exact(now, tuning);
  const Stopwatch watch(search.report().timing_s, "check");
  Finished finished = converted(search, surfaces, now, tuning);
  judge(finished, search.problem(), Look::full);
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
  const Stopwatch watch(search.report().timing_s, "check");
  Finished finished = converted(search, surfaces, iterate, tuning);
  const double converted_s = deadline_->elapsed_s();
  const Look look = deadline_->passed() ? Look::late : Look::few;
  const bool accepted = judge(finished, search.problem(), look);
  instant_s_ = (deadline_->elapsed_s() - converted_s) * sample_s(finished.plan, look) / finished.plan.duration();
  if (accepted && full_look_s(finished.plan) <= deadline_->remaining_s()) judge(finished, search.problem(), Look::full);
  take(std::move(finished));
  const double end_s = deadline_->elapsed_s();
  cost_s_ = end_s - begin_s;
  next_s_ = end_s + std::min(++kept_, kPauseMax) * cost_s_;
}

void BestPlan::settle(const Problem& problem, Report& report) {
  if (!best_ || !best_->sampled || full_look_s(best_->plan) > std::max(deadline_->remaining_s(), kGrace_s)) return;
  const Stopwatch watch(report.timing_s, "check");
  judge(*best_, problem, Look::full);
}

/// What a check in full will take, from what the last one at few instants took.
double BestPlan::full_look_s(const Plan& plan) const {
  return instant_s_ * plan.duration() / sample_s(plan, Look::full);
}

}  // namespace mcplan::ddp
