#pragma once

#include <vector>

#include "ddp/problem.hpp"
#include "mcplan/plan/plan.hpp"
#include "mcplan/plan/report.hpp"

namespace mcplan::ddp {

/// Plan further inside of every limit that a plan misses, by as much as it does. Limits are held at a few instants,
/// swings are chosen once the motion is known, and soft limits give way a little: what is over a limit by that much in
/// the plan is within it when the search aims that much further inside. `violations` are the checker's, in SI units,
/// those within their tolerance left out. What the search has no limit for stays as it is.
void tighten(Problem& problem, Tuning& tuning, const std::vector<Violation>& violations);

/// The same of a motion whose sequence stays: what a contact misses of its reach between two knots of `plan` is kept
/// further inside there, and at the knots, which know of it, nothing is.
void tighten_between_knots(Problem& problem, Tuning& tuning, std::vector<Violation> violations, const Plan& plan);

/// What a near miss in so many phases may cost once it is mended, to be taken before there are restarts: little more
/// than now, or what a walk in many phases usually does.
double dearest_mended(double cost, int phases);

}  // namespace mcplan::ddp
