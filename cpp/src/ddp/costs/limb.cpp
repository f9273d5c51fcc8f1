#include <algorithm>

#include "limb_rows.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// The straight limb from the CoM to a free hand keeps kSwingRoom from the solids that stand about the way and are
/// higher than the CoM (not in the paper), at the instants of a phase. A hand on top of what it may touch is where it
/// may be.
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
        if (!stands_beside(problem.polygons[i], instant.com)) continue;
        const Vector3d hand =
            step.x.segment<3>(at.end(step.l)) + instant.fraction * step.u->segment<3>(at.stride(step.l));
        const bool to_the_end = !touchable || problem.polygons[i].height(hand) < -kSwingRoom;
        const LimbInside inside = limb_inside(problem.polygons[i], problem.thickness[i], instant.com, hand, to_the_end);
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
