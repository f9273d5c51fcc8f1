#include "ddp/search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

#include "ddp/constants.hpp"
#include "ddp/edits.hpp"
#include "ddp/lanes.hpp"
#include "ddp/stepping_sequence.hpp"
#include "ddp/tail_edits.hpp"

namespace mcplan::ddp {
namespace {

/// What came of a changed sequence.
struct Trial {
  Incumbent incumbent;
  Ending ending = Ending::done;
  bool improved = false;
};

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
      evaluate_(problem),
      stop_(problem.options.stop) {}

Search::~Search() = default;

Lanes& Search::lanes() {
  if (!lanes_) lanes_ = std::make_unique<Lanes>(*this, *deadline_);
  return *lanes_;
}

void Search::stand_in_for(const Search& main, Trace& trace, StopRequest stop) {
  trace.first = trace.report.iterations = main.report_->iterations;
  trace_ = &trace;
  report_ = &trace.report;
  polish_proximal_ = main.polish_proximal_;
  stop_ = std::move(stop);
}

bool Search::replay(Trace&& trace, int rows) {
  std::vector<Iteration>& history = trace.report.history;
  const bool all = rows < 0 || rows >= static_cast<int>(history.size());
  const int shift = report_->iterations - trace.first;
  const int end = all ? trace.report.iterations : history[rows - 1].index;
  if (shift + end >= problem_->options.max_iterations) return false;
  for (std::size_t i = 0; i < (all ? history.size() : rows); ++i) {
    report_->iterations = history[i].index += shift;
    tell(std::move(history[i]));
    show(trace.iterates[i].first, trace.iterates[i].second);
  }
  report_->iterations = end + shift;
  report_->parallel_loops += trace.report.parallel_loops;
  for (const auto& [part, time_s] : trace.report.timing_s) report_->timing_s[part] += time_s;
  return true;
}

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
  if (interrupted_ || (stop_ && stop_()))
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
  if (problem_->options.record_history) row.sequence = now.sequence;
  tell(std::move(row));
}

void log_row(const Logger& logger, const Iteration& row) {
  if (!logger) return;
  char line[160];
  if (row.index % 20 == 1)
    logger(LogLevel::info, "iter       cost      merit    defect  w_contact  proximal  step  switches");
  std::snprintf(line, sizeof line, "%4d %10.4g %10.4g  %8.1e  %9.3g  %8.3g  %4.2g  %8d", row.index, row.cost, row.merit,
                row.defect, row.contact_weight, row.proximal_weight, row.step, row.switches);
  logger(LogLevel::info, line);
}

void Search::tell(Iteration&& row) {
  report_->switches += row.switches;
  if (!trace_) log_row(problem_->options.logger, row);
  report_->history.push_back(std::move(row));
}

void Search::show(const Incumbent& now, const Tuning& tuning) {
  if (trace_) trace_->iterates.emplace_back(now, tuning);
  if (watcher_) watcher_(now, tuning);
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
  if (schedule.tuning.clear_swings) set_swing_arcs(*problem_, now.sequence, now.trajectory);
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
  const int calm = exact_contacts(tuning) ? kCalmAtFullWeight : kFreeAtFullWeight;
  for (int at_full = 0, quiet = 0; at_full < kFreeAtFullWeight && quiet < calm;) {
    if (should_stop(ending)) return ending;
    ending = iterate(now, schedule, true);
    if (ending != Ending::done) return ending;
    show(now, tuning);
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
    show(now, tuning);
    const double merit = now.evaluation.merit();
    converged_iterations = std::abs(last - merit) < tolerance * std::abs(merit) ? converged_iterations + 1 : 0;
    if (converged_iterations >= kConvergedIterations && now.evaluation.defect_max < kConvergedDefect)
      return Ending::done;
    if (i % kWindow == kWindow - 1) {
      const double foreseen = merit - kWindowsAhead * (window_start - merit);
      if (trace_ && i > kWindow) trace_->foreseen.emplace_back(static_cast<int>(report_->history.size()), foreseen);
      if (i > kWindow && foreseen > give_up_above) return Ending::done;
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
    if (!graph_) graph_ = std::make_unique<SequenceGraph>(*problem_, kWholeSequenceBudget);
    PricedSequence whole = best_whole_sequence(*graph_, model_, values_);
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

bool Search::known_no_lower(const ContactSequence& sequence, double merit) const {
  if (!known_) return false;
  const auto found = known_->find(sequence);
  return found != known_->end() && found->second >= merit * (1.0 - kTrialGain);
}

/// Polish one start after the other until the merit falls: `now` is then what came of that one.
Search::Tried Search::try_until_better(Incumbent& now, const std::vector<Incumbent>& starts, const Polisher& polish) {
  const int count = static_cast<int>(starts.size());
  std::vector<Trial> made(starts.size());
  const double merit = now.evaluation.merit();
  const Lanes::Run attempt = [&](int i, Search& search) {
    Trial& trial = made[i];
    trial.incumbent = starts[i];
    trial.ending = polish(search, trial.incumbent, merit);
    trial.improved = trial.incumbent.evaluation.merit() < merit * (1.0 - kTrialGain);
    return trial.improved || (trial.ending != Ending::done && trial.ending != Ending::broke_down);
  };
  lanes().run(count, attempt);
  Tried out;
  while (out.count < count && !out.improved && (out.ending == Ending::done || out.ending == Ending::broke_down)) {
    const int i = out.count++;
    if (!lanes().tell(i)) attempt(i, *this);
    Trial& trial = made[i];
    out.ending = trial.ending;
    out.improved = trial.improved;
    if (known_ && trial.ending == Ending::done)
      (*known_)[starts[i].sequence] = trial.improved ? trial.incumbent.evaluation.merit() : merit;
    if (!trial.improved) continue;
    const int switches = differences(starts[i].sequence, now.sequence);
    report_->switches += switches;
    report_->history.back().switches += switches;
    now = std::move(trial.incumbent);
  }
  if (out.ending == Ending::broke_down) out.ending = Ending::done;
  return out;
}

Ending Search::refine(Incumbent& now, const Tuning& tuning) {
  polish_proximal_ = kTrialProximal;
  const std::size_t trials = exact_contacts(tuning)          ? kExactTrials
                             : balances_on_points(*problem_) ? kCrawlTrials
                                                             : kTrials;
  // The interior point ends at the optimum of a sequence from wherever it begins: no sequence is tried twice.
  std::set<ContactSequence> tried{now.sequence};
  for (int round = 0; round < kRefineRounds; ++round) {
    std::vector<Incumbent> starts;
    std::set<ContactSequence> fresh;
    for (ContactSequence& change : ranked_changes(now, tuning)) {
      if (starts.size() == trials) break;
      if (known_no_lower(change, now.evaluation.merit())) continue;
      if (!exact_contacts(tuning) || (tried.count(change) == 0 && fresh.insert(change).second))
        starts.push_back({now.trajectory, std::move(change), now.evaluation});
    }
    const Tried outcome = try_until_better(now, starts, [&](Search& search, Incumbent& trial, double merit) {
      return search.polish_trial(trial, merit, tuning);
    });
    for (int i = 0; i < outcome.count && exact_contacts(tuning); ++i) tried.insert(starts[i].sequence);
    if (outcome.ending != Ending::done) return outcome.ending;
    if (!outcome.improved) break;
  }
  return Ending::done;
}

Ending Search::change_tail(Incumbent& now, const Tuning& tuning, bool& improved) {
  polish_proximal_ = kTrialProximal;
  std::vector<Incumbent> starts;
  for (ContactSequence& edited : tail_edits(problem_->rules, now.sequence)) {
    if (known_no_lower(edited, now.evaluation.merit())) continue;
    Trajectory guess = problem_->initial_guess(edited, tuning);
    starts.push_back({std::move(guess), std::move(edited), {}});
  }
  const Tried outcome = try_until_better(now, starts, [&](Search& search, Incumbent& trial, double merit) {
    return search.polish_guess(trial, Origin::sequence, merit, tuning);
  });
  improved = outcome.improved;
  return outcome.ending;
}

}  // namespace mcplan::ddp
