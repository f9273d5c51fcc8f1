#include "ddp/cost_terms.hpp"

namespace mcplan::ddp {
namespace {

/// No contact (Tazaki, eq. 19, third term): no stiffness, no moment.
class Free final : public CostTerm {
 public:
  Free() : CostTerm("free", Scope::free, 10) {}

  bool applies(const StepView& step) const override { return step.u != nullptr; }

  void write(const StepView& step, Rows& rows) const override {
    const Layout& at = step.problem.layout;
    const auto none = [&](int i) { rows.add_single(step.schedule.contact_weight, (*step.u)[i], at.nx() + i); };
    none(at.stiffness(step.l));
    for (int i = 0; i < at.moment_count(); ++i)
      if (at.moments()[i].end_effector == step.l) none(at.moment(i));
  }
};

}  // namespace

namespace cost {
const CostTerm& free() {
  static const Free term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
