#include "ddp/cost_terms.hpp"

namespace mcplan::ddp {
namespace {

/// Forces of point feet that a controller follows stay near the vertical: the level part of d = p - s_l, which is their
/// tangent where the CoM is one height up. Feet that stand far out would otherwise press against each other with forces
/// that point at the CoM and that friction and hips have to hold. Not in the paper, which has no other forces. At the
/// knot in discovery, at the middle of the phase from the polish on.
class Upright final : public CostTerm {
 public:
  Upright()
      : CostTerm("upright", Scope::contact, 12, {1.0, "On the tilt of contact forces of tracked robots' point feet."}) {
  }

  bool applies(const StepView& step) const override { return step.u && step.problem.limits[step.l].balances; }

  void write(const StepView& step, Rows& rows) const override {
    const Layout& at = step.problem.layout;
    const double own = weight(step.problem.options.weights);
    const Instant* middle = step.between_knots() ? &step.instants[step.instants.size() / 2] : nullptr;
    const Eigen::Vector3d com = middle ? middle->com : Eigen::Vector3d(step.x.segment<3>(at.com()));
    const Eigen::Vector3d d = com - at.line_point(step.x, *step.u, step.l);
    for (int i = 0; i < 2; ++i) {
      if (!rows.with_gradient()) {
        rows.add_value(own, d[i]);
        continue;
      }
      const Eigen::Vector3d along = Eigen::Vector3d::Unit(i);
      auto g = rows.add_dense(own, d[i]);
      if (middle)
        middle->add_along(along, Eigen::Vector3d::Zero(), g);
      else
        g.segment<3>(at.com()) += along;
      at.add_along_line_point(step.l, -along, g);
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& upright() {
  static const Upright term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
