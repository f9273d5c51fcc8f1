#pragma once

#include <cstddef>
#include <vector>

#include "ddp/contact_sequence.hpp"
#include "ddp/value_functions.hpp"

namespace mcplan::ddp {

/// A sequence and the minimum of the local model with it.
struct PricedSequence {
  ContactSequence sequence;  ///< empty: none found, or too many states for the budget
  double cost = 0.0;
  int riccati_steps = 0;
};

/// Contact states that lie on some sequence from the start to the goal, and which may follow which.
class SequenceGraph {
 public:
  /// Given up, and empty, where there are more than `max_steps` pairs of states that follow each other.
  SequenceGraph(const Problem& problem, std::size_t max_steps);

  struct Node {
    ContactState state;
    std::vector<int> next;  ///< among those of the step after
  };
  /// By step, in the order of the states; empty: given up, or nothing joins start and goal.
  const std::vector<std::vector<Node>>& nodes() const { return nodes_; }

 private:
  std::vector<std::vector<Node>> nodes_;
};

/// Best whole sequence by dynamic programming over (step, contact state). Every node keeps one quadratic V_k; of the
/// successors the one is kept whose V_k is least at the place where the present plan comes from (min_x U_k + V_k),
/// since quadratics cannot be ranked everywhere at once. The cost of the result is exact for the local model; that it
/// is the best of all is not guaranteed. The cost counts the contact changes as well. Contains every single switch and
/// every pair of them. Not in the paper.
PricedSequence best_whole_sequence(const SequenceGraph& graph, LocalModel& model, ValueFunctions& values);

}  // namespace mcplan::ddp
