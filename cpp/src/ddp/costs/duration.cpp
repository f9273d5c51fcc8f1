#include <algorithm>

#include "mcplan/ddp/costs/costs.hpp"

namespace mcplan::ddp {

void duration_cost(const Problem& problem, int k, const Eigen::VectorXd& u, Rows& rows) {
  const Weights& w = problem.options.weights;
  const int i = problem.layout.duration(), iz = problem.layout.nx() + i;
  // A phase that was under way when replanning has as long as was left of it.
  const bool under_way = k == 0 && problem.first_duration > 0.0;
  const double low = under_way ? std::min(problem.first_duration, problem.duration_min) : problem.duration_min;
  const double middle = under_way ? problem.first_duration : 0.5 * (problem.duration_min + problem.duration_max);
  rows.begin(Term::duration);
  rows.add_single(w.duration, u[i] - middle, iz);
  if (u[i] < low) rows.add_single(w.limit, u[i] - low, iz);
  if (u[i] > problem.duration_max) rows.add_single(w.limit, u[i] - problem.duration_max, iz);
}

void flight_duration_cost(const Problem& problem, const Eigen::VectorXd& u, Rows& rows) {
  const int i = problem.layout.duration();
  rows.begin(Term::duration);
  const double beyond = u[i] - problem.flight_duration_min;
  if (beyond < 0.0) rows.add_single(problem.options.weights.limit, beyond, problem.layout.nx() + i);
}

}  // namespace mcplan::ddp
