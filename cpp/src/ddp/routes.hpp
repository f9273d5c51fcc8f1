#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

/// Ways over the ground on foot, from the start of a scene to its goal, for the search to begin with: it improves a
/// walk, and does not come from one that goes through a hole to one round it. Theory: docs/theory/ddp.md, "Routes".
namespace mcplan::ddp {

/// Points [m] of the ground below the CoM, from the start to the goal; empty: the straight line.
using Route = std::vector<Eigen::Vector3d>;

/// What stands on the straight line beyond the last place to which ground leads from the start. Surfaces are the
/// scene's.
struct Barrier {
  int solid = -1;          ///< that the trunk would walk into; -1: the next ground is too high or too low for a step
  int from = -1, to = -1;  ///< ground before it and there
  double height = 0.0;     ///< [m] of `from` there
  double rise = 0.0;       ///< [m] from `from` to `to`, negative downwards
  double step = 0.0;       ///< [m] the highest that the robot makes
};

/// What is known of the ground between start and goal.
struct Routes {
  bool straight = true;     ///< steps lead along the straight line
  bool obstructed = false;  ///< or would, were there not a solid that the trunk would walk into
  /// Where they do not, or climb: ways round, the cheapest one first; there may be none.
  std::vector<Route> detours;
  std::optional<Barrier> barrier;  ///< why none of these leads to the goal, where it is no gap
};

/// Looks for up to three detours, on different sides of what is in the way; where that can be climbed, for up to two on
/// ground so level that nothing is. Of scenes where nothing stands at both start and goal nothing is known: they are
/// straight. `sole_inside` is the search's option.
Routes find_routes(const Scene& scene, const Robot& robot, double sole_inside = -1.0);

/// The same between two stances.
Routes find_routes(const Scene& scene, const Robot& robot, const ResolvedStance& from, const ResolvedStance& to,
                   double sole_inside);

/// Point at this share of a route's length. Its corners are rounded, its ends are not.
Eigen::Vector3d point_on(const Route& route, double share);

/// How far [rad] the base turns there from where it would look straight on: with the route, by a quarter turn at most,
/// and not at its ends. Nothing on the straight line or little beside it.
double turn_on(const Route& route, double share);

}  // namespace mcplan::ddp
