#pragma once

#include <Eigen/Core>
#include <vector>

#include "mcplan/plan/plan.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/robot/similarity.hpp"
#include "mcplan/scene/polygon.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan {

/// The prism of `thickness` [m] below a surface: what a swinging end-effector must not enter.
struct Solid {
  Polygon polygon;
  double thickness = 0.0;
};

/// One solid per surface, in the scene's order.
std::vector<Solid> solids_of(const Scene& scene);

/// Depth [m] of a point below the plane of the solid that holds it, the largest over all solids; 0 when in none.
double clearance_depth(const std::vector<Solid>& solids, const Eigen::Vector3d& point_W);

/// Frame of a sole that lies flat on a plane with this normal and heads to `yaw`: columns along
/// half_size[0], along half_size[1], normal. A heading along the normal (a foot on a wall) leaves the sole's direction
/// to the world's z.
Eigen::Matrix3d sole_frame(const Eigen::Vector3d& normal_W, double yaw);

/// The same depth for an end-effector at position_W: of the point and, with `whole_sole` and half_size above zero, of
/// the sole's four corners.
double clearance_depth(const std::vector<Solid>& solids, const EndEffector& end_effector,
                       const Eigen::Vector3d& position_W, const Eigen::Matrix3d& sole_W, bool whole_sole);

/// A stretch of phases in which an end-effector touches nothing, with the normals of what it leaves and reaches
/// (the world's z where the plan ends free, and where it starts so and does not say what the swing left).
struct FreeStretch {
  int first_phase = 0, end_phase = 0;  ///< phases first_phase .. end_phase - 1
  double start_s = 0.0, duration_s = 0.0;
  double before_s = 0.0;  ///< for which it has been under way where the plan starts, as begun_s() takes it
  Eigen::Vector3d lift_normal_W = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d land_normal_W = Eigen::Vector3d::UnitZ();

  /// s = 0..1 of the whole swing at so long [s] after the stretch has begun.
  double ratio(double since_start_s) const { return (before_s + since_start_s) / (before_s + duration_s); }

  /// The sole's normal there, whose length is not 1: it turns from the one to the other, and vanishes half way between
  /// opposite ones.
  Eigen::Vector3d normal(double s) const { return (1.0 - s) * lift_normal_W + s * land_normal_W; }
};

/// For how long a swing has been under way at the plan's start, as far as it counts [s]: what the plan says, which
/// nothing in it proves, and at most the robot's longest phase. Each second of it takes 0.1 s of the end of the swing
/// from what is looked at of a sole's corners.
double begun_s(const Swing& swing, const Robot& robot, const Similarity& similarity);

/// The free stretches of one end-effector, read from the contact sequence; how long one that the plan starts with has
/// been under way, and what it left, from the plan's swings. `robot` bounds the former; without it the plan's does.
std::vector<FreeStretch> free_stretches(const Plan& plan, const std::vector<Solid>& solids, int end_effector);
std::vector<FreeStretch> free_stretches(const Plan& plan, const std::vector<Solid>& solids, int end_effector,
                                        const Robot& robot, const Similarity& similarity);

/// Depth [m] at s = 0..1 of a swing. The sole turns from the one surface's normal to the other's; its corners count
/// in the middle 80 % of the time only, since a sole may overhang an edge where it lifts off and touches down.
double clearance_depth(const std::vector<Solid>& solids, const EndEffector& end_effector, const FreeStretch& stretch,
                       double s, const Eigen::Vector3d& position_W, double yaw);

}  // namespace mcplan
