#include <algorithm>

#include "ddp/cost_terms.hpp"
#include "ddp/input_limits.hpp"

namespace mcplan::ddp {
namespace {

/// Speed in sqrt(gravity com_height) at which a foot is lifted to its next foothold. Measured: TALOS that climbs 0.26 m
/// hits the edge with swings of 0.3 s, and falls.
constexpr double kLiftPace = 0.17;

/// Swings of robots that are tracked take their time for higher footholds (not in the paper): h >= dz / kLiftPace, up
/// to the longest phase.
class LiftPace final : public CostTerm {
 public:
  LiftPace() : CostTerm("lift_pace", Scope::free, 60) {}

  bool applies(const StepView& step) const override {
    const Problem& problem = step.problem;
    return step.between_knots() && problem.robot.tracked &&
           problem.robot.end_effectors[problem.active[step.l]].kind == "foot";
  }

  void write(const StepView& step, Rows& rows) const override {
    const Layout& at = step.problem.layout;
    const double rise = (*step.u)[at.stride(step.l) + 2], h = (*step.u)[at.duration()];
    const double longest = duration_limits(step.problem, step.k).max;
    const double wanted = std::min(rise / kLiftPace, longest);
    if (h >= wanted) return;
    if (!rows.with_gradient()) {
      rows.add_value(step.schedule.interior_weight, h - wanted);
      return;
    }
    auto g = rows.add_dense(step.schedule.interior_weight, h - wanted);
    g[at.nx() + at.duration()] = 1.0;
    if (wanted < longest) g[at.nx() + at.stride(step.l) + 2] = -1.0 / kLiftPace;
  }
};

}  // namespace

namespace cost {
const CostTerm& lift_pace() {
  static const LiftPace term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
