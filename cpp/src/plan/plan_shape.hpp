#pragma once

#include <cstddef>
#include <string>

#include "mcplan/base/error.hpp"
#include "mcplan/plan/plan.hpp"

namespace mcplan {

/// Throws InvalidPlan when an array of a plan of any kind has not as many entries as it must have.
template <class Size>
void require_size(const std::string& field, Size size, std::size_t expected) {
  if (static_cast<std::size_t>(size) != expected)
    throw InvalidPlan(field, "must have " + std::to_string(expected) + " entries", std::to_string(size));
}

/// Throws InvalidPlan when sizes or indices do not fit together. Says nothing of the numbers: a planner that ends with
/// numbers that are not finite still gets an answer about its plan. `surfaces`: how many there are. Swings are left out
/// with `with_swings` false.
void require_shape(const Plan& plan, std::size_t surfaces, bool with_swings = true);

/// Throws InvalidPlan or InvalidInput for what Plan::at_phase(k, since_start) would read outside of its bounds: the
/// plan may have been edited since it was validated. It looks at no more than that instant needs, since a controller
/// asks at 1 kHz.
void require_queryable(const Plan& plan, int k, double since_start);

/// Samples of a phase in equal steps no longer than sample_s, at least 1; 0 for a phase without a duration. Throws
/// InvalidInput for a sampling that is not positive or cuts the phase into more than 1e7.
int samples_of(const Phase& phase, double sample_s);

/// Throws InvalidPlan unless start_slack_s is finite, not negative and, without a measured start, zero.
void require_start_slack(const Plan& plan);

}  // namespace mcplan
