#include "mcplan/planar/sip/plan.hpp"

#include <doctest/doctest.h>

#include "slow_build.hpp"
#include "tasks.hpp"

TEST_CASE("a task is planned as by the planner behind it") {
  const mcplan::PlanarTask task = planar_tasks::cartwheel();
  mcplan::sip::Options options;
  options.max_iterations = kSlowBuild ? 2 : 5;
  const mcplan::sip::Result result = mcplan::sip::plan(task, options);
  CHECK(result.parameters > 0);
  CHECK(result.plan.control_points == mcplan::sip::Planner(task, options).solve().plan.control_points);
}
