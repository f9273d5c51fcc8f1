#include <algorithm>
#include <cmath>
#include <limits>

#include "ddp/constants.hpp"
#include "ddp/search.hpp"

namespace mcplan::ddp {

/// Algorithm 2, lines 1-16: V and U anew for every switch, each neighbour by one Riccati step and eq. (31), J* from
/// infinity. The first pass therefore always switches, whether or not that pays: the paper's persistent chattering.
bool Search::paper_switches(Incumbent& now, Iteration& row) {
  double best_cost = std::numeric_limits<double>::infinity();
  Quadratic value;
  Eigen::LLT<Eigen::MatrixXd> factor;
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
    Neighbour best;
    best.cost = std::numeric_limits<double>::infinity();
    for (int k = 1; k < problem_->steps; ++k)
      for (const ContactState& state : problem_->rules.neighbours(now.sequence, k)) {
        ++row.neighbours;
        if (!values_.backward_step(k, state, values_.V(k + 1), value)) continue;
        factor.compute(value.h + values_.U(k).h);
        const Eigen::VectorXd g = value.g + values_.U(k).g;
        const double cost = value.c + values_.U(k).c - 0.5 * g.dot(factor.solve(g));
        if (cost < best.cost) best = {k, state, cost};
      }
    if (!(best.cost < best_cost)) return true;
    best_cost = best.cost;
    now.sequence[best.step] = best.state;
    ++row.switches;
  }
}

Ending Search::run_paper(Incumbent& now, int iterations, const Tuning& tuning) {
  const Weights& w = problem_->options.weights;
  Schedule schedule;
  schedule.tuning = tuning;
  schedule.contact_weight = w.contact_min;
  schedule.proximal_weight = kPaperProximal;
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
    if (watcher_) watcher_(now, tuning);
    schedule.contact_weight = std::min(w.contact_growth * schedule.contact_weight, w.contact_max);
  }
  return Ending::done;
}

}  // namespace mcplan::ddp
