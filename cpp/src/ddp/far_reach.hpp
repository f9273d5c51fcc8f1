#pragma once

#include "mcplan/plan/plan.hpp"

namespace mcplan::ddp {

/// Whether an end-effector of the robot reaches further than it usually does.
bool has_far_reach(const Robot& robot);

/// Whether an end-effector that stands reaches further than it usually does, at a knot after the first: where a motion
/// starts is measured.
bool reaches_far(const Plan& plan);

}  // namespace mcplan::ddp
