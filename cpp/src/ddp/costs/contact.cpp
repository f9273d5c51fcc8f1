#include "ddp/cost_terms.hpp"

namespace mcplan::ddp {
namespace {

/// Contact with a surface (Tazaki, eq. 19, first and second term): on its plane, inside its polygon, not moving.
/// Deviation: eq. (19) uses the infinite plane; a finite polygon adds a row per edge that is overstepped.
class InContact final : public CostTerm {
 public:
  InContact() : CostTerm("contact", Scope::contact, 10) {}

  void write(const StepView& step, Rows& rows) const override {
    const Problem& problem = step.problem;
    const Layout& at = problem.layout;
    const int l = step.l;
    const double weight = step.schedule.contact_weight;
    const Polygon& polygon = problem.polygons[step.surface];
    const Eigen::Vector3d p = step.x.segment<3>(at.end(l));
    const auto along = [&](double w, double value, const Eigen::Vector3d& direction) {
      if (rows.with_gradient())
        rows.add_dense(w, value).segment<3>(at.end(l)) = direction;
      else
        rows.add_value(w, value);
    };
    along(weight, polygon.height(p), polygon.normal_W());
    // Without the extra weight a foot stretches over the edge instead of the hands taking hold (measured: 0 of 108 runs
    // of gap_with_rail find the hands at factor 1, 16 of 16 at 2).
    const bool paper = problem.options.method == Method::paper;
    const double edge_weight = weight * (paper ? 1.0 : problem.options.weights.overshoot_factor);
    const double extra_margin = step.schedule.tuning.extra_margin;
    for (int i = 0; i < polygon.edge_count(); ++i) {
      const double outside = polygon.overshoot(i, p);
      double margin = paper ? 0.0 : problem.foothold_margin(l, step.surface, i, extra_margin);
      if (!(outside + margin > 0.0)) continue;
      Eigen::Vector3d by_place = Eigen::Vector3d::Zero();
      if (!paper) margin = problem.margin_of_given(l, step.surface, i, p, margin, &by_place);
      if (outside + margin > 0.0) along(edge_weight, outside + margin, polygon.edge_outward_W(i) + by_place);
    }
    if (!step.u) return;
    for (int i = at.stride(l); i < at.stride(l) + 3; ++i) rows.add_single(weight, (*step.u)[i], at.nx() + i);
  }
};

}  // namespace

namespace cost {
const CostTerm& contact() {
  static const InContact term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
