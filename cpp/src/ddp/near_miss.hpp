#pragma once

#include <vector>

#include "ddp/problem.hpp"
#include "mcplan/plan/report.hpp"

namespace mcplan::ddp {

/// Plan further inside of every limit that a plan misses, by as much as it does. Limits are held at a few instants,
/// swings are chosen once the motion is known, and soft limits give way a little: what is over a limit by that much in
/// the plan is within it when the search aims that much further inside. `violations` are the checker's, in SI units,
/// those within their tolerance left out. What the search has no limit for stays as it is.
void tighten(Problem& problem, Tuning& tuning, const std::vector<Violation>& violations);

}  // namespace mcplan::ddp
