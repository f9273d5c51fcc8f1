#pragma once

#include "mcplan/rhp/options.hpp"
#include "mcplan/rhp/receding_horizon.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan::rhp {

/// CoM, angular momentum, footholds, timing and forces of a walk over the steps of a scene, horizon by horizon. The
/// walk is solved if its report says so: the checker has then accepted the plan. Throws InvalidScene, also where
/// the robot cannot stand at the start or the goal, InvalidRobot or InvalidOptions. RecedingHorizon is the planner
/// behind it, for other sequences, single cycles and measured states.
Walk walk(const Scene& scene, const Robot& robot, const Options& options = {});

}  // namespace mcplan::rhp
