#include "mcplan/plan/loads.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "mcplan/base/error.hpp"
#include "plan/fixtures.hpp"
#include "plan/wrench_fixtures.hpp"

TEST_CASE("loads are the largest values of Plan::at_phase") {
  const mcplan::Plan plan = fixtures::walk();
  const mcplan::Loads found = mcplan::loads(plan, 0.001);
  std::map<int, double> forces;
  double momentum = 0.0;
  for (int k = 0; k < static_cast<int>(plan.phases.size()); ++k)
    for (int i = 0; i <= 1000; ++i) {
      const mcplan::PlanState state = plan.at_phase(k, plan.phases[k].duration * i / 1000);
      momentum = std::max(momentum, state.angular_momentum_W.norm());
      for (int l = 0; l < plan.end_effector_count(); ++l)
        if (state.end_effectors[l].surface >= 0)
          forces[l] =
              std::max(forces[l], state.end_effectors[l].force_W.norm() / (plan.robot.mass * plan.scene.gravity));
    }
  CHECK(found.angular_momentum == doctest::Approx(momentum));
  REQUIRE(found.contacts.size() == forces.size());
  for (const mcplan::ContactLoad& load : found.contacts)
    CHECK(load.force == doctest::Approx(forces.at(load.end_effector)).epsilon(1e-4));
}

TEST_CASE("loads refuse what they cannot look at") {
  mcplan::Plan plan = fixtures::walk();
  CHECK_THROWS_AS(mcplan::loads(plan, 0.0), mcplan::InvalidOptions);
  plan.knots.pop_back();
  CHECK_THROWS_AS(mcplan::loads(plan), mcplan::InvalidPlan);
}
