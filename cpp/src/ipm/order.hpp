#pragma once

#include <vector>

#include "ipm/unknowns.hpp"
#include "mcplan/nlp/problem.hpp"

namespace mcplan::ipm {

/// In which groups the unknowns of a problem are eliminated: free variables 0 ... n-1, then equalities n ... n+m-1.
///
/// Stage by stage from the end of the horizon to its begin, as a Riccati recursion goes, each stage with the equalities
/// that hold of it or lead to it. A variable that lasts several stages is carried to its first one. Ahead of a stage go
/// its inputs that no transition sees (a contact force enters by its sum alone), each set of them that share a cost or
/// an inequality as a small group: these are many, and a stage that held them all would cost their number cubed. With
/// `sums_ahead` the equalities that these inputs could be solved from come next, by themselves: as good, unless at some
/// point they say the same twice of the inputs and something else of other variables.
std::vector<std::vector<int>> elimination_order(const nlp::Problem& problem, const Unknowns& unknowns, bool sums_ahead);

}  // namespace mcplan::ipm
