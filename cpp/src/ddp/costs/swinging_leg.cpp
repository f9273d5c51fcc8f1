#include "leg_rows.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// The same of a leg that swings, whose sole is level, heads as the base does and is lifted by the swing height half
/// way.
class SwingingLegRoom final : public CostTerm {
 public:
  SwingingLegRoom() : CostTerm("swinging_leg", Scope::free, 55) {}

  bool applies(const StepView& step) const override { return has_leg_rows(step); }

  void write(const StepView& step, Rows& rows) const override {
    const Problem& problem = step.problem;
    const Layout& at = problem.layout;
    for (const Instant& instant : step.instants) {
      const double f = instant.fraction;
      const Eigen::Matrix3d level = rotation_from_rpy({0.0, 0.0, instant.rpy.z()});
      const Vector3d to_ankle = level * problem.limits[step.l].limb.ankle;
      AnkleAt ankle;
      ankle.place = step.x.segment<3>(at.end(step.l)) + f * step.u->segment<3>(at.stride(step.l)) + to_ankle +
                    4.0 * f * (1.0 - f) * problem.swing_height * Vector3d::UnitZ();
      ankle.heading = level.col(0);
      ankle.place_by_yaw = Vector3d::UnitZ().cross(to_ankle);
      ankle.heading_by_yaw = level.col(1);
      ankle.stride = f;
      write_leg_rows(step, instant, ankle, rows);
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& swinging_leg() {
  static const SwingingLegRoom term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
