#include <cmath>

#include "force_rows.hpp"

namespace mcplan::ddp {
namespace {

/// Friction cone: the force points along d = p - s_l, so |d_t| <= mu_friction n.d at every instant, or t_i.d <=
/// mu_friction cos(pi/n) n.d for each side of a pyramid of n sides inside the cone. Stiffness drops out: one row
/// however large the force. Not in the paper.
class Friction final : public CostTerm {
 public:
  Friction() : CostTerm("friction", Scope::contact, 50) {}

  bool applies(const StepView& step) const override {
    return step.between_knots() && step.problem.options.friction && !std::isinf(step.problem.friction[step.surface]);
  }

  void write(const StepView& step, Rows& rows) const override {
    const Problem& problem = step.problem;
    const double friction = problem.friction[step.surface];
    const Eigen::Vector3d& n = problem.polygons[step.surface].normal_W();
    const Eigen::Vector3d s = problem.layout.line_point(step.x, *step.u, step.l);
    for (const Instant& instant : step.instants) {
      const Eigen::Vector3d d = instant.com - s;
      const double normal = n.dot(d);
      const Eigen::Vector3d tangential = d - normal * n;
      const double length = tangential.norm();
      if (problem.options.friction_sides > 0) {
        const double inside = friction * problem.pyramid_ratio;
        for (const Eigen::Vector3d& t : problem.pyramid[step.surface])
          if (const double beyond = t.dot(d) - inside * normal; beyond > 0.0)
            add_along_direction(step, instant, beyond, t - inside * n, rows);
        continue;
      }
      const double beyond = length - friction * normal;
      if (beyond <= 0.0) continue;
      const Eigen::Vector3d along =
          (length > 1e-12 ? Eigen::Vector3d(tangential / length) : Eigen::Vector3d::Zero()) - friction * n;
      add_along_direction(step, instant, beyond, along, rows);
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& friction() {
  static const Friction term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
