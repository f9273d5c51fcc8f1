#include "mcplan/rhp/options.hpp"

#include <cmath>
#include <string>

#include "mcplan/base/error.hpp"

namespace mcplan::rhp {
namespace {

void require(bool good, const std::string& field, const std::string& rule, const std::string& value) {
  if (!good) throw InvalidOptions(field, rule, value);
}

void require_positive(const std::string& field, double value) {
  require(std::isfinite(value) && value > 0.0, field, "must be a positive number", text(value));
}

void require_range(const std::string& field, const Range& range) {
  require(std::isfinite(range.max) && range.min > 0.0 && range.max > range.min, field,
          "must be two positive numbers, the second larger", text(range.min) + ", " + text(range.max));
}

}  // namespace

void Options::validate() const {
  require(lookahead >= 1 && lookahead <= 10, "lookahead", "must lie in [1, 10]", text(lookahead));
  require(cycles >= 1 && cycles <= 10000, "cycles", "must lie in [1, 10000]", text(cycles));
  require(intervals >= 2 && intervals <= 100, "intervals", "must lie in [2, 100]", text(intervals));
  require_range("double_support_s", double_support_s);
  require_range("single_support_s", single_support_s);
  require_range("com_height", com_height);
  require_positive("predicted_double_support_s", predicted_double_support_s);
  require_positive("predicted_single_support_s", predicted_single_support_s);
  require_positive("com_velocity_max", com_velocity_max);
  require_positive("momentum_max", momentum_max);
  require_positive("momentum_rate_max", momentum_rate_max);
  require(std::isfinite(foothold_margin_m) && foothold_margin_m >= 0.0, "foothold_margin_m", "must be at least 0",
          text(foothold_margin_m));
  require(sole_share > 0.0 && sole_share <= 1.0, "sole_share", "must lie in (0, 1]", text(sole_share));
  require(friction_share > 0.0 && friction_share <= 1.0, "friction_share", "must lie in (0, 1]", text(friction_share));
  require_positive("psi_max", psi_max);
  require(std::isfinite(goal_weight) && goal_weight >= 0.0, "goal_weight", "must be at least 0", text(goal_weight));
  require(friction_sides >= 3 && friction_sides <= 64, "friction_sides", "must lie in [3, 64]", text(friction_sides));
  require_positive("tolerance", tolerance);
  require_positive("constraint_tolerance", constraint_tolerance);
  require(max_iterations >= 1, "max_iterations", "must be at least 1", text(max_iterations));
  require(time_limit_s > 0.0, "time_limit_s", "must be a positive number", text(time_limit_s));
}

}  // namespace mcplan::rhp
