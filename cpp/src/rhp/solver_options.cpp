#include "rhp/solver_options.hpp"

#include <algorithm>

namespace mcplan::rhp {

nlp::SolverOptions solver_options(const Options& options, double time_left_s) {
  nlp::SolverOptions out;
  out.tolerance = options.tolerance;
  out.constraint_tolerance = options.constraint_tolerance;
  out.max_iterations = options.max_iterations;
  out.time_limit_s = std::max(time_left_s, 1e-3);
  out.ordering = options.automatic_ordering ? nlp::Ordering::automatic : nlp::Ordering::amd;
  // Measured on the terrains: a high first barrier leads to the same optimum from any guess, a low one saves a seventh
  // of the iterations where there are most of them.
  out.initial_barrier = options.paper ? 0.3 : options.fidelity == Fidelity::single ? 0.03 : 0.1;
  out.adaptive_barrier = options.solver != nlp::Solver::ipopt;  // a third of the kernel's iterations less
  out.gradient_scaling = false;                                 // the variables are of the order of one as they are
  out.stop = options.stop;
  out.clock = options.clock;
  return out;
}

}  // namespace mcplan::rhp
