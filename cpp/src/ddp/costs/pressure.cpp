#include "ddp/cost_terms.hpp"

namespace mcplan::ddp {
namespace {

/// Centre of pressure c_l inside the sole's rectangle and, as a_l = p_l + c_l, inside the polygon. Without the latter
/// the robot would stand on nothing with the half of a foot that sticks out over an edge. Not in the paper.
class Pressure final : public CostTerm {
 public:
  Pressure() : CostTerm("pressure", Scope::contact, 20) {}

  bool applies(const StepView& step) const override { return step.u && step.problem.layout.pressure_count(step.l) > 0; }

  void write(const StepView& step, Rows& rows) const override {
    const Problem& problem = step.problem;
    const Layout& at = problem.layout;
    const int l = step.l, count = at.pressure_count(l), first = at.nx() + at.pressure(l);
    const double limit = step.schedule.tuning.limit_weight;
    const Eigen::Matrix3Xd& basis = at.offsets(l).pressure;
    const Eigen::Vector3d offset = at.pressure_offset(*step.u, l);
    const Polygon& polygon = problem.polygons[step.surface];
    const auto add = [&](double weight, double value, const Eigen::Vector3d& along, bool with_end) {
      if (!rows.with_gradient()) {
        rows.add_value(weight, value);
        return;
      }
      auto g = rows.add_dense(weight, value);
      g.segment(first, count) = basis.transpose() * along;
      if (with_end) g.segment<3>(at.end(l)) = along;
    };
    const Eigen::Matrix3d sole = problem.sole_frame(step.surface, step.sole_yaw);
    for (int i = 0; i < 2; ++i) {
      const double along = sole.col(i).dot(offset), half = problem.limits[l].pressure_half[i];
      if (std::abs(along) > half) add(limit, along > 0 ? along - half : along + half, sole.col(i), false);
    }
    // Within the plane where the inputs alone do not see to it.
    if (count == 3) add(limit, polygon.normal_W().dot(offset), polygon.normal_W(), false);
    const double edge_weight = step.schedule.contact_weight * problem.options.weights.overshoot_factor;
    const Eigen::Vector3d acting = step.x.segment<3>(at.end(l)) + offset;
    for (int i = 0; i < polygon.edge_count(); ++i) {
      const double beyond = polygon.overshoot(i, acting) + problem.pressure_margin;
      if (beyond > 0.0) add(edge_weight, beyond, polygon.edge_outward_W(i), true);
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& pressure() {
  static const Pressure term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
