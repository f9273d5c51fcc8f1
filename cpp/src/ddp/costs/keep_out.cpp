#include "ddp/constants.hpp"
#include "ddp/cost_terms.hpp"

namespace mcplan::ddp {
namespace {

/// A free end-effector stays out of the solids below the surfaces (at the knots; not in the paper): height above the
/// plane at least 0 where it is inside a polygon's outline and not far below it; far below, its distance outside the
/// nearest edge.
class KeepOut final : public CostTerm {
 public:
  KeepOut() : CostTerm("keep_out", Scope::free, 20) {}

  bool applies(const StepView& step) const override { return step.schedule.interior_weight > 0.0; }

  void write(const StepView& step, Rows& rows) const override {
    const Problem& problem = step.problem;
    const double weight = step.schedule.interior_weight;
    const Eigen::Vector3d p = step.x.segment<3>(problem.layout.end(step.l));
    for (std::size_t i = 0; i < problem.polygons.size(); ++i) {
      const Polygon& polygon = problem.polygons[i];
      const double height = polygon.height(p);
      if (height >= 0.0 || height < -problem.keep_out_depth[i] || polygon.outside(p) > -kBeside) continue;
      // Out of what is higher than it can be lifted it goes by the nearest side.
      const EndLimits& limit = problem.limits[step.l];
      const bool up = -height <= limit.reach_max.z() - limit.reach_min.z();
      int side = 0;
      for (int e = 1; !up && e < polygon.edge_count(); ++e)
        if (polygon.overshoot(e, p) > polygon.overshoot(side, p)) side = e;
      const double value = up ? height : polygon.overshoot(side, p);
      if (rows.with_gradient())
        rows.add_dense(weight, value).segment<3>(problem.layout.end(step.l)) =
            up ? polygon.normal_W() : polygon.edge_outward_W(side);
      else
        rows.add_value(weight, value);
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& keep_out() {
  static const KeepOut term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
