#include "reach_rows.hpp"

namespace mcplan::ddp {
namespace {

/// Reach between the knots, for an end-effector in contact (not in the paper, which looks at the knots alone).
class InteriorReach final : public CostTerm {
 public:
  InteriorReach() : CostTerm("interior_reach", Scope::contact, 30) {}

  bool applies(const StepView& step) const override { return step.between_knots(); }

  void write(const StepView& step, Rows& rows) const override {
    for (std::size_t i = 1; i + 1 < step.instants.size(); ++i)
      write_reach(step, step.l, step.instants[i].com, step.instants[i].rpy, &step.instants[i], rows);
  }
};

}  // namespace

namespace cost {
const CostTerm& interior_reach() {
  static const InteriorReach term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
