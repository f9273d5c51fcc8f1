#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "ddp/constants.hpp"
#include "ddp/over_steps.hpp"
#include "ddp/search.hpp"
#include "mcplan/base/error.hpp"
#include "model/text.hpp"

namespace mcplan::ddp {
namespace {

/// Iterations over which the published algorithm's cost has to stand still, and by which ratio of it. Chosen: the
/// paper shows convergence by the curve of its cost.
constexpr std::size_t kStill = 10;
constexpr double kStillRatio = 0.01;

/// How the published algorithm ended, by its own objective.
std::string verdict_of(const std::vector<Iteration>& history, double contact_max) {
  if (history.size() < kStill)
    return "not converged: stopped after " + text(static_cast<int>(history.size())) + " iterations";
  double min = std::numeric_limits<double>::infinity(), max = 0.0;
  int switches = 0;
  for (auto row = history.end() - kStill; row != history.end(); ++row) {
    min = std::min(min, row->cost);
    max = std::max(max, row->cost);
    switches += row->switches;
  }
  const bool full = (history.end() - kStill)->contact_weight >= contact_max;
  const double change = (max - min) / std::max(std::abs(history.back().cost), 1e-12);
  const bool converged = full && change <= kStillRatio;
  return std::string(converged ? "converged" : "not converged") + ": in the last " + text(static_cast<int>(kStill)) +
         " iterations its cost changed by " + model::digits(100.0 * change, "%.2g") + " %, with " + text(switches) +
         " switches";
}

}  // namespace

/// Algorithm 2, lines 1-16: V and U anew for every switch, each neighbour by one Riccati step and eq. (31), J* from
/// infinity. The first pass therefore always switches, whether or not that pays: the paper's persistent chattering.
bool Search::paper_switches(Incumbent& now, Iteration& row) {
  // What a thread prices with.
  struct Worker {
    explicit Worker(LocalModel& model) : values(model) {}
    ValueFunctions values;
    Quadratic value;
    Eigen::LLT<Eigen::MatrixXd> factor;
  };
  const int n = problem_->steps;
  std::vector<Worker> workers;  // made in their place: a factorisation that was not computed is not to be copied
  workers.reserve(problem_->options.threads);
  for (int i = 0; i < problem_->options.threads; ++i) workers.emplace_back(model_);
  std::vector<std::vector<Neighbour>> neighbours(n);
  const auto price = [&](int k, int thread) {
    Worker& w = workers[thread];
    for (Neighbour& each : neighbours[k]) {
      if (!w.values.backward_step(k, each.state, values_.V(k + 1), w.value)) continue;
      w.factor.compute(w.value.h + values_.U(k).h);
      const Eigen::VectorXd g = w.value.g + values_.U(k).g;
      each.cost = w.value.c + values_.U(k).c - 0.5 * g.dot(w.factor.solve(g));
    }
  };
  double best_cost = std::numeric_limits<double>::infinity();
  for (;;) {
    if (row.switches > 0 && deadline_->passed()) return true;
    {
      const Stopwatch watch(report_->timing_s, "value_backward");
      if (!values_.backward(now.sequence, problem_->steps)) return false;
    }
    {
      const Stopwatch watch(report_->timing_s, "value_forward");
      if (!values_.forward(now.sequence, 0)) return false;
    }
    const Stopwatch watch(report_->timing_s, "pricing");
    for (int k = 1; k < n; ++k) {
      neighbours[k].clear();
      for (const ContactState& state : problem_->rules.neighbours(now.sequence, k)) {
        neighbours[k].push_back({k, state, std::numeric_limits<double>::infinity()});
        model_.make_blocks(k, state);
        ++row.neighbours;
      }
    }
    report_->parallel_loops += over_steps(n, problem_->options.threads, true, price);
    const Neighbour* best = nullptr;
    for (const std::vector<Neighbour>& step : neighbours)
      for (const Neighbour& each : step)
        if (each.cost < (best ? best->cost : best_cost)) best = &each;
    if (!best) return true;
    best_cost = best->cost;
    now.sequence[best->step] = best->state;
    ++row.switches;
  }
}

Ending Search::run_paper(Incumbent& now, int iterations, const Tuning& tuning) {
  const Weights& w = problem_->options.weights;
  Schedule schedule;
  schedule.tuning = tuning;
  schedule.contact_weight = w.contact_min;
  const double given = problem_->options.proximal_weight;
  schedule.proximal_weight = given == Options().proximal_weight ? kPaperProximal : given;
  Ending ending = Ending::done;
  for (int i = 0; i < iterations; ++i) {
    if (should_stop(ending)) return ending;
    Iteration row;
    row.index = ++report_->iterations;
    {
      const Stopwatch watch(report_->timing_s, "linearise");
      model_.expand(now.trajectory, schedule);
    }
    if (!paper_switches(now, row) || !values_.backward(now.sequence, problem_->steps)) return Ending::broke_down;
    // The author's program searches along the step for the lowest objective; so does this, on cost plus defects.
    const double before = evaluate_(now.trajectory, now.sequence, schedule).merit();
    if (line_search(now, now.sequence, schedule, before, stay_)) {
      std::swap(now.trajectory, stay_.trajectory);
      row.step = stay_.step;
    }
    now.evaluation = evaluate_(now.trajectory, now.sequence, schedule);
    if (!std::isfinite(now.evaluation.merit())) return Ending::broke_down;
    record(std::move(row), now, schedule);
    report_->paper_cost = now.evaluation.cost;
    report_->paper_verdict = verdict_of(report_->history, w.contact_max);
    show(now, tuning);
    schedule.contact_weight = std::min(w.contact_growth * schedule.contact_weight, w.contact_max);
  }
  return Ending::done;
}

}  // namespace mcplan::ddp
