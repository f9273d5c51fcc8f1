#pragma once

#include <string>

#include "ddp/routes.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan::ddp {

/// In words, what stands between start and goal that no level step leads over and no ground leads round: a wall, a step
/// or a drop that is too high. It is no proof that there is no plan, since jumps, hands and tilted bases reach farther:
/// it says why a search may have failed.
std::string text_of(const Barrier& barrier, const Scene& scene, const std::string& robot_name);

}  // namespace mcplan::ddp
