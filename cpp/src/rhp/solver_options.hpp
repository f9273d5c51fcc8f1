#pragma once

#include "mcplan/nlp/solver.hpp"
#include "mcplan/rhp/options.hpp"

namespace mcplan::rhp {

/// How the program of a cycle is solved.
nlp::SolverOptions solver_options(const Options& options, double time_left_s);

}  // namespace mcplan::rhp
