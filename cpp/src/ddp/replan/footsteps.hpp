#pragma once

#include <array>
#include <vector>

#include "ddp/replan/round_solids.hpp"
#include "ddp/replan/under_feet.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

/// Ways on two feet, foothold by foothold.
namespace mcplan::ddp {

/// Where a foot stands.
struct Foothold {
  int surface = kFree;
  Eigen::Vector3d place_W = Eigen::Vector3d::Zero();  ///< [m]
  double yaw = 0.0;                                   ///< [rad] heading of the sole
};

/// A step: one of the two feet, and where it lands.
struct Footstep {
  int foot = 0;
  Foothold onto;
};

/// Where two feet stand, or are about to land, and where they are to stand.
struct Walk {
  std::array<int, 2> feet = {};   ///< end-effectors
  std::array<Foothold, 2> from;   ///< of a foot in the air: where it is
  std::array<Foothold, 2> to;     ///< the goal's
  int first = 0;                  ///< of the two: who steps first; a foot in the air has to
  std::vector<Foothold> offered;  ///< where the first step may be made besides
  double elsewhere = 0.0;         ///< [1/CoM heights] price of a first step by how far it is from the first of these
  const RoundSolids* round = nullptr;  ///< given where there is a route
  Route route;                         ///< round what is in the way; empty: straight on
};

/// The cheapest alternating steps that lead there over the surfaces that the feet may touch, with strides up to a ratio
/// of what boxes of reach allow; empty where there are none. A* over footholds: those of the goal, those offered,
/// and on each surface near to the foot that stands the places that are nearest to a few strides. Along a route the
/// middle of the feet stays where there is room for the trunk, and feet turn with it.
std::vector<Footstep> footsteps(const Walk& walk, const Scene& scene, const Robot& robot, double ratio);

}  // namespace mcplan::ddp
