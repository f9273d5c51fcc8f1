#include "ddp/edits.hpp"

#include <doctest/doctest.h>

#include "edit_cases.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

}  // namespace

TEST_CASE("edits are valid, new, different, and keep start and goal") { CHECK(check_edits(swing_edits, 18, 21) > 200); }

TEST_CASE("a swing is shifted, left out, handed over and exchanged") {
  const ContactSequence now = walk("..a...b...");
  const std::vector<ContactSequence> edits = swing_edits(two_feet(), now);
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
  CHECK(swing_edits(two_feet(), walk("......")).empty());
  CHECK(swing_edits(two_feet(), {{kFree, 0}, {kFree, 0}, {0, 0}, {0, 0}}).empty());
  CHECK(swing_edits(two_feet(), {{0, 0}, {0, 0}, {kFree, 0}, {kFree, 0}}).empty());
}
