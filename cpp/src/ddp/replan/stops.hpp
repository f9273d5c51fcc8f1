#pragma once

#include <vector>

#include "ddp/replan/rest.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/robot/similarity.hpp"
#include "mcplan/scene/scene.hpp"

/// What to do where the planned contacts are not to be had any more.
namespace mcplan::ddp {

/// Whether the rest has end-effectors on surfaces that they may not touch (any more).
bool stands_on_what_is_gone(const Rest& rest, const Scene& scene, const Robot& robot);

/// The rest with other surfaces where it has end-effectors on surfaces that they may not touch (any more): for each of
/// these contacts the surface that is nearest to its foothold. False: there was nothing to change, or nothing else.
bool stand_on_others(Rest& rest, const Scene& scene, const Robot& robot);

/// Ways to come to a stand at once, from a rest that begins with the measured contacts: feet in the air land, near to
/// where they were about to or to where they are now, and stay there. None where no foot stands.
std::vector<Rest> stops(const Rest& rest, const Scene& scene, const Robot& robot, const Similarity& similarity);

}  // namespace mcplan::ddp
