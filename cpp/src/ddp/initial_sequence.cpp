#include "ddp/initial_sequence.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

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
  const ContactState* before;  ///< of the layer before
};

/// What the contacts of a step cost one by one: asked for many times, summed over their rows once.
class ContactCosts {
 public:
  explicit ContactCosts(LocalModel& model)
      : model_(&model), at_(model.problem().layout.end_effector_count(), std::vector<double>(1, kUnknown)) {}

  /// From now on of step k.
  void begin(int k) {
    k_ = k;
    for (std::vector<double>& costs : at_) std::fill(costs.begin(), costs.end(), kUnknown);
  }

  double operator()(const ContactState& state) {
    const Problem& problem = model_->problem();
    double cost = state_cost(problem, state);
    if (const Rows* rows = model_->state_block(k_, state)) cost += rows->cost();
    for (std::size_t l = 0; l < state.size(); ++l) cost += of(static_cast<int>(l), state[l]);
    return cost;
  }

 private:
  static constexpr double kUnknown = -1.0;  // costs are sums of squares

  double of(int l, int contact) {
    const std::size_t place = contact == kFree ? 0 : contact + 1;
    if (place >= at_[l].size()) at_[l].resize(place + 1, kUnknown);
    double& cost = at_[l][place];
    if (cost < 0.0) cost = model_->block(k_, l, contact).cost();
    return cost;
  }

  LocalModel* model_;
  int k_ = 0;
  std::vector<std::vector<double>> at_;
};

}  // namespace

ContactSequence initial_sequence(LocalModel& model, std::size_t beam, const StopRequest& stop) {
  const Problem& problem = model.problem();
  const int n = problem.steps;
  const bool one_switch = problem.options.one_switch_per_step;
  ContactCosts cost_of(model);
  std::vector<std::map<ContactState, Reached>> layers(n + 1);
  if (!problem.rules.allowed(problem.start_contacts) || !problem.rules.allowed(problem.goal_contacts)) return {};
  layers[0][problem.start_contacts] = {cost_of(problem.start_contacts), nullptr};
  int looked_at = 0;
  for (int k = 0; k < n; ++k) {
    std::map<ContactState, Reached>& next = layers[k + 1];
    cost_of.begin(k + 1);
    for (const auto& [state, node] : layers[k]) {
      if (stop && ++looked_at % kStatesPerPoll == 0 && stop()) return {};
      for (ContactState& follower : problem.rules.successors(state, k + 1)) {
        // Leave out what can no longer reach the goal's contacts in the steps that remain.
        if (one_switch && distance(follower, problem.goal_contacts) > n - (k + 1)) continue;
        const double cost = node.cost + cost_of(follower);
        const auto [it, fresh] = next.try_emplace(std::move(follower), Reached{cost, &state});
        if (!fresh && clearly_less(cost, it->second.cost)) it->second = {cost, &state};
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
  for (int k = n; k > 0; --k) sequence[k - 1] = *layers[k].at(sequence[k]).before;
  return sequence;
}

}  // namespace mcplan::ddp
