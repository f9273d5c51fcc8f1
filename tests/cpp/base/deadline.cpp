#include "mcplan/base/deadline.hpp"

#include <doctest/doctest.h>

#include "clocks.hpp"

using mcplan::Deadline;

TEST_CASE("a deadline passes when its clock has gone on by the limit") {
  const CountingClock clock;
  clock.advance(7.0);  // a clock may begin anywhere
  const Deadline deadline(2.0, clock);
  CHECK(deadline.elapsed_s() == 0.0);
  clock.advance(1.5);
  CHECK_FALSE(deadline.passed());
  CHECK(deadline.remaining_s() == doctest::Approx(0.5));
  clock.advance(0.5);
  CHECK(deadline.passed());
  CHECK(deadline.elapsed_s() == doctest::Approx(2.0));
}

TEST_CASE("time reserved for the end is taken off the limit, never more than half of it") {
  const CountingClock clock;
  const Deadline whole(1.0, clock);
  clock.advance(0.25);
  const Deadline early = whole.reserving(0.2), late = whole.reserving(5.0);
  CHECK(early.remaining_s() == doctest::Approx(0.55));  // the beginning is the same
  CHECK(late.remaining_s() == doctest::Approx(0.25));
  CHECK(early.elapsed_s() == whole.elapsed_s());
}

TEST_CASE("without a limit no time is enough") {
  const CountingClock clock;
  const Deadline never(std::numeric_limits<double>::infinity(), clock);
  clock.advance(1e12);
  CHECK_FALSE(never.passed());
  CHECK_FALSE(never.reserving(1.0).passed());
  CHECK_FALSE(never.limited());
}

TEST_CASE("the steady clock goes on") {
  const Deadline deadline(1e-9);
  double before = deadline.elapsed_s();
  for (int i = 0; i < 1000; ++i) {
    const double now = deadline.elapsed_s();
    CHECK(now >= before);
    before = now;
  }
  CHECK(deadline.passed());
}
