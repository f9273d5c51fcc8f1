#include "mcplan/plan/report.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

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
  CHECK(Violation{"sequence_rule", -1, "", 0.0, 2.0, 0.0, "contacts"}.to_string() ==
        "sequence_rule: 2 contacts over the limit (tolerance 0)");
}

TEST_CASE("what the checker accepts is not called over the limit") {
  CHECK(Violation{"orientation", 3, "", 1.2, 0.0017, 0.0175, "rad"}.to_string() ==
        "orientation in phase 3 (t = 1.2 s): 0.0017 rad, within tolerance (0.0175)");
  CHECK(Violation{"friction", 7, "left_foot", 2.61, 0.001, 0.001, ""}.to_string() ==
        "friction at left_foot in phase 7 (t = 2.61 s): 0.001, within tolerance (0.001)");
}

TEST_CASE("nothing beyond the limit is at the limit") {
  CHECK(Violation{"sequence_rule", -1, "", 0.0, 0.0, 0.0, "contacts"}.to_string() == "sequence_rule: at the limit");
  CHECK(Violation{"slip", 3, "right_foot", 1.2, 0.0, 0.001, "m"}.to_string() ==
        "slip at right_foot in phase 3 (t = 1.2 s): at the limit");
}

TEST_CASE("amounts far from one are written with a prefix of their unit, their tolerance likewise") {
  const auto tail = [](double value, double tolerance, const char* unit) {
    return Violation{"x", -1, "", 0.0, value, tolerance, unit}.to_string();
  };
  CHECK(tail(0.000464, 0.005, "m") == "x: 0.464 mm, within tolerance (5 mm)");
  CHECK(tail(2.1e-5, 3.90625e-6, "m") == "x: 21 um over the limit (tolerance 3.91 um)");
  CHECK(tail(4.31e6, 1e-6, "N") == "x: 4.31 MN over the limit (tolerance 1 uN)");
  CHECK(tail(0.002, 6.25e-5, "m") == "x: 0.002 m over the limit (tolerance 62.5 um)");
  CHECK(tail(-1750.0, 1e-3, "N m") == "x: 1.75 kN m below the limit");
  CHECK(tail(2e-8, 1e-8, "rad/s") == "x: 20 nrad/s over the limit (tolerance 10 nrad/s)");
  CHECK(tail(3e-5, 0.0, "s") == "x: 30 us over the limit (tolerance 0)");
  // No prefix for counts, ratios and compound units, whose number keeps its exponent.
  CHECK(tail(2e-5, 1e-8, "of the weight") == "x: 2e-05 of the weight over the limit (tolerance 1e-08)");
  CHECK(tail(2e-5, 1e-8, "kg m^2/s") == "x: 2e-05 kg m^2/s over the limit (tolerance 1e-08)");
  CHECK(tail(1e-300, 0.0, "m") == "x: 1e-300 m over the limit (tolerance 0)");
}

TEST_CASE("no excess, however small or large, is written as zero") {
  for (const char* unit : {"m", "N", "rad", "", "1/s^2"})
    for (int exponent = -320; exponent <= 308; ++exponent) {
      const double value = std::pow(10.0, exponent);
      if (value == 0.0) continue;
      const std::string text = Violation{"x", -1, "", 0.0, value, 0.5 * value, unit}.to_string();
      INFO(text);
      CHECK(text.find("x: 0 ") == std::string::npos);
      CHECK(text.find("over the limit") != std::string::npos);
    }
}
