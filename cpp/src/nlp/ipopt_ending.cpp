#include "nlp/ipopt_ending.hpp"

#include "nlp/ipopt_version.hpp"

namespace mcplan::nlp {

Ending ending_of(Ipopt::ApplicationReturnStatus code, bool feasible) {
  switch (code) {
    case Ipopt::Solve_Succeeded:
      return {Outcome::converged, "converged", true};
    case Ipopt::Solved_To_Acceptable_Level:
      return {Outcome::nearly_converged, "no further progress; the optimality error is within 100 times the tolerance",
              true};
    case Ipopt::Feasible_Point_Found:  // as many equalities as variables: feasible is all that can be asked for
      return {Outcome::converged, "found the feasible point of a square problem", true};
    case Ipopt::Infeasible_Problem_Detected:
      return {Outcome::infeasible, "converged to a point at which the violation is locally least", false};
    case Ipopt::Search_Direction_Becomes_Too_Small:
      if (feasible) return {Outcome::nearly_converged, "feasible, but the steps became too small to converge", false};
      return {Outcome::numerical_failure, "the steps became too small before a feasible point was found", false};
    case Ipopt::Diverging_Iterates:
      return {Outcome::numerical_failure, "the iterates diverge; is the cost bounded from below?", false};
    case Ipopt::User_Requested_Stop:
      return {Outcome::interrupted, "stopped by the caller", false};
    case Ipopt::Maximum_Iterations_Exceeded:
      return {Outcome::iteration_limit, "reached max_iterations", false};
    case Ipopt::Maximum_CpuTime_Exceeded:
#if MCPLAN_IPOPT_AT_LEAST(3, 14)
    case Ipopt::Maximum_WallTime_Exceeded:
#endif
      return {Outcome::time_limit, "reached time_limit_s", false};
    case Ipopt::Restoration_Failed:
      return {Outcome::numerical_failure, "found no way back to feasibility, nor that there is none", false};
    case Ipopt::Error_In_Step_Computation:
      return {Outcome::numerical_failure, "the linear system of a step could not be solved", false};
    case Ipopt::Not_Enough_Degrees_Of_Freedom:
      return {Outcome::infeasible, "there are more equalities than free variables", false};
    case Ipopt::Invalid_Problem_Definition:
      return {Outcome::infeasible, "Ipopt finds a contradiction in the bounds", false};
    case Ipopt::Invalid_Number_Detected:
      return {Outcome::numerical_failure, "a number in Ipopt's own computation is not finite", false};
    case Ipopt::Invalid_Option:
      return {Outcome::numerical_failure, "Ipopt refused an option; is it built without MUMPS?", false};
    case Ipopt::Insufficient_Memory:
      return {Outcome::numerical_failure, "out of memory", false};
    case Ipopt::Unrecoverable_Exception:
    case Ipopt::NonIpopt_Exception_Thrown:
    case Ipopt::Internal_Error:
      break;
  }
  return {Outcome::numerical_failure, "internal error of Ipopt", false};
}

}  // namespace mcplan::nlp
