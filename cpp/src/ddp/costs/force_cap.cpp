#include "force_rows.hpp"

namespace mcplan::ddp {
namespace {

/// mu_l |p - s_l| <= f_max at every instant. The paper bounds the stiffness instead.
class ForceCap final : public CostTerm {
 public:
  ForceCap() : CostTerm("force_cap", Scope::contact, 60) {}

  bool applies(const StepView& step) const override { return step.between_knots(); }

  void write(const StepView& step, Rows& rows) const override {
    const Layout& at = step.problem.layout;
    const double mu = step.pendulum.mu(*step.u, step.l), cap = step.problem.limits[step.l].force_max;
    const Eigen::Vector3d s = at.line_point(step.x, *step.u, step.l);
    for (const Instant& instant : step.instants) {
      const Eigen::Vector3d d = instant.com - s;
      const double distance = d.norm();
      const double beyond = mu * distance - cap;
      if (beyond <= 0.0) continue;
      add_along_direction(step, instant, beyond, mu / distance * d, rows);
      if (rows.with_gradient())
        rows.last_gradient()[at.nx() + at.stiffness(step.l)] += distance * stiffness_slope(step);
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& force_cap() {
  static const ForceCap term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
