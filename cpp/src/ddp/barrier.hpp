#pragma once

#include <string>

#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan::ddp {

/// What stands between start and goal that no level step leads over and no ground leads round, in words: a wall, a step
/// or a drop that is too high. Empty where ground leads to the goal, or only a gap is in the way. It is no proof that
/// there is no plan, since jumps, hands and tilted bases reach farther: it says why a search may have failed.
/// `sole_inside` is the search's option.
std::string what_bars(const Scene& scene, const Robot& robot, double sole_inside = -1.0);

}  // namespace mcplan::ddp
