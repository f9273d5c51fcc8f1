#pragma once

#include "ddp/cost_terms.hpp"

namespace mcplan::ddp {

/// d mu_l / d(its input).
inline double stiffness_slope(const StepView& step) {
  const bool lambda = step.problem.options.stiffness_input == StiffnessInput::lambda;
  return lambda ? 2.0 * (*step.u)[step.problem.layout.stiffness(step.l)] : 1.0;
}

/// A row that depends on d = p(t) - s_l alone, of the weight between the knots.
inline void add_along_direction(const StepView& step, const Instant& instant, double value,
                                const Eigen::Vector3d& along, Rows& rows) {
  const double weight = step.schedule.interior_weight;
  if (!rows.with_gradient()) {
    rows.add_value(weight, value);
    return;
  }
  auto g = rows.add_dense(weight, value);
  instant.add_along(along, Eigen::Vector3d::Zero(), g);
  step.problem.layout.add_along_line_point(step.l, -along, g);
}

}  // namespace mcplan::ddp
