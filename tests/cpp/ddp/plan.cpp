#include "mcplan/ddp/plan.hpp"

#include <doctest/doctest.h>

#include "mcplan/ddp/switched_ddp.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/plan/plan_files.hpp"
#include "mcplan/robot/robot_files.hpp"
#include "mcplan/scene/scene_files.hpp"

TEST_CASE("a built-in scene is planned as by the planner behind it") {
  const mcplan::Scene scene = mcplan::load_scene("flat");
  const mcplan::Robot robot = mcplan::load_robot("humanoid44");
  const mcplan::PlanResult result = mcplan::ddp::plan(scene, robot);
  CHECK(result.report.status == mcplan::Status::solved);
  CHECK(mcplan::check(result.plan, scene, robot).ok());
  CHECK(result.plan == mcplan::ddp::SwitchedDdp(scene, robot).solve().plan);
}
