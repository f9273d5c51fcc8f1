#include <algorithm>

#include "ddp/cost_terms.hpp"

namespace mcplan::ddp {
namespace {

/// Durations: towards the middle of their box, and inside it (not in the paper, which leaves h unbounded; its author's
/// program has the box).
class Duration final : public CostTerm {
 public:
  Duration() : CostTerm("duration", Scope::step, 30) {}

  bool applies(const StepView& step) const override { return step.u != nullptr; }

  void write(const StepView& step, Rows& rows) const override {
    const Problem& problem = step.problem;
    const double limit = step.schedule.tuning.limit_weight;
    const int i = problem.layout.duration(), iz = problem.layout.nx() + i;
    const double h = (*step.u)[i];
    // A phase that was under way when replanning has as long as was left of it.
    const bool under_way = step.k == 0 && problem.first_duration > 0.0;
    const double low = under_way ? std::min(problem.first_duration, problem.duration_min) : problem.duration_min;
    const double middle = under_way ? problem.first_duration : 0.5 * (problem.duration_min + problem.duration_max);
    rows.add_single(problem.options.weights.duration, h - middle, iz);
    if (h < low) rows.add_single(limit, h - low, iz);
    if (h > problem.duration_max) rows.add_single(limit, h - problem.duration_max, iz);
  }
};

}  // namespace

namespace cost {
const CostTerm& duration() {
  static const Duration term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
