#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

namespace mcplan {

/// A flat patch of the world that end-effectors may touch.
struct Surface {
  std::string name;
  std::vector<Eigen::Vector3d> vertices_W;  ///< [m] convex, coplanar, counter-clockwise about the outward normal
  double friction = 0.7;                    ///< Coulomb coefficient [-]
  bool grasp = false;                       ///< may be held: no friction cone, the force cap of the end-effector only
  std::vector<std::string> end_effectors;   ///< names or kinds ("foot", "hand") that may touch it; empty: all
  double thickness = 0.05;                  ///< [m] solid below the surface that swinging end-effectors must clear
};

/// Where the robot is at the start or the goal. Heights come from the robot: the CoM is robot.com_height above
/// position_W, the end-effectors take the robot's nominal stance, turned by yaw and put onto their surfaces.
struct Stance {
  Eigen::Vector3d position_W = Eigen::Vector3d::Zero();  ///< [m] point of the ground below the CoM
  double yaw = 0.0;                                      ///< heading [rad]
  std::map<std::string, std::string> contacts;           ///< end-effector (or kind) -> surface; a name beats its kind
};

/// "If none of `when_free` is in contact, all of `require` must be." Names or kinds of end-effectors.
struct ContactRule {
  std::vector<std::string> when_free;
  std::vector<std::string> require;
};

/// One step of a walk: the foot that swings and the surface on which it lands.
struct Step {
  std::string end_effector;
  std::string surface;
};

/// The world: surfaces, start and goal. World frame W with z up.
struct Scene {
  std::string name;
  std::string description;
  double gravity = 9.81;  ///< [m/s^2]
  std::vector<Surface> surfaces;
  Stance start, goal;
  std::vector<ContactRule> rules;
  std::vector<Step> steps;  ///< contact sequence of a walk, for planners that want it given; may be empty

  /// Index into surfaces, or -1.
  int surface_index(const std::string& surface_name) const;

  /// Throws InvalidScene naming the first field out of its range: polygons of at least 3 vertices, finite, planar
  /// within 1 mm, strictly convex, of more than 1e-6 m^2 (less in proportion below a metre); unique names; friction and
  /// thickness positive; contacts and rules naming what exists, steps naming surfaces that exist.
  void validate() const;
};

}  // namespace mcplan
