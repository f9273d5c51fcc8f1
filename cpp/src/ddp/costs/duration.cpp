#include "ddp/cost_terms.hpp"
#include "ddp/input_limits.hpp"

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
    const DurationLimits of = duration_limits(problem, step.k);
    rows.add_single(duration_weight(problem, step.k), h - of.middle, iz);
    if (h < of.min) rows.add_single(limit, h - of.min, iz);
    if (h > of.max) rows.add_single(limit, h - of.max, iz);
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
