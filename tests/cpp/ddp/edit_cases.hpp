#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "ddp/contact_sequence.hpp"
#include "support.hpp"

namespace support {

using mcplan::ddp::ContactRules;
using mcplan::ddp::ContactSequence;

/// Two feet on one surface: '.' both stand, 'a' the first swings, 'b' the second, 'f' both.
inline ContactSequence walk(const std::string& swings) {
  using mcplan::ddp::kFree;
  ContactSequence out;
  for (char c : swings) out.push_back({c == 'a' || c == 'f' ? kFree : 0, c == 'b' || c == 'f' ? kFree : 0});
  return out;
}

inline const ContactRules& two_feet() {
  static const ContactRules rules({{0}, {0}}, {});
  return rules;
}

inline bool contains(const std::vector<ContactSequence>& list, const ContactSequence& sequence) {
  return std::find(list.begin(), list.end(), sequence) != list.end();
}

/// Checks that what `edit` makes of random sequences of the four scenes is valid, new and different, keeps start and
/// goal, and is the same again. How many there are.
template <class Edit>
int check_edits(const Edit& edit, int phase_count, unsigned seed) {
  Random random(seed);
  int found = 0;
  for (const mcplan::Scene& scene : scenes::all_four()) {
    const mcplan::ddp::Problem problem(scene, scenes::humanoid44(), phases(phase_count));
    for (int i = 0; i < 20; ++i) {
      const ContactSequence sequence = random_sequence(problem, random);
      const std::vector<ContactSequence> edits = edit(problem.rules, sequence);
      found += static_cast<int>(edits.size());
      CHECK(std::set<ContactSequence>(edits.begin(), edits.end()).size() == edits.size());
      for (const ContactSequence& edited : edits) {
        CHECK(edited.size() == sequence.size());
        CHECK(problem.rules.valid(edited));
        CHECK(edited != sequence);
        CHECK(edited.front() == sequence.front());
        CHECK(edited.back() == sequence.back());
      }
      CHECK(edit(problem.rules, sequence) == edits);
    }
  }
  return found;
}

}  // namespace support
