#include "ddp/tail_edits.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "edit_cases.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

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
  CHECK(check_edits(tail_edits, 10, 22) > 200);
}

TEST_CASE("all that follows a phase comes earlier or later, or with the feet exchanged") {
  const std::vector<ContactSequence> edits = tail_edits(two_feet(), walk(".a.b.a.b."));
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
                           [](const ContactSequence& s) { return s.back() != s.front() || !two_feet().valid(s); }),
            all.end());
  REQUIRE(all.size() > 50);
  for (const ContactSequence& from : all) {
    const std::vector<ContactSequence> edits = tail_edits(two_feet(), from);
    for (const ContactSequence& to : all)
      CHECK(contains(edits, to) == (to != from && (retimed(from, to) || exchanged(from, to))));
  }
}
