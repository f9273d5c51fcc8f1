#pragma once

#include "mcplan/plan/plan.hpp"
#include "mcplan/robot/similarity.hpp"

namespace mcplan {

/// What takes a robot of this size to one of human size; exact where the factors are powers of two.
Similarity inverse(const Similarity& s);

/// The scene and the robot with every number times the factors of its units: dynamically similar, if both are taken.
/// Swing height and durations that nobody has set stay so (by_size()).
Scene scaled(const Scene& scene, const Similarity& by);
Robot scaled(const Robot& robot, const Similarity& by);

/// A state, and the motion of a plan, likewise. The plan's scene and robot stay what they are: the caller has those of
/// the other size.
Knot scaled(const Knot& knot, const Similarity& by);
Plan scaled_motion(const Plan& plan, const Similarity& by);

}  // namespace mcplan
