#include <cmath>

#include "mcplan/ddp/costs/costs.hpp"

namespace mcplan::ddp {

void bounds_cost(const Problem& problem, const Eigen::VectorXd& u, Rows& rows) {
  const Layout& at = problem.layout;
  const double w = problem.options.weights.limit;
  rows.begin(Term::bounds);
  const auto hold = [&](int i, double low, double high) {
    if (u[i] < low) rows.add_single(w, u[i] - low, at.nx() + i);
    if (u[i] > high) rows.add_single(w, u[i] - high, at.nx() + i);
  };
  for (int l = 0; l < at.ends(); ++l) {
    // The stiffness at which the force cap is met in the nominal stance, at least one CoM height away.
    const EndLimits& limit = problem.limits[l];
    const double mu_max = limit.force_max / std::max(limit.nominal.norm(), 1.0);
    hold(at.stiffness(l), 0.0, problem.options.stiffness_input == StiffnessInput::lambda ? std::sqrt(mu_max) : mu_max);
  }
  for (int i = 0; i < at.moment_count(); ++i) {
    const double most = at.moments()[i].most;
    hold(at.moment(i), -most, most);
  }
}

}  // namespace mcplan::ddp
