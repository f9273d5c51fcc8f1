#include <algorithm>

#include "limb_rows.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// The straight limb from the CoM to a free hand keeps kSwingRoom from the solids that stand about the way (not in the
/// paper), at the instants of a phase. Of those that the hand may touch only what is higher than the CoM counts, and
/// the hand itself does not.
class Limb final : public CostTerm {
 public:
  Limb() : CostTerm("limb", Scope::free, 50) {}

  bool applies(const StepView& step) const override {
    return step.between_knots() && !step.problem.standing_solids.empty() &&
           step.problem.robot.end_effectors[step.problem.active[step.l]].kind != "foot";
  }

  void write(const StepView& step, Rows& rows) const override {
    const Problem& problem = step.problem;
    const Layout& at = problem.layout;
    const std::vector<int>& touched = problem.rules.surfaces(step.l);
    const double weight = step.schedule.interior_weight;
    for (int i : problem.standing_solids) {
      const bool touchable = std::find(touched.begin(), touched.end(), i) != touched.end();
      for (const Instant& instant : step.instants) {
        if (touchable && !(problem.polygons[i].height(instant.com) < 0.0)) continue;
        const Vector3d hand =
            step.x.segment<3>(at.end(step.l)) + instant.fraction * step.u->segment<3>(at.stride(step.l));
        const LimbInside inside = limb_inside(problem.polygons[i], problem.thickness[i], instant.com, hand, !touchable);
        if (!(inside.value < 0.0)) continue;
        if (!rows.with_gradient()) {
          rows.add_value(weight, inside.value);
          continue;
        }
        auto g = rows.add_dense(weight, inside.value);
        instant.add_along((1.0 - inside.share) * inside.outward, Vector3d::Zero(), g);
        g.segment<3>(at.end(step.l)) += inside.share * inside.outward;
        g.segment<3>(at.nx() + at.stride(step.l)) += inside.share * instant.fraction * inside.outward;
      }
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& limb() {
  static const Limb term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
