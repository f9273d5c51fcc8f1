#include "ddp/contact_sequence.hpp"

#include <algorithm>
#include <utility>

namespace mcplan::ddp {

ContactRules::ContactRules(std::vector<std::vector<int>> surfaces, std::vector<StateRule> rules,
                           bool one_switch_per_step, int min_contacts)
    : surfaces_(std::move(surfaces)),
      rules_(std::move(rules)),
      one_switch_(one_switch_per_step),
      min_contacts_(min_contacts) {
  for (const std::vector<int>& list : surfaces_) {
    std::vector<char>& may = may_touch_.emplace_back();
    for (int surface : list) {
      if (surface >= static_cast<int>(may.size())) may.resize(surface + 1, 0);
      may[surface] = 1;
    }
  }
}

bool ContactRules::allowed(const ContactState& state) const {
  if (min_contacts_ > 0 &&
      std::count_if(state.begin(), state.end(), [](int contact) { return contact != kFree; }) < min_contacts_)
    return false;
  for (int l = 0; l < end_effector_count(); ++l)
    if (state[l] != kFree &&
        (state[l] < 0 || state[l] >= static_cast<int>(may_touch_[l].size()) || !may_touch_[l][state[l]]))
      return false;
  for (const StateRule& rule : rules_) {
    const bool all_free =
        std::all_of(rule.when_free.begin(), rule.when_free.end(), [&](int l) { return state[l] == kFree; });
    const bool all_on = std::all_of(rule.require.begin(), rule.require.end(), [&](int l) { return state[l] != kFree; });
    if (all_free && !all_on) return false;
  }
  return true;
}

bool ContactRules::may_follow(const ContactState& from, const ContactState& to) const {
  int switches = 0;
  for (int l = 0; l < end_effector_count(); ++l) {
    if (from[l] == to[l]) continue;
    if (from[l] != kFree && to[l] != kFree) return false;
    if (++switches > 1 && one_switch_) return false;
  }
  return true;
}

std::vector<int> ContactRules::makes(int l, int k, const ContactState& also) const {
  if (near_.empty() || k < 0) return surfaces_[l];
  std::vector<int> out = near_[k][l];
  const int other = also.empty() ? kFree : also[l];
  if (other == kFree || std::binary_search(out.begin(), out.end(), other)) return out;
  out.insert(std::upper_bound(out.begin(), out.end(), other), other);
  return out;
}

std::vector<ContactState> ContactRules::successors(const ContactState& state, int k, const ContactState& also) const {
  std::vector<ContactState> out;
  if (one_switch_) {
    if (allowed(state)) out.push_back(state);
    ContactState next = state;
    for (int l = 0; l < end_effector_count(); ++l) {
      if (state[l] != kFree) {
        next[l] = kFree;
        if (allowed(next)) out.push_back(next);
      } else {
        for (int surface : makes(l, k, also)) {
          next[l] = surface;
          if (allowed(next)) out.push_back(next);
        }
      }
      next[l] = state[l];
    }
    return out;
  }
  // Any set of makes and breaks: an odometer over each end-effector's own choices.
  std::vector<std::vector<int>> choices(end_effector_count());
  for (int l = 0; l < end_effector_count(); ++l) {
    choices[l] = {state[l]};
    const std::vector<int> made = state[l] == kFree ? makes(l, k, also) : std::vector<int>{kFree};
    choices[l].insert(choices[l].end(), made.begin(), made.end());
  }
  std::vector<std::size_t> digit(end_effector_count(), 0);
  for (;;) {
    ContactState next(end_effector_count());
    for (int l = 0; l < end_effector_count(); ++l) next[l] = choices[l][digit[l]];
    if (allowed(next)) out.push_back(next);
    int l = 0;
    while (l < end_effector_count() && ++digit[l] == choices[l].size()) digit[l++] = 0;
    if (l == end_effector_count()) return out;
  }
}

std::vector<ContactState> ContactRules::all_states(std::size_t limit) const {
  double count = 1.0;
  for (const auto& list : surfaces_) count *= 1.0 + static_cast<double>(list.size());
  if (count > static_cast<double>(limit)) return {};
  std::vector<ContactState> out;
  ContactState state(end_effector_count(), kFree);
  std::vector<std::size_t> digit(end_effector_count(), 0);
  for (;;) {
    if (allowed(state)) out.push_back(state);
    int l = 0;
    for (; l < end_effector_count(); ++l) {
      if (digit[l] < surfaces_[l].size()) {
        state[l] = surfaces_[l][digit[l]++];
        break;
      }
      digit[l] = 0;
      state[l] = kFree;
    }
    if (l == end_effector_count()) return out;
  }
}

bool ContactRules::valid(const ContactSequence& sequence) const {
  for (std::size_t k = 0; k < sequence.size(); ++k) {
    if (static_cast<int>(sequence[k].size()) != end_effector_count() || !allowed(sequence[k])) return false;
    if (k > 0 && !may_follow(sequence[k - 1], sequence[k])) return false;
  }
  return true;
}

std::vector<ContactState> ContactRules::neighbours(const ContactSequence& sequence, int k) const {
  std::vector<ContactState> out = successors(sequence[k - 1], k, sequence[k + 1]);
  out.erase(std::remove_if(out.begin(), out.end(),
                           [&](const ContactState& s) { return s == sequence[k] || !may_follow(s, sequence[k + 1]); }),
            out.end());
  return out;
}

bool in_flight(const ContactState& state) {
  return std::all_of(state.begin(), state.end(), [](int contact) { return contact == kFree; });
}

int switch_count(const ContactSequence& sequence) {
  int count = 0;
  for (std::size_t k = 1; k < sequence.size(); ++k)
    for (std::size_t l = 0; l < sequence[k].size(); ++l) count += sequence[k][l] != sequence[k - 1][l];
  return count;
}

}  // namespace mcplan::ddp
