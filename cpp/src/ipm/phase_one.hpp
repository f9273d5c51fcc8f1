#pragma once

#include <Eigen/Core>

#include "ipm/functions.hpp"
#include "ipm/kkt.hpp"

namespace mcplan::ipm {

/// Levenberg-Marquardt steps towards a point that satisfies the problem, whatever it costs: from a start far outside,
/// the barrier method takes dozens of short steps along the bounds that it has to keep.
///
/// Least squares of the equalities and of how far inequalities and variables lie outside of their limits.
struct PhaseOne {
  double damping = 10.0;  ///< of the first step
  int max_iterations = 8;
  double enough = 0.1;     ///< ends where no residual is larger than this: the barrier method does the rest
  double drawn_in = 0.05;  ///< limits, by this ratio of their width and at most by this: what comes next needs room
  /// Variables stay within their bounds, outside of which the problem's functions need not be defined.
  bool within_bounds = true;
  int patience = 0;     ///< ends, too, where so many steps hardly lessen the sum of squares; 0: never
  double hardly = 0.1;  ///< by less than this ratio of it

  /// Moves point.t (and evaluates there). True if no direction lessens the sum of squares any more, or hardly, though a
  /// residual is larger than `enough`. Throws Halt.
  bool run(const Unknowns& unknowns, Functions& functions, Kkt& kkt, Point& point) const;
};

}  // namespace mcplan::ipm
