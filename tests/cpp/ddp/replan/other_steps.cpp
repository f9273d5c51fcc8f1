#include "ddp/replan/other_steps.hpp"

#include <doctest/doctest.h>

#include "mcplan/ddp/plan.hpp"
#include "scenes.hpp"

namespace {

using namespace mcplan;
using namespace mcplan::ddp;

}  // namespace

TEST_CASE("other steps put swings in place in, and leave the rest in its order") {
  const Plan plan = ddp::plan(scenes::flat(), scenes::humanoid44()).plan;
  const Similarity human = similarity_of(plan.robot, plan.scene.gravity);
  for (const double t : {0.1, 0.9, 1.4, 2.2, 3.1}) {
    CAPTURE(t);
    const Rest rest = rest_of(plan, t);
    const std::vector<Rest> others = other_steps(rest, plan.robot, human);
    CHECK(!others.empty());
    for (const Rest& other : others) {
      const int added = other.size() - rest.size();
      CHECK((added == 2 || added == 4));
      // Without what was put in, it is the rest again.
      Rest back = other;
      int first = 0;
      while (first < other.size() && other.planned[first]) ++first;
      for (int i = 0; i < added; ++i) {
        CHECK_FALSE(back.planned[first]);
        back.plan.phases.erase(back.plan.phases.begin() + first);
        back.planned.erase(back.planned.begin() + first);
      }
      for (int k = 0; k <= rest.size(); ++k) CHECK(back.contacts(k) == rest.contacts(k));
      // One contact changes at a time.
      for (int k = 1; k <= other.size(); ++k) {
        int changes = 0;
        for (int e = 0; e < plan.end_effector_count(); ++e) changes += other.surface(k, e) != other.surface(k - 1, e);
        CHECK(changes <= 1);
      }
    }
  }
}
