#include "ddp/constants.hpp"
#include "ddp/cost_terms.hpp"
#include "mcplan/base/rotation.hpp"
#include "plan/solid_box.hpp"
#include "prism.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// A ball about the CoM stays out of the solids that stand about the way (not in the paper): distance of the CoM at
/// least kTrunkRadius, at the knots and between them. So do the parts of the robot's own trunk: distance of a part's
/// line p + R(theta) (from + s (to - from)), 0 <= s <= 1, at least room_about(), or what there is at the start or the
/// goal.
class TrunkTerm final : public CostTerm {
 public:
  TrunkTerm() : CostTerm("trunk", Scope::step, 40) {}

  bool applies(const StepView& step) const override {
    return !step.problem.standing_solids.empty() || !step.problem.trunk_solids.empty();
  }

  void write(const StepView& step, Rows& rows) const override {
    const Layout& at = step.problem.layout;
    const Vector3d com = step.x.segment<3>(at.com());
    write_at(step, com, step.problem.rpy(step.x), rows,
             [&](const Vector3d& outward, const Vector3d& turn, Eigen::Ref<Eigen::VectorXd> g) {
               g.segment<3>(at.com()) = outward;
               for (int a = 0; a < at.axis_count(); ++a) g[at.angle(a)] = turn[at.axes()[a]];
             });
    if (!step.u) return;
    for (std::size_t i = 1; i + 1 < step.instants.size(); ++i) {
      const Instant& instant = step.instants[i];
      write_at(step, instant.com, instant.rpy, rows,
               [&](const Vector3d& outward, const Vector3d& turn, Eigen::Ref<Eigen::VectorXd> g) {
                 instant.add_along(outward, turn, g);
               });
    }
  }

 private:
  template <class AddGradient>
  static void write_at(const StepView& step, const Vector3d& com, const Vector3d& rpy, Rows& rows,
                       const AddGradient& add_gradient) {
    const double weight = step.schedule.tuning.limit_weight;
    const auto write = [&](const Outside& outside, double room, const Vector3d& turn) {
      if (outside.distance >= room) return;
      if (rows.with_gradient())
        add_gradient(outside.outward, turn, rows.add_dense(weight, outside.distance - room));
      else
        rows.add_value(weight, outside.distance - room);
    };
    const Problem& problem = step.problem;
    for (int i : problem.standing_solids)
      write(outside_prism(problem.polygons[i], problem.thickness[i], com), kTrunkRadius, Vector3d::Zero());
    if (problem.trunk_solids.empty()) return;
    const Eigen::Matrix3d r = rotation_from_rpy(rpy);
    for (std::size_t j = 0; j < problem.trunk.size(); ++j) {
      const TrunkPart& part = problem.trunk[j];
      const Vector3d from = com + r * part.from_B, along = r * (part.to_B - part.from_B);
      Eigen::AlignedBox3d around(from);
      around.extend(Vector3d(from + along));
      for (std::size_t i = 0; i < problem.trunk_solids.size(); ++i) {
        const int solid = problem.trunk_solids[i];
        const double room = problem.trunk_rooms[j][i];
        if (problem.solid_boxes[solid].squaredExteriorDistance(around) >= room * room) continue;
        const auto [s, outside] = nearest_on_line(problem.polygons[solid], problem.thickness[solid], from, along, room);
        if (outside.distance >= room) continue;
        const Vector3d place = part.from_B + s * (part.to_B - part.from_B);
        Vector3d turn = Vector3d::Zero();
        for (int axis : problem.layout.axes()) turn[axis] = outside.outward.dot(rotation_derivative(rpy, axis) * place);
        write(outside, room, turn);
      }
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& trunk() {
  static const TrunkTerm term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
