#pragma once

#include <Eigen/Core>
#include <vector>

#include "ddp/problem.hpp"
#include "ddp/search.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

/// What stands low across the straight way and is stepped over: a pipe, a beam, a threshold. The search moves a
/// foothold by its costs, and of two that are on either side of such a solid it does not carry one over; so the ground
/// is cut there, and each piece is a surface. Theory: docs/theory/ddp.md, "Routes".
namespace mcplan::ddp {

/// A solid across the way, seen from above: between the edges where the straight line comes in and goes out.
struct Bar {
  int solid = -1;                                    ///< surface of the scene
  double near = 0.0, far = 0.0;                      ///< [m] from the start, along the way
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< [m] of the line there
  Eigen::Vector2d near_outward = middle, near_point = middle, far_outward = middle, far_point = middle;
};

/// Those that feet may not touch, from the start on: no higher above the ground than the feet of the robot can be
/// lifted, and so thin that a step leads over them. Empty where the feet of start or goal are not on their sides.
std::vector<Bar> bars_across(const Scene& scene, const Robot& robot, double sole_inside);

/// Cut the ground below each bar into what is before it, which keeps its name, and what is behind. `surfaces`: what
/// each surface of the scene is called elsewhere; pieces are called as the whole was.
void cut_at(const std::vector<Bar>& bars, const Robot& robot, Scene& scene, std::vector<int>& surfaces);

/// Contacts of a motion that name the first piece of what was cut come to name the piece that is there.
void name_pieces(const Problem& problem, const std::vector<int>& surfaces, Incumbent& motion);

}  // namespace mcplan::ddp
