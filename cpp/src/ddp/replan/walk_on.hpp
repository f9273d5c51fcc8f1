#pragma once

#include "ddp/replan/rest.hpp"
#include "mcplan/ddp/replan.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan::ddp {

/// Walk on at a velocity: steps are added at the end of the rest until it has `phases` phases, the ends of which are
/// where the command leads; all that is not under way is to follow it. The scene's goal becomes a stance at the end, so
/// that every plan ends at rest. Without ground there the way is cut short, and no stride gets longer than legs reach:
/// the ratio of the command that is followed is returned.
double walk_on(Rest& rest, Scene& scene, const Robot& robot, const VelocityCommand& command, int phases);

/// Come to rest over the feet where the rest has them at its end: that is what is desired, and the scene's goal.
void stay(Rest& rest, Scene& scene, const Robot& robot);

}  // namespace mcplan::ddp
