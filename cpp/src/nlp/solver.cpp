#include "mcplan/nlp/solver.hpp"

#include <cmath>

#include "mcplan/base/error.hpp"

namespace mcplan::nlp {
namespace {

void require_positive(const char* field, double value) {
  if (!(std::isfinite(value) && value > 0.0)) throw InvalidOptions(field, "must be a positive number", text(value));
}

}  // namespace

void SolverOptions::validate() const {
  require_positive("tolerance", tolerance);
  require_positive("constraint_tolerance", constraint_tolerance);
  if (max_iterations < 0) throw InvalidOptions("max_iterations", "must be at least 0", text(max_iterations));
  if (!(time_limit_s > 0.0)) throw InvalidOptions("time_limit_s", "must be a positive number", text(time_limit_s));
  require_positive("initial_barrier", initial_barrier);
}

Status status_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::converged:
      return Status::solved;
    case Outcome::nearly_converged:
      return Status::acceptable;
    case Outcome::infeasible:
      return Status::infeasible;
    case Outcome::iteration_limit:
      return Status::iteration_limit;
    case Outcome::time_limit:
      return Status::time_limit;
    case Outcome::interrupted:
      return Status::interrupted;
    case Outcome::numerical_failure:
      break;
  }
  return Status::numerical_failure;
}

}  // namespace mcplan::nlp
