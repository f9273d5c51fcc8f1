#include "ddp/far_reach.hpp"

#include <doctest/doctest.h>

#include "mcplan/ddp/plan.hpp"
#include "mcplan/mcplan.hpp"
#include "support.hpp"

namespace {

using namespace mcplan;

/// A curb of 0.09 m, so wide, across a floor: a sole of 0.2 m has to land behind it.
Scene over_curb(double width) {
  Scene scene =
      scenes::made_of("curb", {scenes::rectangle("floor", -2, 4, -1, 1, 0, "foot")}, "floor", "floor", {1.4, 0.0, 0.0});
  Surface curb = scenes::rectangle("curb", 0.5, 0.5 + width, -1, 1, 0.09, "hand");
  curb.thickness = 0.09;
  scene.surfaces.push_back(curb);
  return scene;
}

/// Largest distance along x between two feet that stand.
double longest_stride(const Plan& plan) {
  double longest = 0.0;
  for (std::size_t k = 0; k < plan.phases.size(); ++k)
    if (plan.phases[k].contacts[0].surface >= 0 && plan.phases[k].contacts[1].surface >= 0)
      longest =
          std::max(longest, std::abs(plan.knots[k].end_effectors_W[0].x() - plan.knots[k].end_effectors_W[1].x()));
  return longest;
}

}  // namespace

TEST_CASE("feet reach beyond what is usual of them where steps within it lead over no curb, and nowhere else") {
  const Robot robot = load_robot("talos");
  REQUIRE(ddp::has_far_reach(robot));
  const double usual = robot.end_effectors[0].usual_box().sizes().x();
  for (const auto& [scene, far] : {std::pair(over_curb(0.15), true), std::pair(scenes::flat(), false)}) {
    const PlanResult result = ddp::plan(scene, robot);
    REQUIRE(result.report.status == Status::solved);
    CHECK(ddp::reaches_far(result.plan) == far);
    CHECK((longest_stride(result.plan) > usual) == far);
    CHECK(result.plan.robot == robot);
  }
}

TEST_CASE("a robot whose usual reach is its box reaches no further") {
  Robot robot = load_robot("talos");
  for (EndEffector& end : robot.end_effectors) end.usual_reach = EndEffector().usual_reach;
  CHECK(!ddp::has_far_reach(robot));
  for (EndEffector& end : robot.end_effectors) end.usual_reach = {2.0 * end.reach_min_B.x(), 2.0 * end.reach_max_B.x()};
  CHECK(!ddp::has_far_reach(robot));
}

TEST_CASE("a plan reaches far where a foot stands beyond what is usual, after its start") {
  Plan plan = ddp::plan(scenes::flat(), load_robot("talos")).plan;
  REQUIRE(!ddp::reaches_far(plan));
  const double usual = plan.robot.end_effectors[0].usual_reach[1];
  plan.knots[0].end_effectors_W[0].x() = plan.knots[0].com_W.x() + usual + 0.05;
  CHECK(!ddp::reaches_far(plan));
  plan.knots[2].end_effectors_W[0].x() = plan.knots[2].com_W.x() + usual + 0.001;
  CHECK(!ddp::reaches_far(plan));
  REQUIRE(plan.phases[1].contacts[0].surface >= 0);
  plan.knots[2].end_effectors_W[0].x() = plan.knots[2].com_W.x() + usual + 0.05;
  CHECK(ddp::reaches_far(plan));
  plan.phases[1].contacts[0].surface = -1;
  CHECK(!ddp::reaches_far(plan));
}
