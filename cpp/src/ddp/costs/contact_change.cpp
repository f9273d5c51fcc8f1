#include "ddp/cost_terms.hpp"

namespace mcplan::ddp {
namespace {

/// Cost of the contacts made and broken between two steps, so that the robot takes no step that gains it next to
/// nothing (not in the paper).
class ContactChange final : public CostTerm {
 public:
  ContactChange() : CostTerm("contact_change", Scope::change, 10, {0.1, "On every contact made or broken."}) {}

  double of_change(const Problem& problem, const ContactState& from, const ContactState& to) const override {
    const double w = problem.options.method == Method::paper ? 0.0 : weight(problem.options.weights);
    double cost = 0.0;
    for (std::size_t l = 0; l < from.size(); ++l)
      if (from[l] != to[l]) cost += 0.5 * w * w;
    return cost;
  }
};

}  // namespace

namespace cost {
const CostTerm& contact_change() {
  static const ContactChange term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
