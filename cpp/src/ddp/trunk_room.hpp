#pragma once

#include <algorithm>

#include "mcplan/robot/robot.hpp"

namespace mcplan::ddp {

/// Distance [m] from the line of a part of the trunk at which solids are kept: bodies are boxes rather than round,
/// whose edges are sqrt(2) radii away, and 0.05 heights of the CoM are left at least. Chosen.
inline double room_about(const TrunkPart& part, const Robot& robot) {
  return part.radius + std::max(0.4 * part.radius, 0.05 * robot.com_height);
}

}  // namespace mcplan::ddp
