#pragma once

#include "mcplan/robot/robot.hpp"

namespace mcplan::ddp {

/// Distance [m] from the line of a part of the trunk at which solids are kept: bodies are boxes rather than round.
/// Chosen: with 0.4 radii more the shoulders of TALOS, 0.75 m wide, pass no door of 0.8 m.
inline double room_about(const TrunkPart& part) { return 1.25 * part.radius; }

}  // namespace mcplan::ddp
