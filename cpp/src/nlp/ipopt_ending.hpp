#pragma once

#include <IpReturnCodes.hpp>
#include <string>

#include "mcplan/nlp/solver.hpp"

namespace mcplan::nlp {

/// How a solve ends, and whether Ipopt's last iterate is the one to return (otherwise the best of all points).
struct Ending {
  Outcome outcome = Outcome::numerical_failure;
  std::string message;
  bool keep_last = false;
};

/// Ipopt's endings one by one. `feasible`: some point seen satisfies the constraints.
Ending ending_of(Ipopt::ApplicationReturnStatus code, bool feasible);

}  // namespace mcplan::nlp
