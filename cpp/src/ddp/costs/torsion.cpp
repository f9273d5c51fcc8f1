#include <cmath>

#include "ddp/moment_limits.hpp"
#include "force_rows.hpp"

namespace mcplan::ddp {
namespace {

/// |tau_l| <= torsion_arm mu_l n.(p - s_l) at every instant: a foot that hardly presses cannot twist. Not in the paper.
class Torsion final : public CostTerm {
 public:
  Torsion() : CostTerm("torsion", Scope::contact, 70) {}

  bool applies(const StepView& step) const override { return step.between_knots(); }

  void write(const StepView& step, Rows& rows) const override {
    const Layout& at = step.problem.layout;
    const Eigen::VectorXd& u = *step.u;
    const int l = step.l;
    const double arm = torsion_arm(step.problem, l, step.surface), mu = step.pendulum.mu(u, l);
    const Eigen::Vector3d& n = step.problem.polygons[step.surface].normal_W();
    const Eigen::Vector3d s = at.line_point(step.x, u, l);
    for (int i = 0; i < at.moment_count(); ++i) {
      const Layout::Moment& m = at.moments()[i];
      if (m.end_effector != l) continue;
      const double moment = u[at.moment(i)];
      // Moments that are not about this surface's normal are what the centre of pressure does.
      if (!about_normal(step.problem, m, step.surface)) {
        rows.add_single(step.schedule.tuning.limit_weight, moment, at.nx() + at.moment(i));
        continue;
      }
      if (std::isinf(arm)) continue;
      const double sign = moment > 0.0 ? 1.0 : -1.0;
      for (const Instant& instant : step.instants) {
        const double normal = n.dot(instant.com - s), beyond = std::abs(moment) - arm * mu * normal;
        if (beyond <= 0.0) continue;
        add_along_direction(step, instant, beyond, -arm * mu * n, rows);
        if (!rows.with_gradient()) continue;
        auto g = rows.last_gradient();
        g[at.nx() + at.moment(i)] += sign;
        g[at.nx() + at.stiffness(l)] -= arm * normal * stiffness_slope(step);
      }
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& torsion() {
  static const Torsion term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
