#include <Eigen/Geometry>

#include "limb_rows.hpp"
#include "mcplan/base/rotation.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// The limbs of hands that may touch nothing, which are carried along at their nominal place, keep kSwingRoom from the
/// solids that stand about the way and are higher than the CoM (not in the paper), at the instants of a phase: the CoM
/// gives way.
class IdleLimb final : public CostTerm {
 public:
  IdleLimb() : CostTerm("idle_limb", Scope::step, 41) {}

  bool applies(const StepView& step) const override {
    return step.between_knots() && !step.problem.standing_solids.empty() && !step.problem.idle_hands.empty();
  }

  void write(const StepView& step, Rows& rows) const override {
    const Problem& problem = step.problem;
    const double weight = step.schedule.interior_weight;
    for (const Instant& instant : step.instants) {
      const Eigen::Matrix3d level = rotation_from_rpy({0.0, 0.0, instant.rpy.z()});
      for (const Vector3d& nominal : problem.idle_hands)
        for (int i : problem.standing_solids) {
          if (!stands_beside(problem.polygons[i], instant.com)) continue;
          const LimbInside inside =
              limb_inside(problem.polygons[i], problem.thickness[i], instant.com, instant.com + level * nominal, true);
          if (!(inside.value < 0.0)) continue;
          if (rows.with_gradient())
            instant.add_along(inside.outward,
                              {0.0, 0.0, inside.share * inside.outward.dot(Vector3d::UnitZ().cross(level * nominal))},
                              rows.add_dense(weight, inside.value));
          else
            rows.add_value(weight, inside.value);
        }
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& idle_limb() {
  static const IdleLimb term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
