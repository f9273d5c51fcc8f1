#include "force_rows.hpp"

namespace mcplan::ddp {
namespace {

/// Point feet in contact that a controller follows bear some weight, mu_l >= load_min: a foot without load is a centre
/// of pressure on the edge of the support polygon, from which nothing can be corrected. Stiffness times the height of
/// the CoM is the force in weights, so the least stiffness is the least ratio of the weight. Not in the paper.
class Load final : public CostTerm {
 public:
  Load() : CostTerm("load", Scope::contact, 25) {}

  bool applies(const StepView& step) const override {
    return step.u && step.problem.load_min > 0.0 && step.problem.limits[step.l].balances;
  }

  void write(const StepView& step, Rows& rows) const override {
    const double below = step.pendulum.mu(*step.u, step.l) - step.problem.load_min;
    if (below >= 0.0) return;
    const double weight = step.schedule.tuning.limit_weight;
    if (!rows.with_gradient()) {
      rows.add_value(weight, below);
      return;
    }
    const Layout& at = step.problem.layout;
    rows.add_dense(weight, below)[at.nx() + at.stiffness(step.l)] = stiffness_slope(step);
  }
};

}  // namespace

namespace cost {
const CostTerm& load() {
  static const Load term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
