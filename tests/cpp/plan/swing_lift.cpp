#include "plan/swing_lift.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "plan/fixtures.hpp"

using namespace fixtures;
using mcplan::SwingLift;

TEST_CASE("a lift starts and ends with zero rate and second derivative, and is 1 half way") {
  const double h = 1e-6;
  for (double s : {0.0, 1.0}) {
    CHECK(SwingLift(s).value() == 0.0);
    CHECK(SwingLift(s).rate() == 0.0);
    const double inside = std::abs(s - h);
    CHECK(std::abs(SwingLift(inside).rate()) / h < 2e-3);  // 1152 h
  }
  CHECK(SwingLift(0.5).value() == doctest::Approx(1.0).epsilon(1e-15));
  double largest = 0.0;
  for (int i = 1; i < 1000; ++i) {
    const double s = 1e-3 * i;
    const double difference = (SwingLift(s + h).value() - SwingLift(s - h).value()) / (2.0 * h);
    CHECK(SwingLift(s).rate() == doctest::Approx(difference).epsilon(1e-8).scale(1.0));
    largest = std::max(largest, SwingLift(s).rate());
  }
  CHECK(largest <= SwingLift::kMaxRate);
  CHECK(largest > 0.999 * SwingLift::kMaxRate);
}

TEST_CASE("the acceleration of end-effectors does not jump where contacts are broken and made") {
  const mcplan::Plan plan = walk();
  int looked_at = 0;
  for (const mcplan::Swing& swing : plan.swings) {
    const int first = swing.first_phase, last = swing.end_phase - 1, l = swing.end_effector;
    if (swing.height == 0.0) continue;
    const double duration = plan.phases[last].duration;
    double total = 0.0;
    for (int k = first; k <= last; ++k) total += plan.phases[k].duration;
    const auto rate = [&](double h) {  // of the velocity in the first and the last h seconds
      return std::max(plan.at_phase(first, h).end_effectors[l].velocity_W.norm(),
                      plan.at_phase(last, duration - h).end_effectors[l].velocity_W.norm()) /
             h;
    };
    const double of_squares = 32.0 * swing.height / (total * total);  // m/s^2 at the ends of a lift by 16 s^2 (1 - s)^2
    CHECK(rate(1e-4) < 0.02 * of_squares);
    CHECK(rate(1e-5) < 0.11 * rate(1e-4));
    ++looked_at;
  }
  CHECK(looked_at > 0);
}
