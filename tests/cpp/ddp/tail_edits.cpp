#include "ddp/tail_edits.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "support.hpp"

namespace {

using namespace mcplan::ddp;

/// Two feet on one surface: '.' both stand, 'a' the first swings, 'b' the second, 'f' both.
ContactSequence walk(const std::string& swings) {
  ContactSequence out;
  for (char c : swings) out.push_back({c == 'a' || c == 'f' ? kFree : 0, c == 'b' || c == 'f' ? kFree : 0});
  return out;
}

const ContactRules kTwoFeet({{0}, {0}}, {});

bool contains(const std::vector<ContactSequence>& list, const ContactSequence& sequence) {
  return std::find(list.begin(), list.end(), sequence) != list.end();
}

/// Which of the phases of `from` come one after the other in `to`, at most one of them twice and one not at all.
bool retimed(const ContactSequence& from, const ContactSequence& to) {
  const int n = static_cast<int>(from.size()) - 1;
  for (int out = 1; out < n; ++out)
    for (int twice = 0; twice < n; ++twice) {
      ContactSequence made;
      for (int k = 0; k <= n; ++k) {
        if (k != out) made.push_back(from[k]);
        if (k == twice && twice != out) made.push_back(from[k]);
      }
      if (made == to) return true;
    }
  return false;
}

/// Whether they are the same up to some step, and from there on to the goal with the two feet exchanged.
bool exchanged(ContactSequence from, const ContactSequence& to) {
  for (std::size_t k = from.size() - 1; k-- > 1;) {
    std::swap(from[k][0], from[k][1]);
    if (from == to) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("changed ends are valid, new, different, and keep start and goal") {
  support::Random random(22);
  int found = 0;
  for (const mcplan::Scene& scene : scenes::all_four()) {
    const Problem problem(scene, scenes::humanoid44(), support::phases(10));
    for (int i = 0; i < 20; ++i) {
      const ContactSequence sequence = support::random_sequence(problem, random);
      const std::vector<ContactSequence> edits = tail_edits(problem.rules, sequence);
      found += static_cast<int>(edits.size());
      CHECK(std::set<ContactSequence>(edits.begin(), edits.end()).size() == edits.size());
      for (const ContactSequence& edited : edits) {
        CHECK(edited.size() == sequence.size());
        CHECK(problem.rules.valid(edited));
        CHECK(edited != sequence);
        CHECK(edited.front() == sequence.front());
        CHECK(edited.back() == sequence.back());
      }
      CHECK(tail_edits(problem.rules, sequence) == edits);
    }
  }
  CHECK(found > 200);
}

TEST_CASE("all that follows a phase comes earlier or later, or with the feet exchanged") {
  const std::vector<ContactSequence> edits = tail_edits(kTwoFeet, walk(".a.b.a.b."));
  for (const char* expected : {".a.bb.a..",  // the last step left out, the second one in two phases
                               "..a.b.a..",  // the last step left out, the walk a phase later
                               ".a.b.b.a.",  // the feet exchanged after the second step
                               ".b.a.b.a."})
    CHECK_MESSAGE(contains(edits, walk(expected)), expected);
}

TEST_CASE("every valid sequence of the kind is found, and no other: all walks in six phases") {
  std::vector<ContactSequence> all{walk(".")};
  for (int k = 1; k <= 6; ++k) {
    std::vector<ContactSequence> longer;
    for (const ContactSequence& begun : all)
      for (const char state : {'.', 'a', 'b', 'f'}) {
        longer.push_back(begun);
        longer.back().push_back(walk(std::string(1, state)).front());
      }
    all = std::move(longer);
  }
  all.erase(std::remove_if(all.begin(), all.end(),
                           [](const ContactSequence& s) { return s.back() != s.front() || !kTwoFeet.valid(s); }),
            all.end());
  REQUIRE(all.size() > 50);
  for (const ContactSequence& from : all) {
    const std::vector<ContactSequence> edits = tail_edits(kTwoFeet, from);
    for (const ContactSequence& to : all)
      CHECK(contains(edits, to) == (to != from && (retimed(from, to) || exchanged(from, to))));
  }
}
