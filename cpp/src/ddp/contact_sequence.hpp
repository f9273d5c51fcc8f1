#pragma once

#include <cmath>
#include <utility>
#include <vector>

namespace mcplan::ddp {

/// Contact state of one step (the paper's sigma_k): surface index per end-effector, kFree when it touches nothing.
using ContactState = std::vector<int>;
constexpr int kFree = -1;

/// Contact state of every step k = 0..N (the paper's sigma).
using ContactSequence = std::vector<ContactState>;

/// Whether nothing is in contact.
bool in_flight(const ContactState& state);

/// "If none of `when_free` is in contact, all of `require` must be", by end-effector index.
struct StateRule {
  std::vector<int> when_free, require;
};

/// Which contact states exist and which may follow each other.
class ContactRules {
 public:
  ContactRules() = default;

  /// surfaces[l]: the surfaces that end-effector l may touch; at least `min_contacts` of them touch one at any time.
  ContactRules(std::vector<std::vector<int>> surfaces, std::vector<StateRule> rules, bool one_switch_per_step = true,
               int min_contacts = 0);

  /// From now on a contact that is made at step k is looked for among near[k][l] alone; what is already touched may be
  /// kept, and `valid` is as before.
  void look_near(std::vector<std::vector<std::vector<int>>> near) { near_ = std::move(near); }

  bool looks_everywhere() const { return near_.empty(); }

  int end_effector_count() const { return static_cast<int>(surfaces_.size()); }
  const std::vector<int>& surfaces(int l) const { return surfaces_[l]; }

  /// Permissions and scene rules.
  bool allowed(const ContactState& state) const;

  /// Tazaki, eq. (32): at most one end-effector makes or breaks a contact, and none goes from surface to surface.
  /// Without one_switch_per_step only the latter holds.
  bool may_follow(const ContactState& from, const ContactState& to) const;

  /// Allowed states that may follow `state`, itself included, in a fixed order; at step k where that is given, with the
  /// contacts that are looked for there and those of `also`.
  std::vector<ContactState> successors(const ContactState& state, int k = -1, const ContactState& also = {}) const;

  /// All allowed states, or an empty list when there would be more than `limit`.
  std::vector<ContactState> all_states(std::size_t limit) const;

  bool valid(const ContactSequence& sequence) const;

  /// The states that step k may take with all the others held (Tazaki, eq. 33), without its present one.
  std::vector<ContactState> neighbours(const ContactSequence& sequence, int k) const;

 private:
  std::vector<int> makes(int l, int k, const ContactState& also) const;

  std::vector<std::vector<int>> surfaces_;
  std::vector<std::vector<char>> may_touch_;         // by end-effector and surface
  std::vector<std::vector<std::vector<int>>> near_;  // by step and end-effector; empty: all surfaces everywhere
  std::vector<StateRule> rules_;
  bool one_switch_ = true;
  int min_contacts_ = 0;
};

/// Whether a cost is below another by more than rounding. Scenes with a mirror plane are full of sequences that cost
/// the same; the first of them is taken, so that the plan does not depend on where the scene lies in the world.
inline bool clearly_less(double cost, double than) { return cost < than - 1e-9 * std::abs(than); }

/// Steps at which an end-effector's contact differs from the step before, summed over the end-effectors.
int switch_count(const ContactSequence& sequence);

}  // namespace mcplan::ddp
