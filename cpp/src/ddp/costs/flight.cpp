#include "ddp/cost_terms.hpp"

namespace mcplan::ddp {
namespace {

/// Cost of a phase without any contact, so that the robot jumps where it must and not because it may (not in the paper,
/// where walking with flight phases is a common local optimum).
class Flight final : public CostTerm {
 public:
  Flight() : CostTerm("flight", Scope::state, 10, {1.0, "On every phase without any contact."}) {}

  double of_state(const Problem& problem, const ContactState& state) const override {
    if (problem.options.method == Method::paper || !in_flight(state)) return 0.0;
    const double w = weight(problem.options.weights);
    return 0.5 * w * w;
  }
};

}  // namespace

namespace cost {
const CostTerm& flight() {
  static const Flight term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
