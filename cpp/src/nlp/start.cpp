#include "nlp/start.hpp"

#include <algorithm>
#include <cmath>

#include "mcplan/base/error.hpp"

namespace mcplan::nlp {
namespace {

using Eigen::VectorXd;

template <class Name>
void require_limits(double lower, double upper, const Name& name) {
  if (!(lower < kInfinity)) throw InvalidInput(name() + ": lower", "must be below infinity", text(lower));
  if (!(upper > -kInfinity)) throw InvalidInput(name() + ": upper", "must be above minus infinity", text(upper));
}

std::string crossed(const std::string& name) { return "the lower bound of " + name + " lies above its upper bound"; }

}  // namespace

VectorXd projected(const Problem& problem, VectorXd x) {
  for (int i = 0; i < problem.variable_count(); ++i)
    x[i] = std::max(problem.variable_lower()[i], std::min(problem.variable_upper()[i], x[i]));
  return x;
}

VectorXd start_of(const Problem& problem, const VectorXd& x0) {
  const int n = problem.variable_count();
  if (x0.size() != n) throw InvalidInput("x0", "must have " + text(n) + " values", text(static_cast<int>(x0.size())));
  for (int i = 0; i < n; ++i) {
    if (!std::isfinite(x0[i])) throw InvalidInput("x0, " + problem.variable_name(i), "must be finite", text(x0[i]));
    require_limits(problem.variable_lower()[i], problem.variable_upper()[i], [&] { return problem.variable_name(i); });
  }
  for (int i = 0; i < problem.row_count(); ++i)
    require_limits(problem.row_lower()[i], problem.row_upper()[i], [&] { return problem.row_name(i); });
  return projected(problem, x0);
}

std::string contradiction(const Problem& problem) {
  for (int i = 0; i < problem.variable_count(); ++i)
    if (problem.variable_lower()[i] > problem.variable_upper()[i]) return crossed(problem.variable_name(i));
  for (int i = 0; i < problem.row_count(); ++i)
    if (problem.row_lower()[i] > problem.row_upper()[i]) return crossed(problem.row_name(i));
  return "";
}

Verdict judge_fixed(const Problem& problem, const VectorXd& x, double constraint_tolerance) {
  const double worst = problem.worst_violation(x).value;
  if (!std::isfinite(worst) || !std::isfinite(problem.cost(x)))
    return {Outcome::numerical_failure, "not finite: " + problem.first_not_finite(x)};
  if (worst <= constraint_tolerance) return {Outcome::converged, "every variable is fixed, and the constraints hold"};
  return {Outcome::infeasible, "every variable is fixed, and a constraint does not hold"};
}

}  // namespace mcplan::nlp
