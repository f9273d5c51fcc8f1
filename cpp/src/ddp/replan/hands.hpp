#pragma once

#include <vector>

#include "ddp/replan/rest.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan::ddp {

/// Sequences near to that of a rest which catch a push with a hand: one that the rest leaves free, on the side to which
/// the CoM is pushed (the velocity by which it is off what was planned [m/s]), touches the surface that is nearest to
/// it, before the next contact changes or after that, and lets go some phases later. None where all surfaces are out of
/// its reach, or the push is small, or a contact would change later that is to change within `committed_s`. In the
/// order in which they are tried.
std::vector<Rest> with_hands(const Rest& rest, const Scene& scene, const Robot& robot, const Eigen::Vector3d& pushed_W,
                             double committed_s, const Similarity& similarity);

}  // namespace mcplan::ddp
