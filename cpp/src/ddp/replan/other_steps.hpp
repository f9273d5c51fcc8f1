#pragma once

#include <vector>

#include "ddp/replan/rest.hpp"
#include "mcplan/robot/robot.hpp"

namespace mcplan::ddp {

/// Sequences near to that of a rest which catch a push that it cannot: a step more, now or after the one under way, by
/// each of the feet. In the order in which they are tried.
std::vector<Rest> other_steps(const Rest& rest, const Robot& robot, const Similarity& similarity);

}  // namespace mcplan::ddp
