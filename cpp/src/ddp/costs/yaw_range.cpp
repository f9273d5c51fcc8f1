#include "ddp/cost_terms.hpp"

namespace mcplan::ddp {
namespace {

/// Heading of the sole against the base within the end-effector's yaw_range at every instant: yaw_min <= yaw_l - yaw <=
/// yaw_max. Not in the paper.
class YawRange final : public CostTerm {
 public:
  YawRange() : CostTerm("yaw_range", Scope::contact, 40) {}

  bool applies(const StepView& step) const override { return step.between_knots(); }

  void write(const StepView& step, Rows& rows) const override {
    const EndLimits& limit = step.problem.limits[step.l];
    const double weight = step.schedule.interior_weight;
    for (const Instant& instant : step.instants) {
      const double yaw = step.sole_yaw - instant.rpy.z();
      const double beyond = yaw < limit.yaw_min ? yaw - limit.yaw_min : yaw > limit.yaw_max ? yaw - limit.yaw_max : 0;
      if (beyond == 0.0) continue;
      if (!rows.with_gradient())
        rows.add_value(weight, beyond);
      else
        instant.add_along(Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ(), rows.add_dense(weight, beyond));
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& yaw_range() {
  static const YawRange term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
