#include "nlp/start.hpp"

#include <algorithm>
#include <cmath>

#include "mcplan/base/error.hpp"

namespace mcplan::nlp {
namespace {

using Eigen::VectorXd;

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
  for (int i = 0; i < n; ++i)
    if (!std::isfinite(x0[i])) throw InvalidInput("x0, " + problem.variable_name(i), "must be finite", text(x0[i]));
  return projected(problem, x0);
}

std::string contradiction(const Problem& problem) {
  for (int i = 0; i < problem.variable_count(); ++i)
    if (problem.variable_lower()[i] > problem.variable_upper()[i]) return crossed(problem.variable_name(i));
  for (int i = 0; i < problem.row_count(); ++i)
    if (problem.row_lower()[i] > problem.row_upper()[i]) return crossed(problem.row_name(i));
  return "";
}

}  // namespace mcplan::nlp
