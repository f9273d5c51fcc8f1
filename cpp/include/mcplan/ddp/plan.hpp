#pragma once

#include "mcplan/ddp/options.hpp"
#include "mcplan/plan/plan.hpp"
#include "mcplan/plan/report.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan::ddp {

/// Contact sequence, timing, CoM and forces from the start of a scene to its goal, by switched differential dynamic
/// programming. The plan is solved if the result's report says so: the checker has then accepted it. Throws
/// InvalidScene, also where the robot cannot stand at the start or the goal, InvalidRobot or InvalidOptions.
/// SwitchedDdp is the planner behind it, for warm starts and measured states.
PlanResult plan(const Scene& scene, const Robot& robot, const Options& options = {});

/// The same plan on ground that is whole, as plan() searches it: surfaces in one plane that touch, and make a convex
/// one together, are one, with the name of the first. Replans keep soles within surfaces; on this they may cross seams.
/// Throws InvalidPlan, InvalidScene.
Plan on_joined_ground(const Plan& plan);

}  // namespace mcplan::ddp
