#include "force_rows.hpp"

namespace mcplan::ddp {
namespace {

/// Point feet in contact that a controller follows bear some weight: mu_l (p - s_l)_z >= load_min at the knot, in
/// weights of the robot. A foot without load is a centre of pressure on the edge of the support polygon, from which
/// nothing can be corrected. Not in the paper.
class Load final : public CostTerm {
 public:
  Load() : CostTerm("load", Scope::contact, 25) {}

  bool applies(const StepView& step) const override {
    return step.u && step.problem.load_min > 0.0 && step.problem.limits[step.l].balances;
  }

  void write(const StepView& step, Rows& rows) const override {
    const Layout& at = step.problem.layout;
    const double mu = step.pendulum.mu(*step.u, step.l);
    const double height = step.x[at.com() + 2] - at.line_point(step.x, *step.u, step.l).z();
    const double below = mu * height - step.problem.load_min;
    if (below >= 0.0) return;
    const double weight = step.schedule.tuning.limit_weight;
    if (!rows.with_gradient()) {
      rows.add_value(weight, below);
      return;
    }
    auto g = rows.add_dense(weight, below);
    g[at.nx() + at.stiffness(step.l)] = stiffness_slope(step) * height;
    g[at.com() + 2] += mu;
    at.add_along_line_point(step.l, -mu * Eigen::Vector3d::UnitZ(), g);
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
