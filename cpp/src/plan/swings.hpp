#pragma once

#include "mcplan/plan/plan.hpp"

namespace mcplan {

/// Fill plan.swings from its contact sequence: one for every stretch of phases in which an end-effector is free, with
/// the normals of what it leaves and reaches, and of a few heights around robot.swing_height the first that clears the
/// scene (the one that goes in least, if none does). An end-effector that neither leaves nor reaches a surface gets
/// height 0, and so does one that is on its way at a measured start, if that clears the scene. Without `heights` the
/// others have the robot's, clear or not, which takes no time. Throws InvalidPlan where the rest of the plan does not
/// fit together.
void choose_swings(Plan& plan, bool heights = true);

}  // namespace mcplan
