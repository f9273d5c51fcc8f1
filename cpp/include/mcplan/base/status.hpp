#pragma once

#include <optional>
#include <string_view>

namespace mcplan {

/// How a solve ended. `solved` is only ever set after the independent checker has accepted the plan.
enum class Status {
  solved,             ///< converged, and the checker passes
  acceptable,         ///< converged, but the checker finds a violation (named in the report)
  infeasible,         ///< the problem itself cannot be satisfied (goal out of every reach, ...)
  no_sequence,        ///< no contact sequence joins start and goal in the given number of phases
  iteration_limit,    ///< stopped by the iteration limit; best iterate returned
  time_limit,         ///< stopped by the wall-clock limit; best iterate returned
  interrupted,        ///< stopped by the caller; best iterate returned
  numerical_failure,  ///< a factorisation failed or a number was not finite; last valid iterate returned
};

std::string_view to_string(Status status);

/// Inverse of to_string; empty for a name that does not exist.
std::optional<Status> status_from_string(std::string_view name);

}  // namespace mcplan
