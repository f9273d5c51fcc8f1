#include "ddp/whole_sequence.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <set>
#include <utility>

namespace mcplan::ddp {
namespace {

/// States that can be reached from the start at each step and still reach the goal.
std::vector<std::set<ContactState>> reachable_states(const Problem& problem, std::size_t limit) {
  const int n = problem.steps;
  std::vector<std::set<ContactState>> forward(n + 1), both(n + 1);
  forward[0].insert(problem.start_contacts);
  std::size_t edges = 0;
  for (int k = 0; k < n; ++k)
    for (const ContactState& state : forward[k]) {
      for (ContactState& next : problem.rules.successors(state)) {
        forward[k + 1].insert(std::move(next));
        ++edges;
      }
      if (edges > 4 * limit) return {};
    }
  // Validity is symmetric (a make reversed is a break), so successors serve as predecessors.
  if (!forward[n].count(problem.goal_contacts)) return {};
  both[n].insert(problem.goal_contacts);
  for (int k = n; k > 0; --k)
    for (const ContactState& state : both[k])
      for (ContactState& before : problem.rules.successors(state))
        if (forward[k - 1].count(before)) both[k - 1].insert(std::move(before));
  return both;
}

}  // namespace

SequenceGraph::SequenceGraph(const Problem& problem, std::size_t max_steps) {
  std::size_t pairs = 0;
  for (const std::set<ContactState>& states : reachable_states(problem, max_steps)) {
    nodes_.emplace_back();
    for (const ContactState& state : states) nodes_.back().push_back({state, {}});
  }
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k)
    for (Node& node : nodes_[k]) {
      const std::vector<Node>& later = nodes_[k + 1];
      for (const ContactState& next : problem.rules.successors(node.state)) {
        const auto at = std::lower_bound(later.begin(), later.end(), next,
                                         [](const Node& a, const ContactState& b) { return a.state < b; });
        if (at != later.end() && at->state == next) node.next.push_back(static_cast<int>(at - later.begin()));
      }
      pairs += node.next.size();
      if (pairs <= max_steps) continue;
      nodes_.clear();
      return;
    }
}

PricedSequence best_whole_sequence(const SequenceGraph& graph, LocalModel& model, ValueFunctions& values) {
  /// The way from a node to the goal.
  struct Way {
    Quadratic value;
    double rank = 0.0;
    bool found = false;
  };
  PricedSequence out;
  const auto& nodes = graph.nodes();
  if (nodes.empty()) return out;
  const Problem& problem = model.problem();
  const int n = model.steps();
  std::vector<Way> later(1), now;
  later[0].value = model.base(n);
  later[0].found = true;
  model.add_contacts(n, problem.goal_contacts, later[0].value);
  later[0].value.mirror();
  std::vector<std::vector<int>> chosen(n);

  Quadratic candidate;
  Eigen::LLT<Eigen::MatrixXd> factor;
  Eigen::MatrixXd h;
  Eigen::VectorXd g;
  for (int k = n - 1; k >= 0; --k) {
    now.resize(nodes[k].size());
    chosen[k].assign(nodes[k].size(), 0);
    for (std::size_t i = 0; i < nodes[k].size(); ++i) {
      const SequenceGraph::Node& node = nodes[k][i];
      Way& best = now[i];
      best.found = false;
      for (int next : node.next) {
        if (!later[next].found) continue;
        ++out.riccati_steps;
        if (!values.backward_step(k, node.state, later[next].value, candidate)) continue;
        candidate.c += change_cost(problem, node.state, nodes[k + 1][next].state);
        h = candidate.h + values.U(k).h;
        g = candidate.g + values.U(k).g;
        factor.compute(h);
        if (factor.info() != Eigen::Success) continue;
        factor.matrixL().solveInPlace(g);
        const double rank = candidate.c + values.U(k).c - 0.5 * g.squaredNorm();
        if (best.found && !clearly_less(rank, best.rank)) continue;
        best.rank = rank;
        best.found = true;
        chosen[k][i] = next;
        std::swap(best.value, candidate);
      }
    }
    std::swap(later, now);
  }
  if (!later[0].found) return out;
  out.cost = later[0].rank;
  int at = 0;
  out.sequence.push_back(nodes[0][at].state);
  for (int k = 0; k < n; ++k) {
    at = chosen[k][at];
    out.sequence.push_back(nodes[k + 1][at].state);
  }
  return out;
}

}  // namespace mcplan::ddp
