#include "reach_rows.hpp"

namespace mcplan::ddp {
namespace {

/// p_min <= R(theta)' (p_l - p) <= p_max at the knot, for every end-effector (Tazaki, eqs. 16, 18).
class Reach final : public CostTerm {
 public:
  Reach() : CostTerm("reach", Scope::step, 20) {}

  void write(const StepView& step, Rows& rows) const override {
    const Layout& at = step.problem.layout;
    const Eigen::Vector3d com = step.x.segment<3>(at.com()), rpy = step.problem.rpy(step.x);
    for (int l = 0; l < at.end_effector_count(); ++l) write_reach(step, l, com, rpy, nullptr, rows);
  }
};

}  // namespace

namespace cost {
const CostTerm& reach() {
  static const Reach term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
