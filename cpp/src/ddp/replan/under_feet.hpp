#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "ddp/contact_sequence.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

/// Where end-effectors find ground.
namespace mcplan::ddp {

inline bool is_foot(const Robot& robot, int e) { return robot.end_effectors[e].kind == "foot"; }

/// A vector in the ground plane, turned to the left by an angle [rad].
inline Eigen::Vector2d turned(const Eigen::Vector2d& v, double yaw) {
  return {std::cos(yaw) * v.x() - std::sin(yaw) * v.y(), std::sin(yaw) * v.x() + std::cos(yaw) * v.y()};
}

/// A surface, and the place on it that is nearest to where an end-effector is wanted.
struct Found {
  int surface = kFree;
  Eigen::Vector3d place_W = Eigen::Vector3d::Zero();          ///< [m]
  double distance = std::numeric_limits<double>::infinity();  ///< [m] of the place from where it is wanted
};

/// All surfaces that an end-effector may touch, nearest to a place [m] first; equally near ones in the scene's order.
std::vector<Found> grounds_near(const Scene& scene, const EndEffector& end, const Eigen::Vector3d& desired_W);

/// The nearest of them on which nothing lies, or else the nearest; kFree where there is none.
Found ground_at(const Scene& scene, const EndEffector& end, const Eigen::Vector3d& desired_W);

}  // namespace mcplan::ddp
