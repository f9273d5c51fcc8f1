#include "mcplan/base/error.hpp"

#include <doctest/doctest.h>

using namespace mcplan;

TEST_CASE("an error names field, rule and value") {
  const InvalidScene error("surfaces[3].vertices", "needs at least 3 points", text(2));
  CHECK(std::string(error.what()) == "surfaces[3].vertices: needs at least 3 points, got 2");
  CHECK(error.field() == "surfaces[3].vertices");
  CHECK(error.rule() == "needs at least 3 points");
  CHECK(error.value() == "2");
}

TEST_CASE("typed errors are caught as bad input") {
  CHECK_THROWS_AS(throw InvalidScene("a", "b", "c"), InvalidInput);
  CHECK_THROWS_AS(throw InvalidRobot("a", "b", "c"), InvalidInput);
  CHECK_THROWS_AS(throw InvalidOptions("a", "b", "c"), InvalidInput);
  CHECK_THROWS_AS(throw InvalidPlan("a", "b", "c"), std::invalid_argument);
}

TEST_CASE("values are written short") {
  CHECK(text(0.25) == "0.25");
  CHECK(text(-3) == "-3");
  CHECK(text(1234567.0) == "1234567");
  CHECK(text(1234567.25) == "1.23457e+06");
  CHECK(text(1e20) == "1e+20");
  CHECK(text(std::string("stares")) == "\"stares\"");
  CHECK(text(std::string("a \"b\"\\")) == "\"a \\\"b\\\"\\\\\"");
  CHECK(text(Eigen::Vector3d(1, 0.5, -2)) == "[1, 0.5, -2]");
  CHECK(text(Eigen::Vector2d(1234567, 0.5)) == "[1234567, 0.5]");
  CHECK(text(Eigen::VectorXd()) == "[]");
}

TEST_CASE("checks are all made, and what they find is thrown together") {
  mcplan::Validation<mcplan::InvalidScene> check;
  CHECK(check([] {}));
  CHECK_FALSE(check([] { throw mcplan::InvalidScene("a", "must be 1", "2"); }));
  CHECK_FALSE(check([] { throw mcplan::InvalidScene("b", "must be 3", "4"); }));
  try {
    check.raise();
    FAIL("nothing was thrown");
  } catch (const mcplan::InvalidScene& found) {
    CHECK(found.field() == "a");
    REQUIRE(found.others().size() == 1);
    CHECK(found.others()[0].field() == "b");
    CHECK(found.others()[0].value() == "4");
  }
  CHECK_NOTHROW(mcplan::Validation<mcplan::InvalidScene>().raise());
}
