#pragma once

#include <cstddef>

#include "ddp/contact_sequence.hpp"
#include "ddp/value_functions.hpp"

namespace mcplan::ddp {

/// A sequence and the minimum of the local model with it.
struct PricedSequence {
  ContactSequence sequence;  ///< empty: none found, or too many states for the budget
  double cost = 0.0;
  int riccati_steps = 0;
};

/// Best whole sequence by dynamic programming over (step, contact state). Every node keeps one quadratic V_k; of the
/// successors the one is kept whose V_k is least at the place where the present plan comes from (min_x U_k + V_k),
/// since quadratics cannot be ranked everywhere at once. The cost of the result is exact for the local model; that it
/// is the best of all is not guaranteed. The cost counts the contact changes as well. Contains every single switch and
/// every pair of them. Not in the paper.
PricedSequence best_whole_sequence(LocalModel& model, ValueFunctions& values, std::size_t max_riccati_steps);

}  // namespace mcplan::ddp
