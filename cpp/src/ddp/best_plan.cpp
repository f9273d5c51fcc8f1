#include "ddp/best_plan.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "ddp/constants.hpp"
#include "ddp/plan_conversion.hpp"
#include "ddp/reachable_surfaces.hpp"

namespace mcplan::ddp {

double BestPlan::sample_s(const Plan& plan, Look look) {
  if (look == Look::full) return std::max(Tolerances().sample_s, plan.duration() / kFullInstantsMax);
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
  put_back(out.plan, *scene_, surfaces);
  out.evaluation = search.evaluate(now, tuning);
  out.tuning = tuning;
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
  finished.violations = result.violations();
  finished.warnings = result.warnings;
  return result.ok();
}

namespace {

/// Whether the checker rather has `one` than `other`.
bool better(const BestPlan::Finished& one, const BestPlan::Finished& other) {
  if (one.ok != other.ok) return one.ok;
  if (one.ok) return one.evaluation.merit() < other.evaluation.merit();
  return violation_ratio(one.worst) < violation_ratio(other.worst);
}

void take(std::optional<BestPlan::Finished>& best, BestPlan::Finished&& now) {
  if (!best || better(now, *best)) best = std::move(now);
}

}  // namespace

int flights(const Plan& plan) {
  return static_cast<int>(std::count_if(plan.phases.begin(), plan.phases.end(), [](const Phase& phase) {
    return std::all_of(phase.contacts.begin(), phase.contacts.end(), [](const Contact& c) { return c.surface < 0; });
  }));
}

bool better(const std::optional<BestPlan::Finished>& one, const std::optional<BestPlan::Finished>& other) {
  return one && (!other || better(*one, *other));
}

const std::optional<BestPlan::Finished>& BestPlan::best() const {
  const bool finished = finished_ && (finished_->ok || !looked_ || !better(*looked_, *finished_));
  return finished ? finished_ : looked_;
}

std::vector<Violation> BestPlan::finish(Search& search, const std::vector<int>& surfaces, Incumbent now,
                                        const Tuning& tuning) {
  // If the contacts cannot be met exactly, the plan is kept as it is, and the checker says what is wrong with it.
  const StopRequest late = when_passed();
  search.make_exact(now, tuning, late);
  if (best() && late && late()) return {};
  const Stopwatch watch(search.report().timing_s, "check");
  Finished finished = converted(search, surfaces, now, tuning, !(late && late()));
  finished.sampled = true;
  judge(finished, search.problem(), Look::full, late);
  if (finished.sampled && best()) return {};
  if (finished.sampled) judge(finished, search.problem(), Look::late);
  std::vector<Violation> violations = finished.violations;
  take(finished_, std::move(finished));
  return violations;
}

void BestPlan::keep(Search& search, const std::vector<int>& surfaces, const Incumbent& now, const Tuning& tuning) {
  const int iterations = search.report().iterations;
  if (!kept_.empty() && iterations < next_) return;
  kept_.push_back({now, tuning});
  next_ = iterations + kLookPause * ++looks_;
  if (deadline_->limited() && !look(search, surfaces, kept_.back())) cut_short_ = true;
}

/// False when the clock cut it short, so that without a limit something else might have come of it.
bool BestPlan::look(Search& search, const std::vector<int>& surfaces, const Kept& kept) {
  const double begin_s = deadline_->elapsed_s();
  const bool first = !best();
  if (!first && deadline_->remaining_s() < cost_s_) return false;
  const auto& [now, tuning] = kept;
  if (looked_ && looked_->ok && !(search.evaluate(now, tuning).merit() < kCheaper * looked_->evaluation.merit()))
    return true;
  Incumbent iterate = now;
  const double until_s = begin_s + std::max(deadline_->remaining_s(), 0.0) + (first ? kGrace_s : 0.0);
  int rounds = 0;
  bool given_up = false;
  search.make_exact(iterate, tuning, [&] {
    const double now_s = deadline_->elapsed_s();
    const bool hopeless = first && ++rounds == 2 && begin_s + kExactRoundsMin * (now_s - begin_s) > until_s;
    return given_up = hopeless || now_s >= until_s;
  });
  const bool late = deadline_->passed();
  if (!first && late) return false;
  const Stopwatch watch(search.report().timing_s, "check");
  Finished finished = converted(search, surfaces, iterate, tuning, !late);
  const double converted_s = deadline_->elapsed_s();
  const Look instants = deadline_->remaining_s() <= 0.0 ? Look::late : Look::few;
  if (!first && instants == Look::late) return false;
  finished.sampled = true;
  const bool accepted = judge(finished, search.problem(), instants, first ? nullptr : when_passed());
  if (finished.sample_s == 0.0) return false;
  instant_s_ = (deadline_->elapsed_s() - converted_s) * finished.sample_s / finished.plan.duration();
  if (accepted && full_look_s(finished.plan) <= deadline_->remaining_s())
    judge(finished, search.problem(), Look::full, when_passed());
  const bool whole = !given_up && instants == Look::few && !(accepted && finished.sampled);
  take(looked_, std::move(finished));
  cost_s_ = deadline_->elapsed_s() - begin_s;
  return whole;
}

void BestPlan::look_back(Search& search, const std::vector<int>& surfaces) {
  if (!solved() && (!deadline_->limited() || cut_short_)) {
    std::optional<Finished> at_once = std::exchange(looked_, earlier_);
    bool whole = true;
    for (std::size_t i = 0; i < kept_.size() && whole; ++i) whole = look(search, surfaces, kept_[i]);
    if (!whole && at_once) take(looked_, std::move(*at_once));
  }
  kept_.clear();
  cut_short_ = false;
  earlier_ = looked_;
}

void BestPlan::settle(const Problem& problem, Report& report) {
  if (!best()) return;
  Finished& plan = &best() == &finished_ ? *finished_ : *looked_;
  if (!plan.sampled || full_look_s(plan.plan) > std::max(deadline_->remaining_s(), kGrace_s)) return;
  const Stopwatch watch(report.timing_s, "check");
  const double until_s = deadline_->elapsed_s() + std::max(deadline_->remaining_s(), kGrace_s);
  judge(plan, problem, Look::full, [&] { return deadline_->elapsed_s() >= until_s; });
}

/// What a check in full will take, from what the last one at few instants took.
double BestPlan::full_look_s(const Plan& plan) const {
  return instant_s_ * plan.duration() / sample_s(plan, Look::full);
}

}  // namespace mcplan::ddp
