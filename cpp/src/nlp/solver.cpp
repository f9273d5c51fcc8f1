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

}  // namespace mcplan::nlp
