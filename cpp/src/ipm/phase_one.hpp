#pragma once

#include <Eigen/Core>

#include "ipm/functions.hpp"
#include "ipm/kkt.hpp"

namespace mcplan::ipm {

/// Levenberg-Marquardt steps towards a point that satisfies the problem, whatever it costs: from a start far outside,
/// the barrier method takes dozens of short steps along the bounds that it has to keep.
///
/// Least squares of the equalities and of how far inequalities and variables lie outside of their limits, which are
/// drawn in by a twentieth of their width, at most 0.05: what comes next needs room on both sides.
struct PhaseOne {
  double damping = 10.0;  ///< of the first step
  int max_iterations = 8;
  double enough = 0.1;  ///< ends where no residual is larger than this: the barrier method does the rest

  /// Moves point.t (and evaluates there); returns the number of steps. Throws Halt.
  int run(const Unknowns& unknowns, Functions& functions, Kkt& kkt, Point& point) const;
};

}  // namespace mcplan::ipm
