#include "ddp/initial_sequence.hpp"

#include <algorithm>
#include <map>

#include "ddp/constants.hpp"

namespace mcplan::ddp {
namespace {

/// Contact changes needed to come from one state to another: a surface to another one takes two.
int distance(const ContactState& from, const ContactState& to) {
  int changes = 0;
  for (std::size_t l = 0; l < from.size(); ++l)
    if (from[l] != to[l]) changes += from[l] != kFree && to[l] != kFree ? 2 : 1;
  return changes;
}

struct Reached {
  double cost;
  ContactState before;
};

}  // namespace

ContactSequence initial_sequence(LocalModel& model, std::size_t beam, const StopRequest& stop) {
  const Problem& problem = model.problem();
  const int n = problem.steps, end_effectors = problem.layout.end_effector_count();
  const bool one_switch = problem.options.one_switch_per_step;
  const auto cost_of = [&](int k, const ContactState& state) {
    double cost = state_cost(problem, state);
    if (const Rows* rows = model.state_block(k, state)) cost += rows->cost();
    for (int l = 0; l < end_effectors; ++l) cost += model.block(k, l, state[l]).cost();
    return cost;
  };

  std::vector<std::map<ContactState, Reached>> layers(n + 1);
  if (!problem.rules.allowed(problem.start_contacts) || !problem.rules.allowed(problem.goal_contacts)) return {};
  layers[0][problem.start_contacts] = {cost_of(0, problem.start_contacts), {}};
  int looked_at = 0;
  for (int k = 0; k < n; ++k) {
    std::map<ContactState, Reached>& next = layers[k + 1];
    for (const auto& [state, node] : layers[k]) {
      if (stop && ++looked_at % kStatesPerPoll == 0 && stop()) return {};
      for (ContactState& follower : problem.rules.successors(state, k + 1)) {
        // Leave out what can no longer reach the goal's contacts in the steps that remain.
        if (one_switch && distance(follower, problem.goal_contacts) > n - (k + 1)) continue;
        const double cost = node.cost + cost_of(k + 1, follower);
        const auto [it, fresh] = next.try_emplace(std::move(follower), Reached{cost, state});
        if (!fresh && clearly_less(cost, it->second.cost)) it->second = {cost, state};
      }
    }
    if (next.size() > beam) {
      std::vector<double> costs;
      for (const auto& [state, node] : next) costs.push_back(node.cost);
      std::nth_element(costs.begin(), costs.begin() + static_cast<std::ptrdiff_t>(beam), costs.end());
      const double limit = costs[beam];
      for (auto it = next.begin(); it != next.end();)
        it = it->second.cost > limit && it->first != problem.goal_contacts ? next.erase(it) : std::next(it);
    }
  }

  if (!layers[n].count(problem.goal_contacts)) return {};
  ContactSequence sequence(n + 1);
  sequence[n] = problem.goal_contacts;
  for (int k = n; k > 0; --k) sequence[k - 1] = layers[k].at(sequence[k]).before;
  return sequence;
}

}  // namespace mcplan::ddp
