#include "ddp/edits.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "support.hpp"

namespace {

using namespace mcplan::ddp;

/// Two feet on one surface: '.' both stand, 'a' the first swings, 'b' the second.
ContactSequence walk(const std::string& swings) {
  ContactSequence out;
  for (char c : swings) out.push_back({c == 'a' ? kFree : 0, c == 'b' ? kFree : 0});
  return out;
}

const ContactRules kTwoFeet({{0}, {0}}, {});

bool contains(const std::vector<ContactSequence>& list, const ContactSequence& sequence) {
  return std::find(list.begin(), list.end(), sequence) != list.end();
}

}  // namespace

TEST_CASE("edits are valid, new, different, and keep start and goal") {
  support::Random random(21);
  int found = 0;
  for (const mcplan::Scene& scene : scenes::all_four()) {
    const Problem problem(scene, scenes::humanoid44(), support::phases(18));
    for (int i = 0; i < 20; ++i) {
      const ContactSequence sequence = support::random_sequence(problem, random);
      const std::vector<ContactSequence> edits = swing_edits(problem.rules, sequence);
      found += static_cast<int>(edits.size());
      CHECK(std::set<ContactSequence>(edits.begin(), edits.end()).size() == edits.size());
      for (const ContactSequence& edited : edits) {
        CHECK(edited.size() == sequence.size());
        CHECK(problem.rules.valid(edited));
        CHECK(edited != sequence);
        CHECK(edited.front() == sequence.front());
        CHECK(edited.back() == sequence.back());
      }
      CHECK(swing_edits(problem.rules, sequence) == edits);
    }
  }
  CHECK(found > 200);
}

TEST_CASE("a swing is shifted, left out, handed over and exchanged") {
  const ContactSequence now = walk("..a...b...");
  const std::vector<ContactSequence> edits = swing_edits(kTwoFeet, now);
  for (const char* expected :
       {".a....b...", "...a..b...", "....a.b...",                                            // the first swing shifted
        "..a.b.....", "..a..b....", "..a....b..", "..a.....b.", "......b...", "..a.......",  // one left out
        "..b...b...", "..a...a...",                                                          // handed to the other foot
        "..b...a..."})                                                                       // exchanged
    CHECK_MESSAGE(contains(edits, walk(expected)), expected);
  CHECK(edits.size() == 12);
}

TEST_CASE("a swing to another surface is only shifted") {
  const ContactRules rules({{0, 1}, {0}}, {});
  const ContactSequence now{{0, 0}, {0, 0}, {kFree, 0}, {1, 0}, {1, 0}, {1, 0}};
  const std::vector<ContactSequence> edits = swing_edits(rules, now);
  CHECK(edits.size() == 3);
  CHECK(contains(edits, {{0, 0}, {kFree, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 0}}));
  CHECK(contains(edits, {{0, 0}, {0, 0}, {0, 0}, {kFree, 0}, {1, 0}, {1, 0}}));
  CHECK(contains(edits, {{0, 0}, {0, 0}, {0, 0}, {0, 0}, {kFree, 0}, {1, 0}}));
}

TEST_CASE("a stretch that is free at the start or the end is no swing") {
  CHECK(swing_edits(kTwoFeet, walk("......")).empty());
  CHECK(swing_edits(kTwoFeet, {{kFree, 0}, {kFree, 0}, {0, 0}, {0, 0}}).empty());
  CHECK(swing_edits(kTwoFeet, {{0, 0}, {0, 0}, {kFree, 0}, {kFree, 0}}).empty());
}
