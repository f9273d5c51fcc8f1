#include "ddp/constants.hpp"
#include "ddp/cost_terms.hpp"
#include "prism.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// A ball about the CoM stays out of the solids that stand about the way (not in the paper): distance of the CoM at
/// least kTrunkRadius, at the knots and between them.
class Trunk final : public CostTerm {
 public:
  Trunk() : CostTerm("trunk", Scope::step, 40) {}

  bool applies(const StepView& step) const override { return !step.problem.standing_solids.empty(); }

  void write(const StepView& step, Rows& rows) const override {
    const Layout& at = step.problem.layout;
    write_at(step, step.x.segment<3>(at.com()), rows,
             [&](const Vector3d& outward, Eigen::Ref<Eigen::VectorXd> g) { g.segment<3>(at.com()) = outward; });
    if (!step.u) return;
    for (std::size_t i = 1; i + 1 < step.instants.size(); ++i)
      write_at(step, step.instants[i].com, rows, [&](const Vector3d& outward, Eigen::Ref<Eigen::VectorXd> g) {
        step.instants[i].add_along(outward, Vector3d::Zero(), g);
      });
  }

 private:
  template <class AddGradient>
  static void write_at(const StepView& step, const Vector3d& com, Rows& rows, const AddGradient& add_gradient) {
    const double weight = step.schedule.tuning.limit_weight;
    for (int i : step.problem.standing_solids) {
      const Polygon& polygon = step.problem.polygons[i];
      const auto [distance, outward] = outside_prism(polygon, step.problem.thickness[i], com);
      if (distance >= kTrunkRadius) continue;
      if (rows.with_gradient())
        add_gradient(outward, rows.add_dense(weight, distance - kTrunkRadius));
      else
        rows.add_value(weight, distance - kTrunkRadius);
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& trunk() {
  static const Trunk term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
