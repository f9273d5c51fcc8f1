#pragma once

#include <array>
#include <vector>

#include "mcplan/plan/checker.hpp"
#include "mcplan/planar/plan.hpp"

namespace mcplan {

/// Published tolerances of the checker of planar plans.
struct PlanarTolerances {
  double limit = 1e-4;        ///< [-] position (of the range), velocity and torque beyond their limits, relative
  double drift = 1.5e-3;      ///< [m] end-effector in contact from where it should be
  double drift_angle = 5e-3;  ///< [rad]
  double balance = 1e-9;      ///< [N] force that nothing carries
  double moment = 1.0;        ///< [N m] moment that nothing carries: contacts are held where they are, to the drift
  double friction = 1e-4;     ///< [-] of m g: tangential force beyond the cone
  double pull = 1e-4;         ///< [-] of m g
  double clearance = 1.5e-3;  ///< [m] swinging end-effector in a solid, capsules in each other
  double continuity = 1e-9;   ///< [rad] of q, q' h, q'' h^2 (h: interval): jumps at knots, motion at the ends
  double pose = 1e-3;         ///< [m], [rad]
  double sample_s = 1e-3;     ///< [s] sampling in time

  /// Throws InvalidOptions naming all that is no number, and a sample_s that is not positive.
  void validate() const;
};

/// What is checked, in this order; the names are those of violations.
enum class PlanarConstraint {
  finite,
  phase_duration,
  position,
  velocity,
  torque,
  continuity,
  rest,
  drift,
  drift_angle,
  balance,
  moment,
  friction,
  pull,
  clearance,
  collision,
  pose,
};
inline constexpr int kPlanarConstraints = static_cast<int>(PlanarConstraint::pose) + 1;

/// Name, unit and tolerance of a constraint.
struct PlanarConstraintInfo {
  const char* name;
  const char* unit;
  double tolerance;
};
std::array<PlanarConstraintInfo, kPlanarConstraints> planar_constraints(const PlanarTolerances& tolerances);

/// Check a planar plan from its splines with exact kinematics and dynamics: sines and cosines, Newton-Euler, no
/// polynomials of those. The worst place of every constraint, violated or not, as for plans of contacts and CoM:
///
///     finite, phase_duration
///     position, velocity, torque     limits of the joints
///     continuity                     joints, velocities and accelerations at the knots
///     rest                           velocities and accelerations at both ends are zero
///     drift, drift_angle             contacts where they should be
///     balance, moment                forces carry the motion of the base
///     friction, pull                 every point force in its cone
///     clearance                      swinging end-effectors outside of all solids but those of the task's
///     no_clearance,
///                                    and as high in the middle of a swing as it says
///     collision                      capsules of the robot's pairs (only where collision_pairs are given and asked)
///     pose                           poses at given instants
///
/// Throws InvalidPlan, InvalidPlanarTask, InvalidRobot or InvalidOptions as check() of a Plan does.
/// `stop` is polled at every interval between knots; null: never.
CheckResult check(const PlanarPlan& plan, const PlanarTolerances& tolerances = {}, bool self_collision = false,
                  const StopRequest& stop = {});

/// Largest distance [m] and angle [rad] of a contact from where it should be.
struct Drift {
  double position_m = 0.0, angle_rad = 0.0;
};
Drift largest_drift(const PlanarPlan& plan, double sample_s = 1e-3);

/// How deep a swinging end-effector goes into the solid behind a surface at most, and where.
struct SolidDepth {
  int end_effector = 0, surface = 0;
  double depth_m = 0.0;  ///< the shortest way out; negative: how far it stays out
  int phase = -1;
  double time_s = 0.0;
  bool asked = true;  ///< false: the task's no_clearance has the pair
};

/// Of every end-effector that swings and every surface, also of the pairs in no_clearance. While it stands its drift
/// counts instead. An end-effector is all that lies between its outermost points; a solid ends where its surface does.
/// Throws as largest_drift().
std::vector<SolidDepth> solid_depths(const PlanarPlan& plan, double sample_s = 1e-3);

}  // namespace mcplan
