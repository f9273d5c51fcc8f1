#include "model/read.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>

namespace {

using mcplan::Range;
using namespace mcplan::model;

struct Sample {
  double number = 1.0;
  Range range{1.0, 2.0};
};

constexpr auto number() { return field("number", &Sample::number, "", ""); }
constexpr auto range() { return field("range", &Sample::range, "", ""); }

/// The rule that a number breaks as a message says it, "" where it breaks none.
template <class F>
std::string rule(const F& f, typename F::Member value) {
  const Place top;
  Findings found;
  check_value(value, f.rules, Place(top, f.key), found);
  try {
    found.raise<mcplan::InvalidOptions>();
  } catch (const mcplan::InvalidOptions& error) {
    CHECK(error.field() == f.key);
    return error.rule();
  }
  return "";
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("an interval is told with both ends, those that are out in round brackets") {
  for (double good : {3.0, 5.0, 12.0}) CHECK(rule(number().within(3, 12), good) == "");
  for (double bad : {2.0, 12.5, kNan, kInf, -kInf}) CHECK(rule(number().within(3, 12), bad) == "must lie in [3, 12]");
  CHECK(rule(number().within(0, 1).above(0), 0.0) == "must lie in (0, 1]");
  CHECK(rule(number().within(0, 0.5).below(0.5), 0.5) == "must lie in [0, 0.5)");
  CHECK(rule(number().within(1, 1e6), 0.0) == "must lie in [1, 1000000]");
}

TEST_CASE("one bound is told alone") {
  CHECK(rule(number().below(2), 2.0) == "must be less than 2");
  CHECK(rule(number().at_most(2), 2.5) == "must be at most 2");
  CHECK(rule(number().above(1), 1.0) == "must be greater than 1");
  CHECK(rule(number().positive(), 0.0) == "must be a positive number");
  CHECK(rule(number().positive().or_infinite(), kNan) == "must be a positive number");
  CHECK(rule(number().or_infinite(), kNan) == "must be a number");
  CHECK(rule(number(), kInf) == "must be a finite number");
}

TEST_CASE("a range has its ends in order and within its bounds") {
  CHECK(rule(range().positive(), {1.0, 1.0}) == "");
  for (const Range& bad : {Range{2.0, 1.0}, Range{0.0, 1.0}, Range{1.0, kInf}, Range{kNan, 1.0}, Range{1.0, kNan}})
    CHECK(rule(range().positive(), bad) == "must be two positive numbers, the second not smaller");
  CHECK(rule(range().positive().growing(), {1.0, 1.0}) == "must be two positive numbers, the second larger");
  CHECK(rule(range(), {-1.0, -2.0}) == "must be two numbers, the second not smaller");
}
