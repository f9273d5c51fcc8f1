#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "mcplan/base/error.hpp"
#include "mcplan/planar/robot.hpp"

namespace mcplan {

class InvalidPlanarTask : public InvalidInput {
  using InvalidInput::InvalidInput;
};

/// A straight piece of the ground or of a wall. Its tangent points along `angle`, its outward normal 90 degrees to the
/// left of it; what lies behind is solid.
struct PlanarSurface {
  std::string name;
  Eigen::Vector2d origin_W = Eigen::Vector2d::Zero();      ///< [m]
  double angle = 0.0;                                      ///< [rad]
  double friction = 1.0;                                   ///< coefficient [-]
  double from = -std::numeric_limits<double>::infinity();  ///< extent along the tangent, from the origin [m]
  double to = std::numeric_limits<double>::infinity();

  Eigen::Vector2d tangent_W() const;
  Eigen::Vector2d normal_W() const;
};

/// An end-effector that stands still on a surface for a phase.
struct PlanarContact {
  int end_effector = 0;
  int surface = 0;
  Eigen::Vector2d position_W = Eigen::Vector2d::Zero();  ///< of the end-effector's frame [m]
  double angle = 0.0;  ///< of its x axis [rad]: a real number, whole turns count (they say which way a limb goes round)
};

/// An end-effector that may be inside a surface's solid: no one asks how deep.
struct PlanarNoClearance {
  int end_effector = 0;
  int surface = 0;
};

/// Where a swinging end-effector stays in front of a surface's endless line. All of them stay outside of all solids
/// anyway; this says which way they go, and how high.
struct PlanarClearance {
  int end_effector = 0;
  int surface = 0;
  int first_interval = 0, end_interval = -1;                        ///< of the phase, first .. end - 1; -1: to its end
  double middle_height = -std::numeric_limits<double>::infinity();  ///< at the begin of interval n/2 at least this [m]
};

/// A pose that a body has to have at an instant of a phase: bounds on x, y [m] and angle [rad] of its frame.
struct PlanarPose {
  int body = 0;
  double fraction = 0.0;  ///< of the phase, 0..1
  Eigen::Vector3d min = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());
  Eigen::Vector3d max = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
};

/// A stretch of time with constant contacts.
struct PlanarPhase {
  int intervals = 4;                                                                  ///< of the joints' splines
  double min_duration = 0.0, max_duration = std::numeric_limits<double>::infinity();  ///< [s]
  std::vector<PlanarContact> contacts;
  std::vector<PlanarClearance> clearances;
  std::vector<PlanarPose> poses;
};

/// A task for whole-body planning: a planar robot, the ground, and the sequence of contact stances.
struct PlanarTask {
  std::string name;
  std::string description;
  PlanarRobot robot;
  std::vector<PlanarSurface> surfaces;
  std::vector<PlanarNoClearance> no_clearance;  ///< every other pair keeps clear of each other
  std::vector<PlanarPhase> phases;

  int interval_count() const;
  int first_interval(int phase) const;
  int phase_of(int interval) const;

  /// Whether an end-effector has to stay outside of a surface's solid: unless no_clearance has the pair.
  bool keeps_clear(int end_effector, int surface) const;

  /// Throws InvalidPlanarTask (InvalidRobot for the robot) naming the first field out of its range: no phases, a phase
  /// without intervals or contacts or with no room for its duration, a contact off its surface or turned against it, an
  /// end-effector in contact twice, two contacts further apart than the limbs between them are long, a clearance of an
  /// end-effector in contact or of a pair in no_clearance, a pair that is there twice, a pose outside its phase.
  void validate() const;
};

}  // namespace mcplan
