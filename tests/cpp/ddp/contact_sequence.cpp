#include "ddp/contact_sequence.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "support.hpp"

namespace {

using namespace mcplan::ddp;
using States = std::set<ContactState>;

States as_set(const std::vector<ContactState>& states) {
  const States out(states.begin(), states.end());
  CHECK(out.size() == states.size());  // no duplicates
  return out;
}

/// All combinations, filtered by `keep`.
template <class Keep>
States filtered(const std::vector<std::vector<int>>& surfaces, const Keep& keep) {
  States states{{}};
  for (const auto& list : surfaces) {
    States longer;
    for (ContactState state : states) {
      state.push_back(kFree);
      longer.insert(state);
      for (int s : list) {
        state.back() = s;
        longer.insert(state);
      }
    }
    states = longer;
  }
  States out;
  for (const ContactState& s : states)
    if (keep(s)) out.insert(s);
  return out;
}

/// Eq. (32), written out.
bool follows(const ContactState& a, const ContactState& b, bool one_switch) {
  int switches = 0;
  for (std::size_t l = 0; l < a.size(); ++l) {
    if (a[l] != b[l] && a[l] != kFree && b[l] != kFree) return false;
    switches += a[l] != b[l];
  }
  return !one_switch || switches <= 1;
}

const std::vector<std::vector<int>> kSurfaces{{0, 1}, {0, 1}, {2}, {1, 3}};
const std::vector<StateRule> kRules{{{0, 1}, {2, 3}}};

/// The rule of gap_with_rail: without a foot, both hands.
bool keeps_rule(const ContactState& s) { return s[0] != kFree || s[1] != kFree || (s[2] != kFree && s[3] != kFree); }

}  // namespace

TEST_CASE("allowed states and successors are those of a brute-force enumeration") {
  for (bool one_switch : {true, false}) {
    const ContactRules rules(kSurfaces, kRules, one_switch);
    const States all = filtered(kSurfaces, keeps_rule);
    CHECK(as_set(rules.all_states(1000)) == all);
    CHECK(all.size() == 3 * 3 * 2 * 3 - (2 * 3 - 2));  // of the six states without a foot two keep the rule
    for (const ContactState& from : all) {
      const States expected =
          filtered(kSurfaces, [&](const ContactState& to) { return keeps_rule(to) && follows(from, to, one_switch); });
      CHECK(as_set(rules.successors(from)) == expected);
      for (const ContactState& to : all) {
        CHECK(rules.may_follow(from, to) == follows(from, to, one_switch));
        CHECK(rules.may_follow(from, to) == rules.may_follow(to, from));
      }
    }
  }
}

TEST_CASE("all_states gives nothing rather than more than its limit") {
  const ContactRules rules(kSurfaces, {});
  CHECK(rules.all_states(54).size() == 54);
  CHECK(rules.all_states(53).empty());
}

TEST_CASE("permissions and rules decide what is allowed") {
  const ContactRules rules(kSurfaces, kRules);
  CHECK(rules.allowed({0, kFree, kFree, kFree}));
  CHECK(rules.allowed({kFree, kFree, 2, 3}));
  CHECK_FALSE(rules.allowed({kFree, kFree, 2, kFree}));
  CHECK_FALSE(rules.allowed({2, 0, kFree, kFree}));  // a surface that is not this end's
  CHECK_FALSE(rules.valid({{0, 0, kFree, kFree}, {0, 0, kFree}}));
  CHECK(ContactRules(kSurfaces, {}).allowed({kFree, kFree, kFree, kFree}));
}

TEST_CASE("the paper's examples of valid sequences and of a neighbourhood") {
  const ContactRules rules({{0}, {0}}, {});
  const auto sequence = [](const std::vector<std::vector<int>>& touching) {
    ContactSequence out;
    for (const auto& step : touching) out.push_back({step[0] - 1, step[1] - 1});
    return out;
  };
  CHECK(rules.valid(sequence({{1, 1}, {0, 1}, {0, 0}})));
  CHECK_FALSE(rules.valid(sequence({{1, 1}, {0, 1}, {1, 0}})));

  const ContactSequence now = sequence({{1, 1}, {0, 1}, {0, 0}, {1, 0}});
  CHECK(as_set(rules.neighbours(now, 1)) == States{{0, -1}});
  CHECK(as_set(rules.neighbours(now, 2)) == States{{0, 0}});
}

TEST_CASE("neighbours differ at one step and leave a valid sequence, and none is missed") {
  support::Random random(11);
  for (bool one_switch : {true, false})
    for (const mcplan::Scene& scene : {scenes::stairs(), scenes::gap_with_rail()}) {
      mcplan::ddp::Options options = support::phases(14);
      options.one_switch_per_step = one_switch;
      const Problem problem(scene, scenes::humanoid44(), options);
      const ContactSequence sequence = support::random_sequence(problem, random);
      std::vector<std::vector<int>> surfaces;
      for (int l = 0; l < problem.layout.end_effector_count(); ++l) surfaces.push_back(problem.rules.surfaces(l));
      for (int k = 1; k < problem.steps; ++k) {
        const States expected = filtered(surfaces, [&](const ContactState& state) {
          ContactSequence changed = sequence;
          changed[k] = state;
          return state != sequence[k] && problem.rules.valid(changed);
        });
        CHECK(as_set(problem.rules.neighbours(sequence, k)) == expected);
      }
    }
}

TEST_CASE("switches are counted per end-effector") {
  CHECK(switch_count({{0, 0}, {kFree, 0}, {kFree, 0}, {1, 0}, {1, kFree}}) == 3);
  CHECK(switch_count({{0, 0}, {kFree, kFree}}) == 2);
  CHECK(switch_count({{0, 0}}) == 0);
}
