#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "mcplan/plan/checker.hpp"
#include "plan/fixtures.hpp"

TEST_CASE("the CoM is no faster than the robot's, within what its speed at start and goal may be off") {
  mcplan::Plan plan = fixtures::walk();
  double fastest = 0.0;
  for (double t = 0.0; t <= plan.duration(); t += 1e-3) fastest = std::max(fastest, plan.at(t).com_velocity_W.norm());
  const double tolerance = mcplan::Tolerances().boundary;
  for (const double max : {fastest, fastest - 0.9 * tolerance}) {
    plan.robot.max_com_speed = max;
    CHECK(mcplan::check(plan, plan.scene, plan.robot).ok());
  }
  plan.robot.max_com_speed = fastest - 1.1 * tolerance;
  const mcplan::CheckResult result = mcplan::check(plan, plan.scene, plan.robot);
  REQUIRE(result.violations().size() == 1);
  const mcplan::Violation violation = result.violations().front();
  CHECK(violation.name == "com_speed");
  CHECK(violation.unit == "m/s");
  CHECK(violation.value == doctest::Approx(1.1 * tolerance).epsilon(1e-3));
  CHECK(plan.at(violation.time_s).com_velocity_W.norm() == doctest::Approx(fastest).epsilon(1e-3));
}
