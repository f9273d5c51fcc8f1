#pragma once

#include <vector>

#include "ddp/ground.hpp"
#include "ddp/routes.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan::ddp {

/// Ways on from a stance round solids that the trunk would walk into.
class RoundSolids {
 public:
  /// `from` stands where a push may have left it: nearer to solids, too, than a walk begins.
  RoundSolids(const Scene& scene, const Robot& robot, const ResolvedStance& from, const ResolvedStance& to);

  /// Cheapest first; empty where no solid is in the way straight on, and where nothing leads there.
  const std::vector<Route>& routes() const { return routes_; }

  /// Whether there is room for the trunk above this point of the ground [m].
  bool is_free(const Eigen::Vector3d& at_W) const;

 private:
  Ground ground_;
  double room_ = 1.0;  // at the stance, over what a walk keeps from solids
  std::vector<Route> routes_;
};

/// What is left of a route.
class AlongRoute {
 public:
  /// `yaw` [rad]: the heading at its end. `spacing` [m] of the points that it is followed by.
  AlongRoute(const Route& route, double yaw, double spacing);

  struct Point {
    Eigen::Vector3d at_W = Eigen::Vector3d::Zero();  ///< [m]
    double yaw = 0.0;                                ///< [rad] of the base
    Eigen::Vector2d left = Eigen::Vector2d::Zero();  ///< [m] to go on from there, ahead and aside as the base looks
  };
  const Point& nearest(const Eigen::Vector3d& at_W) const;

 private:
  std::vector<Point> points_;
};

}  // namespace mcplan::ddp
