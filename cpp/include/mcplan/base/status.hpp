#pragma once

#include <optional>
#include <string_view>

namespace mcplan {

/// How a solve ended. `solved` is only ever set after the independent checker has accepted the plan.
enum class Status {
  solved,       ///< the search has converged, and the independent checker accepts the plan
  acceptable,   ///< the search has converged nearly, or fully with a violation that the checker finds (in the report)
  infeasible,   ///< no plan within all limits was found near the last iterate, at which the violation is locally least;
                ///< a proof that there is none only where the message names a contradiction in the input
  no_sequence,  ///< no contact sequence joins start and goal in the given number of phases
  iteration_limit,    ///< the iteration limit was reached; the best iterate is returned
  time_limit,         ///< the wall-clock limit was reached; the best iterate is returned
  interrupted,        ///< the caller stopped the search; the best iterate is returned
  numerical_failure,  ///< a factorisation failed or a number was not finite; the last valid iterate is returned
};

std::string_view to_string(Status status);

/// Inverse of to_string; empty for a name that does not exist.
std::optional<Status> status_from_string(std::string_view name);

}  // namespace mcplan
