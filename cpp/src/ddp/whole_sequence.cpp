#include "ddp/whole_sequence.hpp"

#include <Eigen/Cholesky>
#include <map>
#include <set>
#include <utility>

namespace mcplan::ddp {
namespace {

struct Node {
  Quadratic value;
  ContactState next;
  double rank = 0.0;
};

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

PricedSequence best_whole_sequence(LocalModel& model, ValueFunctions& values, std::size_t max_riccati_steps) {
  const Problem& problem = model.problem();
  const int n = problem.steps;
  PricedSequence out;
  const auto states = reachable_states(problem, max_riccati_steps);
  if (states.empty()) return out;

  std::map<ContactState, Node> later, now;
  Node last;
  last.value = model.base(n);
  model.add_contacts(n, problem.goal_contacts, last.value);
  later[problem.goal_contacts] = last;
  std::vector<std::map<ContactState, ContactState>> chosen(n);

  Quadratic candidate;
  Eigen::LLT<Eigen::MatrixXd> factor;
  Eigen::MatrixXd h;
  Eigen::VectorXd g;
  for (int k = n - 1; k >= 0; --k) {
    now.clear();
    for (const ContactState& state : states[k]) {
      Node best;
      bool found = false;
      for (const ContactState& next : problem.rules.successors(state)) {
        const auto follower = later.find(next);
        if (follower == later.end()) continue;
        if (static_cast<std::size_t>(++out.riccati_steps) > max_riccati_steps) return {};
        if (!values.backward_step(k, state, follower->second.value, candidate)) continue;
        candidate.c += change_cost(problem, state, next);
        h = candidate.h + values.U(k).h;
        g = candidate.g + values.U(k).g;
        factor.compute(h);
        if (factor.info() != Eigen::Success) continue;
        factor.matrixL().solveInPlace(g);
        const double rank = candidate.c + values.U(k).c - 0.5 * g.squaredNorm();
        if (found && !clearly_less(rank, best.rank)) continue;
        best.rank = rank;
        best.next = next;
        std::swap(best.value, candidate);
        found = true;
      }
      if (!found) continue;
      chosen[k][state] = best.next;
      now.emplace(state, std::move(best));
    }
    std::swap(later, now);
  }
  const auto root = later.find(problem.start_contacts);
  if (root == later.end()) return out;
  out.cost = root->second.rank;
  out.sequence.push_back(problem.start_contacts);
  for (int k = 0; k < n; ++k) out.sequence.push_back(chosen[k].at(out.sequence.back()));
  return out;
}

}  // namespace mcplan::ddp
