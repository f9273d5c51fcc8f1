#include "mcplan/ddp/search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "mcplan/ddp/edits.hpp"
#include "mcplan/ddp/whole_sequence.hpp"

static const int TI = getenv("TI") ? atoi(getenv("TI")) : 15; static const double EX = getenv("EX") ? atof(getenv("EX")) : 6, PX = getenv("PX") ? atof(getenv("PX")) : 3;
namespace mcplan::ddp {

using Eigen::VectorXd;

namespace {

constexpr double kProximalMin = 0.1, kProximalMax = 1e6;
/// A switch must lower the model's cost and the true merit by this fraction, so that two sequences of equal cost do not
/// alternate.
constexpr double kSwitchGain = 1e-4;
constexpr int kSwitchesPerIteration = 6;
constexpr std::size_t kWholeSequenceBudget = 6000;

}  // namespace

Search::Search(const Problem& problem, const Deadline& deadline, Report& report)
    : problem_(&problem),
      deadline_(&deadline),
      report_(&report),
      model_(problem),
      values_(model_),
      pricing_(problem.options.threads),
      evaluate_(problem) {}

bool Search::should_stop(Status& status) const {
  if (problem_->options.stop && problem_->options.stop()) status = Status::interrupted;
  else if (deadline_->passed()) status = Status::time_limit;
  else if (report_->iterations >= problem_->options.max_iterations) status = Status::iteration_limit;
  else return false;
  return true;
}

void Search::log(const Iteration& row) const {
  const Logger& logger = problem_->options.logger;
  if (!logger) return;
  char line[160];
  if (row.index % 20 == 1) logger(LogLevel::info, "iter       cost      merit    defect  w_contact  proximal  step  switches");
  std::snprintf(line, sizeof line, "%4d %10.4g %10.4g  %8.1e  %9.3g  %8.3g  %4.2g  %8d", row.index, row.cost, row.merit,
                row.defect, row.contact_weight, row.proximal_weight, row.step, row.switches);
  logger(LogLevel::info, line);
}

/// Shorten the Newton step until the true merit falls below `merit`; `best` is the best point tried.
bool Search::line_search(const Incumbent& now, const ContactSequence& sequence, const Schedule& schedule, double merit,
                         Candidate& best) {
  const Stopwatch watch(report_->timing_s, "line_search");
  values_.state_forward(dx_, du_);
  Trajectory trial = now.trajectory;
  bool found = false;
  static const double first = getenv("FIRST") ? atof(getenv("FIRST")) : 1.0;
  for (double step = first; step > 1.0 / 64.0; step *= 0.5) {
    for (std::size_t k = 0; k < trial.x.size(); ++k) trial.x[k] = now.trajectory.x[k] + step * dx_[k];
    for (std::size_t k = 0; k < trial.u.size(); ++k) trial.u[k] = now.trajectory.u[k] + step * du_[k];
    const Evaluation evaluation = evaluate_(trial, sequence, schedule);
    if (!std::isfinite(evaluation.merit()) || evaluation.merit() >= merit) {
      if (found) break;
      continue;
    }
    merit = evaluation.merit();
    best.trajectory = trial;
    best.evaluation = evaluation;
    best.step = step;
    found = true;
  }
  return found;
}

/// Best-neighbour descent on the local model (Tazaki, Algorithm 2), from the cost of staying instead of from infinity.
int Search::switch_contacts(ContactSequence& sequence, Iteration& row) {
  int switches = 0;
  double cost = values_.minimum(0);
  {
    const Stopwatch watch(report_->timing_s, "value_forward");
    if (!values_.forward(sequence, 0)) return 0;
  }
  if (whole_moves_left_ > 0) {
    const Stopwatch watch(report_->timing_s, "whole_sequence");
    --whole_moves_left_;
    PricedSequence best = best_whole_sequence(model_, values_, kWholeSequenceBudget);
    if (best.sequence.empty()) {
      whole_moves_left_ = 0;
    } else if (best.cost < cost - kSwitchGain * std::abs(cost)) {
      for (std::size_t k = 0; k < sequence.size(); ++k)
        for (std::size_t l = 0; l < sequence[k].size(); ++l) switches += sequence[k][l] != best.sequence[k][l];
      sequence = best.sequence;
      cost = best.cost;
      if (!values_.backward(sequence, problem_->steps) || !values_.forward(sequence, 0)) return switches;
    }
  }
  for (int i = 0; i < kSwitchesPerIteration; ++i) {
    const Neighbour* best;
    {
      const Stopwatch watch(report_->timing_s, "pricing");
      const auto& all = pricing_.all(model_, values_, sequence);
      row.neighbours += static_cast<int>(all.size());
      best = cheapest(all);
    }
    if (!best || !(best->cost < cost - kSwitchGain * std::abs(cost))) break;
    cost = best->cost;
    sequence[best->step] = best->state;
    ++switches;
    const int k = best->step;
    const Stopwatch watch(report_->timing_s, "value_update");
    if (!values_.backward(sequence, k) || !values_.forward(sequence, k)) break;
  }
  return switches;
}

Status Search::iterate(Incumbent& now, Schedule& schedule, bool free_sequence) {
  Iteration row;
  row.index = ++report_->iterations;
  row.contact_weight = schedule.contact_weight;
  row.proximal_weight = schedule.proximal_weight;
  now.evaluation = evaluate_(now.trajectory, now.sequence, schedule);
  const double before = now.evaluation.merit();
  {
    const Stopwatch watch(report_->timing_s, "linearise");
    model_.expand(now.trajectory, schedule);
  }
  for (;;) {
    const Stopwatch watch(report_->timing_s, "value_backward");
    if (values_.backward(now.sequence, problem_->steps)) break;
    schedule.proximal_weight *= 10.0;
    if (schedule.proximal_weight > kProximalMax) return Status::numerical_failure;
    model_.expand(now.trajectory, schedule);
  }
  const bool moved = line_search(now, now.sequence, schedule, before, stay_);
  ContactSequence sequence = now.sequence;
  bool switched = false;
  if (free_sequence && switch_contacts(sequence, row) > 0) {
    const double stay_merit = moved ? stay_.evaluation.merit() : before;
    static const int mode = getenv("MODE") ? atoi(getenv("MODE")) : 1;
    const bool growing = schedule.contact_weight < problem_->options.weights.contact_max;
    if ((mode == 1 && growing) || mode == 2) {
      const double at_zero = evaluate_(now.trajectory, sequence, schedule).merit();
      switched = line_search(now, sequence, schedule, at_zero, moved_);
    } else
    switched = line_search(now, sequence, schedule, stay_merit - kSwitchGain * std::abs(stay_merit), moved_);
  }
  if (switched) {
    for (std::size_t k = 0; k < sequence.size(); ++k)
      for (std::size_t l = 0; l < sequence[k].size(); ++l) row.switches += sequence[k][l] != now.sequence[k][l];
    now.sequence = sequence;
    std::swap(now.trajectory, moved_.trajectory);
    now.evaluation = moved_.evaluation;
    row.step = moved_.step;
  } else if (moved) {
    std::swap(now.trajectory, stay_.trajectory);
    now.evaluation = stay_.evaluation;
    row.step = stay_.step;
  }
  report_->switches += row.switches;
  static const int adapt = getenv("ADAPT") ? atoi(getenv("ADAPT")) : 0;
  if (!adapt && free_sequence) {}
  else if (row.step >= 0.99) schedule.proximal_weight = std::max(0.7 * schedule.proximal_weight, kProximalMin);
  else if (row.step < 0.2) schedule.proximal_weight = std::min(4.0 * schedule.proximal_weight, kProximalMax);
  row.cost = now.evaluation.cost;
  row.merit = now.evaluation.merit();
  row.defect = now.evaluation.defect_max;
  if (problem_->options.record_history) row.sequence = now.sequence;
  log(row);
  report_->history.push_back(std::move(row));
  return Status::solved;
}

Status Search::run(Incumbent& now, const Attempt& attempt, bool keep_sequence) {
  const Weights& w = problem_->options.weights;
  Schedule schedule;
  schedule.contact_weight = w.contact_min;
  schedule.interior_weight = 0.0;
  schedule.proximal_weight = attempt.proximal_weight;
  whole_moves_left_ = problem_->options.whole_sequence_moves ? 12 : 0;

  Status status = Status::solved;
  const int free_iterations = keep_sequence ? 0 : attempt.free_iterations;
  for (int i = 0; i < free_iterations; ++i) {
    if (should_stop(status)) return status;
    status = iterate(now, schedule, true);
    if (status != Status::solved) return status;
    static const int id = getenv("ID") ? atoi(getenv("ID")) : 0;
    if (id) schedule.interior_weight = w.limit * schedule.contact_weight / w.contact_max;
    schedule.contact_weight = std::min(w.contact_growth * schedule.contact_weight, w.contact_max);
  }
  schedule.contact_weight = w.contact_max;
  schedule.interior_weight = w.limit;
  schedule.proximal_weight = std::min(schedule.proximal_weight, 10.0);
  status = polish(now, schedule, attempt.polish_iterations, std::numeric_limits<double>::infinity());
  if (status != Status::solved && status != Status::iteration_limit) return status;
  static const int ref = getenv("REF") ? atoi(getenv("REF")) : 1;
  if (!keep_sequence && ref) {
    status = refine(now, schedule);
  }
  return status;
}

Status Search::polish(Incumbent& now, Schedule& schedule, int iterations, double give_up_above) {
  Status status = Status::solved;
  double last = std::numeric_limits<double>::infinity();
  int calm = 0;
  for (int i = 0; i < iterations; ++i) {
    if (should_stop(status)) return status;
    status = iterate(now, schedule, false);
    if (status != Status::solved) return status;
    const double merit = now.evaluation.merit();
    calm = last - merit < 1e-3 * std::abs(merit) ? calm + 1 : 0;
    if (calm >= 3 && now.evaluation.defect_max < 1e-4) return Status::solved;
    // Extrapolate the decrease: hopeless trials end early.
    if (i >= 4 && merit - EX * (last - merit) > give_up_above) return Status::iteration_limit;
    last = merit;
  }
  return now.evaluation.defect_max < 1e-2 ? Status::solved : Status::iteration_limit;
}

Status Search::refine(Incumbent& now, Schedule& schedule) {
  Status status = Status::solved;
  static const int maxtrial = getenv("TRIALS") ? atoi(getenv("TRIALS")) : 8;
  for (int round = 0; round < 40; ++round) {
    now.evaluation = evaluate_(now.trajectory, now.sequence, schedule);
    model_.expand(now.trajectory, schedule);
    if (!values_.backward(now.sequence, problem_->steps) || !values_.forward(now.sequence, 0)) return Status::numerical_failure;
    struct Cand { double cost; ContactSequence seq; int kind; };
    std::vector<Cand> all;
    for (const Neighbour& n : pricing_.all(model_, values_, now.sequence)) {
      ContactSequence q = now.sequence; q[n.step] = n.state; all.push_back({n.cost, q, 0});
    }
    static const int ed = getenv("ED") ? atoi(getenv("ED")) : 1;
    if (ed) for (ContactSequence& q : swing_edits(problem_->rules, now.sequence)) {
      if (values_.backward(q, problem_->steps)) all.push_back({values_.minimum(0), q, 1});
    }
    std::stable_sort(all.begin(), all.end(), [](const Cand& a, const Cand& b) { return a.cost < b.cost; });
    bool improved = false;
    for (int i = 0; i < std::min<int>(maxtrial, all.size()); ++i) {
      Incumbent trial = now;
      trial.sequence = all[i].seq;
      Schedule s = schedule;
      s.proximal_weight = PX;
      status = polish(trial, s, TI, now.evaluation.merit());
      if (status == Status::time_limit || status == Status::interrupted) return status;
      if (trial.evaluation.merit() < now.evaluation.merit() * (1 - 1e-3)) {
        now = trial;
        improved = true;
        if (problem_->options.logger) problem_->options.logger(LogLevel::info, "refined: " + std::to_string(now.evaluation.merit()) + " candidate " + std::to_string(i) + " of " + std::to_string(all.size()) + " kind " + std::to_string(all[i].kind));
        break;
      }
    }
    if (!improved) break;
  }
  return Status::solved;
}

}  // namespace mcplan::ddp
