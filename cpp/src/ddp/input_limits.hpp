#pragma once

#include <algorithm>
#include <cmath>

#include "ddp/constants.hpp"
#include "ddp/problem.hpp"

namespace mcplan::ddp {

/// Where the duration of a phase may lie and where it is drawn to, non-dimensional.
struct DurationLimits {
  double min, middle, max;
};

/// A phase that was under way when replanning has as long as was left of it.
inline bool under_way(const Problem& problem, int k) { return k == 0 && problem.first_duration > 0.0; }

/// Minimum duration of phase k where it is a flight.
inline double min_flight_duration(const Problem& problem, int k) {
  return under_way(problem, k) ? 0.0 : problem.flight_duration_min;
}

inline DurationLimits duration_limits(const Problem& problem, int k) {
  const bool begun = under_way(problem, k);
  if (begun && problem.first_duration_kept)
    return {(1.0 - kCommittedRatio) * problem.first_duration, problem.first_duration,
            (1.0 + kCommittedRatio) * problem.first_duration};
  return {begun ? std::min(problem.first_duration, problem.duration_min) : problem.duration_min,
          begun ? problem.first_duration : 0.5 * (problem.duration_min + problem.duration_max), problem.duration_max};
}

/// Weight of the pull towards the middle.
inline double duration_weight(const Problem& problem, int k) {
  return (under_way(problem, k) ? kUnderWay : 1.0) * problem.options.weights.duration;
}

/// Largest stiffness input of an end-effector: the one at which the force cap is met in the nominal stance, at least
/// one CoM height away.
inline double max_stiffness_input(const Problem& problem, int l) {
  const EndLimits& limit = problem.limits[l];
  const double mu_max = limit.force_max / std::max(limit.nominal.norm(), 1.0);
  return problem.options.stiffness_input == StiffnessInput::lambda ? std::sqrt(mu_max) : mu_max;
}

}  // namespace mcplan::ddp
