#pragma once

#include "ddp/contact_sequence.hpp"
#include "ddp/problem.hpp"

namespace mcplan::ddp {

/// A second first guess for the sequence: the end-effectors that stand at start and goal step in turn, one swing and
/// one phase of full support after the other, each onto the allowed surface nearest to where the reference will have
/// it. Empty when that breaks a rule. Not in the paper; it saves the search from the many poor local optima of open
/// ground.
ContactSequence stepping_sequence(const Problem& problem, int first_mover);

/// Whether a tracked robot walks on four point feet or more: it steps in the order of a crawl, and the search begins
/// with that.
bool balances_on_points(const Problem& problem);

}  // namespace mcplan::ddp
