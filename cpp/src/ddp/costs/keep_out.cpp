#include "ddp/cost_terms.hpp"

namespace mcplan::ddp {
namespace {

/// A free end-effector stays out of the solids below the surfaces (at the knots; not in the paper): height above the
/// plane at least 0 where it is inside a polygon's outline and not far below it.
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
      if (height >= 0.0 || height < -problem.keep_out_depth[i] || polygon.outside(p) > 0.0) continue;
      if (rows.with_gradient())
        rows.add_dense(weight, height).segment<3>(problem.layout.end(step.l)) = polygon.normal_W();
      else
        rows.add_value(weight, height);
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
