#include "ipm/unknowns.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace mcplan::ipm {
namespace {

constexpr double kMaxScale = 20.0;
constexpr double kNoWidth = 1e-10;  // of the size of two limits, between which distances are rounding errors

bool equal(double low, double high) {
  const double width = high - low;
  return low == high || (std::isfinite(width) && width <= kNoWidth * std::max({1.0, std::abs(low), std::abs(high)}));
}

}  // namespace

Unknowns::Unknowns(const nlp::Problem& problem, bool scaled) {
  const int variables = problem.variable_count(), rows = problem.row_count();
  index_of.assign(variables, -1);
  equality_of.assign(rows, -1);
  slack_of.assign(rows, -1);
  for (int i = 0; i < variables; ++i) {
    if (equal(problem.variable_lower()[i], problem.variable_upper()[i])) continue;
    index_of[i] = free_count();
    free.push_back(i);
  }
  for (int i = 0; i < rows; ++i) {
    const double low = problem.row_lower()[i], high = problem.row_upper()[i];
    if (equal(low, high)) {
      equality_of[i] = equality_count();
      equalities.push_back(i);
    } else if (std::isfinite(low) || std::isfinite(high)) {
      slack_of[i] = slack_count();
      inequalities.push_back(i);
    }
  }
  right_side.resize(equality_count());
  for (int i = 0; i < equality_count(); ++i) {
    const double low = problem.row_lower()[equalities[i]], high = problem.row_upper()[equalities[i]];
    right_side[i] = low + 0.5 * (high - low);
  }
  lower.resize(free_count() + slack_count());
  upper.resize(lower.size());
  for (int i = 0; i < free_count(); ++i) {
    lower[i] = problem.variable_lower()[free[i]];
    upper[i] = problem.variable_upper()[free[i]];
  }
  scale = Eigen::VectorXd::Ones(slack_count());
  for (int i = 0; i < slack_count(); ++i) {
    const double low = problem.row_lower()[inequalities[i]], high = problem.row_upper()[inequalities[i]];
    if (scaled && std::isfinite(high - low)) scale[i] = std::min(2.0 / (high - low), kMaxScale);
    lower[free_count() + i] = scale[i] * low;
    upper[free_count() + i] = scale[i] * high;
  }
}

Unknowns::Unknowns(int count, int equality_count, Eigen::VectorXd lower_bounds, Eigen::VectorXd upper_bounds)
    : free(count),
      equalities(equality_count),
      inequalities(lower_bounds.size() - count),
      right_side(Eigen::VectorXd::Zero(equality_count)),
      scale(Eigen::VectorXd::Ones(lower_bounds.size() - count)),
      lower(std::move(lower_bounds)),
      upper(std::move(upper_bounds)) {
  std::iota(free.begin(), free.end(), 0);
  std::iota(equalities.begin(), equalities.end(), 0);
  std::iota(inequalities.begin(), inequalities.end(), equality_count);
  index_of = free;
}

}  // namespace mcplan::ipm
