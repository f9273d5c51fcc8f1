#include "mcplan/planar/sip/options.hpp"

#include <cmath>
#include <string>

#include "mcplan/base/error.hpp"

namespace mcplan::sip {
namespace {

void require(bool good, const std::string& field, const std::string& rule, const std::string& value) {
  if (!good) throw InvalidOptions(field, rule, value);
}

void require_positive(const std::string& field, double value) {
  require(std::isfinite(value) && value > 0.0, field, "must be a positive number", text(value));
}

void require_not_negative(const std::string& field, double value) {
  require(std::isfinite(value) && value >= 0.0, field, "must be at least 0", text(value));
}

void require_range(const std::string& field, const Range& range) {
  require(std::isfinite(range.max) && range.min > 0.0 && range.max >= range.min, field,
          "must be two positive numbers, the second not smaller", text(range.min) + ", " + text(range.max));
}

}  // namespace

void Options::validate() const {
  require_not_negative("torque_weight", torque_weight);
  require_not_negative("duration_weight", duration_weight);
  require_not_negative("jerk_weight", jerk_weight);
  require_range("total_duration_s", total_duration_s);
  require_range("phase_duration_s", phase_duration_s);
  require_positive("tube_m", tube_m);
  require_positive("tube_rad", tube_rad);
  require(order >= 3 && order <= 12, "order", "must lie in [3, 12]", text(order));
  require(neq >= 0 && neq <= order, "neq", "must lie in [0, order]", text(neq));
  require(grid_points >= 2 && grid_points <= 1000, "grid_points", "must lie in [2, 1000]", text(grid_points));
  require(std::isfinite(clearance_m), "clearance_m", "must be a number", text(clearance_m));
  require_not_negative("min_normal_force", min_normal_force);
  require(margin >= 0.0 && margin < 0.5, "margin", "must lie in [0, 0.5)", text(margin));
  require_positive("log_weight_max", log_weight_max);
  require_positive("tolerance", tolerance);
  require_positive("constraint_tolerance", constraint_tolerance);
  require(max_iterations >= 1 && max_iterations <= 1000000, "max_iterations", "must lie in [1, 1000000]",
          text(max_iterations));
  require(time_limit_s > 0.0, "time_limit_s", "must be a positive number", text(time_limit_s));
}

}  // namespace mcplan::sip
