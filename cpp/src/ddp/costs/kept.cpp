#include "ddp/cost_terms.hpp"

namespace mcplan::ddp {
namespace {

/// Replanning: footholds stay where they were planned, the more firmly the sooner they are due (not in the paper):
///
///     1/2 w^2 |p_l - p_l,kept|^2   at the knot at which contact l begins.
class Kept final : public CostTerm {
 public:
  Kept() : CostTerm("kept", Scope::step, 40) {}

  bool applies(const StepView& step) const override { return !step.problem.kept.empty(); }

  void write(const StepView& step, Rows& rows) const override {
    const Layout& at = step.problem.layout;
    for (const Problem::Foothold& foothold : step.problem.kept) {
      if (foothold.knot != step.k) continue;
      for (int i = 0; i < 3; ++i) {
        const int column = at.end(foothold.l) + i;
        rows.add_single(foothold.weight, step.x[column] - foothold.place[i], column);
      }
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& kept() {
  static const Kept term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
