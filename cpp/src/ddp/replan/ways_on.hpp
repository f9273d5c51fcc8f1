#pragma once

#include <vector>

#include "ddp/replan/rest.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan::ddp {

/// So many ways to the goal are tried. Chosen: each takes as long as the plan's own sequence.
constexpr std::size_t kWaysTried = 3;

/// Whether the feet of a rest are elsewhere at its end than at the scene's goal.
bool ends_elsewhere(const Rest& rest, const Scene& scene, const Robot& robot);

/// Walks of a robot on two feet from what a rest begins with to the scene's goal, over the surfaces that are there:
/// a foot in the air lands, near to where it was about to, or elsewhere in the last of them, and then one steps after
/// the other. Fewest steps first, by either foot, then with shorter strides. Of what lies ahead in the rest only that
/// landing is looked at. None where no foot stands; no more are looked for than are tried.
std::vector<Rest> ways_on(const Rest& rest, const Scene& scene, const Robot& robot, const Similarity& similarity);

}  // namespace mcplan::ddp
