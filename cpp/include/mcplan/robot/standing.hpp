#pragma once

#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan {

/// Whether some force in the friction cone of a valid surface points up, or the surface can be held.
bool holds_up(const Surface& surface);

/// Throws InvalidScene where the robot cannot stand at the start or the goal: an end-effector would have to reach more
/// than a quarter of the CoM's height beyond its box for its surface, or all surfaces that the stance names face so far
/// down that no force on them holds anything up; or where scene or robot are not valid (InvalidRobot).
void require_standing(const Scene& scene, const Robot& robot);

}  // namespace mcplan
