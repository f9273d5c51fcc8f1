#include "leg_rows.hpp"

namespace mcplan::ddp {
namespace {

/// Thigh and knee of a leg in contact keep out of the solids that stand about the way (not in the paper), at the
/// instants of a phase: distance of LegLines at least kLegRoom radii, or what there is at the start or the goal.
class StandingLegRoom final : public CostTerm {
 public:
  StandingLegRoom() : CostTerm("standing_leg", Scope::contact, 85) {}

  bool applies(const StepView& step) const override { return has_leg_rows(step); }

  void write(const StepView& step, Rows& rows) const override {
    const Problem& problem = step.problem;
    const EndLimits& limit = problem.limits[step.l];
    const Eigen::Matrix3d sole = problem.sole_frame(step.surface, step.sole_yaw);
    AnkleAt ankle;
    ankle.place = step.x.segment<3>(problem.layout.end(step.l)) + sole * limit.limb.ankle;
    ankle.heading = sole.col(0);
    for (const Instant& instant : step.instants) {
      if (limit.half_size.maxCoeff() <= 0.0) {  // without a sole it bends where the base heads
        const Eigen::Matrix3d level = rotation_from_rpy({0.0, 0.0, instant.rpy.z()});
        ankle.heading = level.col(0);
        ankle.heading_by_yaw = level.col(1);
      }
      write_leg_rows(step, instant, ankle, rows);
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& standing_leg() {
  static const StandingLegRoom term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
