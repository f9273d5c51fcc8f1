#include "mcplan/plan/report.hpp"

#include <doctest/doctest.h>

using mcplan::Violation;

TEST_CASE("a violation reads as a sentence") {
  CHECK(Violation{"friction", 7, "left_foot", 2.61, 0.08, 0.001, ""}.to_string() ==
        "friction at left_foot in phase 7 (t = 2.61 s): 0.08 over the limit (tolerance 0.001)");
  CHECK(Violation{"slip", 3, "right_foot", 1.2, 0.002, 0.001, "m"}.to_string() ==
        "slip at right_foot in phase 3 (t = 1.2 s): 0.002 m over the limit (tolerance 0.001)");
}

TEST_CASE("a margin is told from an excess") {
  CHECK(Violation{"reach", 0, "left_hand", 0.0, -0.0278, 0.001, "m"}.to_string() ==
        "reach at left_hand in phase 0 (t = 0 s): 0.0278 m below the limit");
}

TEST_CASE("a violation without a place leaves it out") {
  CHECK(Violation{"sequence_rule", -1, "", 0.0, 0.0, 0.0, "contacts"}.to_string() ==
        "sequence_rule: 0 contacts over the limit (tolerance 0)");
}
