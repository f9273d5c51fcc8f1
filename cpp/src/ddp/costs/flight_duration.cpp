#include "ddp/cost_terms.hpp"
#include "ddp/input_limits.hpp"

namespace mcplan::ddp {
namespace {

/// Duration of a phase without any contact: long enough to draw the legs up and land (the paper's lower bound of all
/// phases). Depends on the state as a whole, not on one end-effector. Of a flight that is under way when replanning
/// only the rest is left, which may be as short as it is.
class FlightDuration final : public CostTerm {
 public:
  FlightDuration() : CostTerm("flight_duration", Scope::flight, 10) {}

  void write(const StepView& step, Rows& rows) const override {
    const Layout& at = step.problem.layout;
    const double beyond = (*step.u)[at.duration()] - min_flight_duration(step.problem, step.k);
    if (beyond < 0.0) rows.add_single(step.schedule.tuning.limit_weight, beyond, at.nx() + at.duration());
  }
};

}  // namespace

namespace cost {
const CostTerm& flight_duration() {
  static const FlightDuration term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
