#include <cmath>

#include "ddp/constants.hpp"
#include "ddp/cost_terms.hpp"

namespace mcplan::ddp {
namespace {

/// Replanning: footholds stay where they were planned, the more firmly the sooner they are due (not in the paper):
///
///     w^2 s^2 (sqrt(1 + d^2 / s^2) - 1),   d = |p_l - p_l,kept|,   at the knot at which contact l begins.
///
/// Up to about s the price is w^2 d^2 / 2, beyond it grows like d alone: nothing moves without a reason, and who has
/// one may go far. As rows: e = g (p_l - p_l,kept), g^2 = 2 / (sqrt(1 + d^2 / s^2) + 1).
class Kept final : public CostTerm {
 public:
  Kept() : CostTerm("kept", Scope::step, 40) {}

  bool applies(const StepView& step) const override { return !step.problem.kept.empty(); }

  void write(const StepView& step, Rows& rows) const override {
    const Layout& at = step.problem.layout;
    for (const Problem::Foothold& foothold : step.problem.kept) {
      if (foothold.knot != step.k) continue;
      const int column = at.end(foothold.l);
      const Eigen::Vector3d off = step.x.segment<3>(column) - foothold.place;
      const double ratio = off.squaredNorm() / (kKeptBend * kKeptBend), root = std::sqrt(1.0 + ratio);
      const double g = std::sqrt(2.0 / (root + 1.0));
      if (!rows.with_gradient()) {
        for (int i = 0; i < 3; ++i) rows.add_value(foothold.weight, g * off[i]);
        continue;
      }
      // de/dp = g 1 + 2 / s^2 dg/dratio off off^T
      const double dg_dratio = -0.5 / (g * (root + 1.0) * (root + 1.0) * root);
      for (int i = 0; i < 3; ++i) {
        auto gradient = rows.add_dense(foothold.weight, g * off[i]);
        gradient.segment<3>(column) = 2.0 / (kKeptBend * kKeptBend) * dg_dratio * off[i] * off;
        gradient[column + i] += g;
      }
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& kept() {
  static const Kept term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
