#include "ddp/search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

#include "ddp/constants.hpp"
#include "ddp/edits.hpp"
#include "ddp/stepping_sequence.hpp"
#include "ddp/whole_sequence.hpp"

namespace mcplan::ddp {
namespace {

int differences(const ContactSequence& a, const ContactSequence& b) {
  int count = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t l = 0; l < a[k].size(); ++l) count += a[k][l] != b[k][l];
  return count;
}

}  // namespace

Search::Search(const Problem& problem, const Deadline& deadline, Report& report)
    : problem_(&problem),
      deadline_(&deadline),
      report_(&report),
      model_(problem),
      values_(model_),
      pricing_(problem.options.threads),
      evaluate_(problem) {}

Schedule Search::full_schedule(const Tuning& tuning) const {
  Schedule schedule;
  schedule.tuning = tuning;
  schedule.contact_weight = problem_->options.weights.contact_max;
  schedule.interior_weight = tuning.limit_weight;
  return schedule;
}

Evaluation Search::evaluate(const Incumbent& at, const Tuning& tuning) {
  return evaluate_(at.trajectory, at.sequence, full_schedule(tuning));
}

bool Search::should_stop(Ending& ending) const {
  if (problem_->options.stop && problem_->options.stop())
    ending = Ending::interrupted;
  else if (deadline_->passed())
    ending = Ending::time_limit;
  else if (report_->iterations >= problem_->options.max_iterations)
    ending = Ending::iteration_limit;
  else
    return false;
  return true;
}

void Search::record(Iteration&& row, const Incumbent& now, const Schedule& schedule) {
  row.cost = now.evaluation.cost;
  row.merit = now.evaluation.merit();
  row.defect = now.evaluation.defect_max;
  row.contact_weight = schedule.contact_weight;
  row.proximal_weight = schedule.proximal_weight;
  report_->switches += row.switches;
  if (problem_->options.record_history) row.sequence = now.sequence;
  if (const Logger& logger = problem_->options.logger) {
    char line[160];
    if (row.index % 20 == 1)
      logger(LogLevel::info, "iter       cost      merit    defect  w_contact  proximal  step  switches");
    std::snprintf(line, sizeof line, "%4d %10.4g %10.4g  %8.1e  %9.3g  %8.3g  %4.2g  %8d", row.index, row.cost,
                  row.merit, row.defect, row.contact_weight, row.proximal_weight, row.step, row.switches);
    logger(LogLevel::info, line);
  }
  report_->history.push_back(std::move(row));
}

/// Shorten the Newton step until the true merit falls below `merit`; `best` is the best point tried.
bool Search::line_search(const Incumbent& now, const ContactSequence& sequence, const Schedule& schedule, double merit,
                         Candidate& best) {
  const Stopwatch watch(report_->timing_s, "line_search");
  values_.state_forward(dx_, du_);
  best.trajectory = now.trajectory;
  for (double step = 1.0; step > kStepEnd; step *= 0.5) {
    for (std::size_t k = 0; k < dx_.size(); ++k) best.trajectory.x[k] = now.trajectory.x[k] + step * dx_[k];
    for (std::size_t k = 0; k < du_.size(); ++k) best.trajectory.u[k] = now.trajectory.u[k] + step * du_[k];
    best.evaluation = evaluate_(best.trajectory, sequence, schedule);
    best.step = step;
    if (std::isfinite(best.evaluation.merit()) && best.evaluation.merit() < merit) return true;
  }
  return false;
}

/// Best-neighbour descent on the local model (Tazaki, Algorithm 2), from the cost of staying instead of from infinity.
int Search::switch_contacts(ContactSequence& sequence, Iteration& row) {
  double cost = values_.V(0).c - 0.5 * values_.V(0).g.dot(values_.V(0).h.llt().solve(values_.V(0).g));
  {
    const Stopwatch watch(report_->timing_s, "value_forward");
    if (!values_.forward(sequence, 0)) return 0;
  }
  int switches = 0;
  for (; switches < kSwitchesPerIteration && !deadline_->passed(); ++switches) {
    const Neighbour* best;
    {
      const Stopwatch watch(report_->timing_s, "pricing");
      const auto& all = pricing_.all(model_, values_, sequence);
      report_->parallel_loops += std::exchange(pricing_.parallel_loops, 0);
      row.neighbours += static_cast<int>(all.size());
      best = cheapest(all);
    }
    if (!best || !(best->cost < cost - kSwitchGain * std::abs(cost))) break;
    cost = best->cost;
    const int k = best->step;
    sequence[k] = best->state;
    // A switch at k leaves V after it and U up to it as they are.
    const Stopwatch watch(report_->timing_s, "value_update");
    if (!values_.backward(sequence, k) || !values_.forward(sequence, k)) break;
  }
  return switches;
}

Ending Search::iterate(Incumbent& now, Schedule& schedule, bool free_sequence) {
  Iteration row;
  row.index = ++report_->iterations;
  if (problem_->model == Model::wrench) problem_->set_sole_yaw(now.sequence, now.trajectory);
  now.evaluation = evaluate_(now.trajectory, now.sequence, schedule);
  const double before = now.evaluation.merit();
  if (!std::isfinite(before)) return Ending::broke_down;
  for (;;) {
    {
      const Stopwatch watch(report_->timing_s, "linearise");
      model_.expand(now.trajectory, schedule);
    }
    const Stopwatch watch(report_->timing_s, "value_backward");
    if (values_.backward(now.sequence, problem_->steps)) break;
    schedule.proximal_weight *= kProximalRetry;
    if (schedule.proximal_weight > kProximalMax) return Ending::broke_down;
  }
  const bool moved = line_search(now, now.sequence, schedule, before, stay_);
  ContactSequence sequence = now.sequence;
  bool switched = false;
  if (free_sequence && switch_contacts(sequence, row) > 0) {
    // While the contact weight still grows the landscape moves anyway: a switch need only make progress itself. At full
    // weight it must beat staying.
    const bool growing = schedule.contact_weight < problem_->options.weights.contact_max;
    const double stay_merit = moved ? stay_.evaluation.merit() : before;
    const double to_beat =
        growing ? evaluate_(now.trajectory, sequence, schedule).merit() : stay_merit * (1.0 - kSwitchGain);
    switched = line_search(now, sequence, schedule, to_beat, moved_);
  }
  if (switched) {
    row.switches = differences(sequence, now.sequence);
    now.sequence = sequence;
  }
  if (switched || moved) {
    Candidate& taken = switched ? moved_ : stay_;
    std::swap(now.trajectory, taken.trajectory);
    now.evaluation = taken.evaluation;
    row.step = taken.step;
  }
  if (!free_sequence) {
    if (row.step >= kFullStep)
      schedule.proximal_weight = std::max(kProximalFall * schedule.proximal_weight, kProximalMin);
    else if (row.step < kShortStep)
      schedule.proximal_weight = std::min(kProximalRise * schedule.proximal_weight, kProximalMax);
  }
  record(std::move(row), now, schedule);
  return Ending::done;
}

Ending Search::discover(Incumbent& now, double proximal_weight, const Tuning& tuning) {
  const Weights& w = problem_->options.weights;
  Schedule schedule;
  schedule.tuning = tuning;
  schedule.contact_weight = w.contact_min;
  schedule.proximal_weight = proximal_weight;
  schedule.discovering = true;
  Ending ending = Ending::done;
  const int calm = exact_contacts() ? kCalmAtFullWeight : kFreeAtFullWeight;
  for (int at_full = 0, quiet = 0; at_full < kFreeAtFullWeight && quiet < calm;) {
    if (should_stop(ending)) return ending;
    ending = iterate(now, schedule, true);
    if (ending != Ending::done) return ending;
    if (watcher_) watcher_(now, tuning);
    at_full += schedule.contact_weight >= w.contact_max;
    quiet = schedule.contact_weight >= w.contact_max && report_->history.back().switches == 0 ? quiet + 1 : 0;
    schedule.contact_weight = std::min(w.contact_growth * schedule.contact_weight, w.contact_max);
  }
  return Ending::done;
}

Ending Search::polish(Incumbent& now, int iterations, double tolerance, double give_up_above, const Tuning& tuning) {
  Schedule schedule = full_schedule(tuning);
  schedule.proximal_weight = polish_proximal_;
  double last = std::numeric_limits<double>::infinity();
  double window_start = last;
  int converged_iterations = 0;
  Ending ending = Ending::done;
  for (int i = 0; i < iterations; ++i) {
    if (should_stop(ending)) return ending;
    ending = iterate(now, schedule, false);
    if (ending != Ending::done) return ending;
    if (watcher_) watcher_(now, tuning);
    const double merit = now.evaluation.merit();
    converged_iterations = std::abs(last - merit) < tolerance * std::abs(merit) ? converged_iterations + 1 : 0;
    if (converged_iterations >= kConvergedIterations && now.evaluation.defect_max < kConvergedDefect)
      return Ending::done;
    if (i % kWindow == kWindow - 1) {
      if (i > kWindow && merit - kWindowsAhead * (window_start - merit) > give_up_above) return Ending::done;
      window_start = merit;
    }
    last = merit;
  }
  return Ending::done;
}

std::vector<ContactSequence> Search::ranked_changes(const Incumbent& now, const Tuning& tuning) {
  struct Change {
    double cost;
    ContactSequence sequence;
  };
  Schedule schedule = full_schedule(tuning);
  schedule.proximal_weight = kTrialProximal;
  std::vector<Change> changes;
  model_.expand(now.trajectory, schedule);
  if (!values_.backward(now.sequence, problem_->steps) || !values_.forward(now.sequence, 0)) return {};
  {
    const Stopwatch watch(report_->timing_s, "pricing");
    const std::vector<Neighbour>& neighbours = pricing_.all(model_, values_, now.sequence);
    report_->parallel_loops += std::exchange(pricing_.parallel_loops, 0);
    for (const Neighbour& n : neighbours) {
      changes.push_back({n.cost, now.sequence});
      changes.back().sequence[n.step] = n.state;
      changes.back().cost += change_cost(*problem_, changes.back().sequence);
    }
  }
  const Stopwatch watch(report_->timing_s, "whole_sequence");
  if (problem_->options.whole_sequence_moves && !deadline_->passed()) {
    PricedSequence whole = best_whole_sequence(model_, values_, kWholeSequenceBudget);
    if (!whole.sequence.empty() && whole.sequence != now.sequence) changes.push_back({whole.cost, whole.sequence});
  }
  for (ContactSequence& edited : swing_edits(problem_->rules, now.sequence)) {
    if (deadline_->passed()) break;  // the trials will not come to them
    const double cost = values_.minimum_with(edited, now.sequence);
    if (!std::isfinite(cost)) continue;
    const double changing = change_cost(*problem_, edited);
    changes.push_back({cost + changing, std::move(edited)});
  }
  std::stable_sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.cost < b.cost; });
  std::vector<ContactSequence> out;
  for (Change& change : changes) out.push_back(std::move(change.sequence));
  return out;
}

Ending Search::refine(Incumbent& now, const Tuning& tuning) {
  Ending ending = Ending::done;
  polish_proximal_ = kTrialProximal;
  const std::size_t trials = exact_contacts() ? kExactTrials : balances_on_points(*problem_) ? kCrawlTrials : kTrials;
  // The interior point ends at the optimum of a sequence from wherever it begins: no sequence is tried twice.
  std::set<ContactSequence> tried{now.sequence};
  for (int round = 0; round < kRefineRounds; ++round) {
    const std::vector<ContactSequence> changes = ranked_changes(now, tuning);
    bool improved = false;
    std::size_t made = 0;
    for (std::size_t i = 0; i < changes.size() && made < trials && !improved; ++i) {
      if (exact_contacts() && !tried.insert(changes[i]).second) continue;
      ++made;
      Incumbent trial = now;
      trial.sequence = changes[i];
      const double merit = now.evaluation.merit();
      ending = polish_trial(trial, merit, tuning);
      improved = trial.evaluation.merit() < merit * (1.0 - kTrialGain);
      if (improved) {
        const int switches = differences(trial.sequence, now.sequence);
        report_->switches += switches;
        report_->history.back().switches += switches;
        now = std::move(trial);
      }
      if (ending != Ending::done && ending != Ending::broke_down) return ending;
    }
    if (!improved) break;
  }
  return Ending::done;
}

}  // namespace mcplan::ddp
