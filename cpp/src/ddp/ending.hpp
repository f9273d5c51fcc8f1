#pragma once

namespace mcplan::ddp {

/// How a stage of the search ended, or an attempt, or all of them: whether those after it go on. What a user is told
/// is a Status, made of it and of what the checker says of the plan.
enum class Ending {
  done,             ///< it came to its end
  broke_down,       ///< a factorisation failed or a number was not finite
  no_sequence,      ///< no contact sequence joins start and goal in the given number of phases
  iteration_limit,  ///< of all attempts
  time_limit,       ///< of the whole search
  interrupted,      ///< by the caller
};

}  // namespace mcplan::ddp
