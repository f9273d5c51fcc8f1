#include "mcplan/ddp/costs/costs.hpp"

namespace mcplan::ddp {

void duration_cost(const Problem& problem, const Eigen::VectorXd& u, Rows& rows) {
  const Weights& w = problem.options.weights;
  const int i = problem.layout.duration(), iz = problem.layout.nx() + i;
  rows.begin(Term::duration);
  rows.add_single(w.duration, u[i] - 0.5 * (problem.duration_min + problem.duration_max), iz);
  if (u[i] < problem.duration_min) rows.add_single(w.limit, u[i] - problem.duration_min, iz);
  if (u[i] > problem.duration_max) rows.add_single(w.limit, u[i] - problem.duration_max, iz);
}

}  // namespace mcplan::ddp
