#include "ddp/cost_terms.hpp"
#include "ddp/input_limits.hpp"

namespace mcplan::ddp {
namespace {

/// 0 <= mu_l <= mu_max and |tau_l| <= tau_max (Tazaki, eqs. 17-18).
class Bounds final : public CostTerm {
 public:
  Bounds() : CostTerm("bounds", Scope::step, 40) {}

  bool applies(const StepView& step) const override { return step.u != nullptr; }

  void write(const StepView& step, Rows& rows) const override {
    const Problem& problem = step.problem;
    const Layout& at = problem.layout;
    const Eigen::VectorXd& u = *step.u;
    const double w = step.schedule.tuning.limit_weight;
    const auto hold = [&](int i, double low, double high) {
      if (u[i] < low) rows.add_single(w, u[i] - low, at.nx() + i);
      if (u[i] > high) rows.add_single(w, u[i] - high, at.nx() + i);
    };
    for (int l = 0; l < at.end_effector_count(); ++l) hold(at.stiffness(l), 0.0, max_stiffness_input(problem, l));
    for (int i = 0; i < at.moment_count(); ++i) {
      const double max_moment = at.moments()[i].max;
      hold(at.moment(i), -max_moment, max_moment);
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& bounds() {
  static const Bounds term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
