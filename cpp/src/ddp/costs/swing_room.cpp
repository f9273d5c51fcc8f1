#include "ddp/constants.hpp"
#include "ddp/cost_terms.hpp"
#include "prism.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// The straight way of a free end-effector over a phase keeps its sole beside the solids that stand about the way and
/// are higher than it can be lifted (not in the paper, and no swing height would help): distance of the end-effector at
/// least its longest half sole and kSwingRoom.
class SwingRoom final : public CostTerm {
 public:
  SwingRoom() : CostTerm("swing_room", Scope::free, 40) {}

  bool applies(const StepView& step) const override {
    return step.u && step.schedule.interior_weight > 0.0 && !step.problem.standing_solids.empty();
  }

  void write(const StepView& step, Rows& rows) const override {
    const Problem& problem = step.problem;
    const Layout& at = problem.layout;
    const EndLimits& limit = problem.limits[step.l];
    const double lift = limit.reach_max.z() - limit.reach_min.z(), weight = step.schedule.interior_weight;
    const double room = limit.half_size.maxCoeff() + kSwingRoom;
    const Vector3d from = step.x.segment<3>(at.end(step.l)), way = step.u->segment<3>(at.stride(step.l));
    for (int i : problem.standing_solids) {
      const Polygon& polygon = problem.polygons[i];
      if (polygon.height(from) > -lift) continue;
      for (double share : {0.25, 0.5, 0.75}) {
        const auto [distance, outward] = outside_prism(polygon, problem.thickness[i], from + share * way);
        if (distance >= room) continue;
        if (!rows.with_gradient()) {
          rows.add_value(weight, distance - room);
          continue;
        }
        auto g = rows.add_dense(weight, distance - room);
        g.segment<3>(at.end(step.l)) = outward;
        g.segment<3>(at.nx() + at.stride(step.l)) = share * outward;
      }
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& swing_room() {
  static const SwingRoom term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
