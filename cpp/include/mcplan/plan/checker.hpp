#pragma once

#include <limits>
#include <string>
#include <vector>

#include "mcplan/base/logging.hpp"
#include "mcplan/plan/plan.hpp"
#include "mcplan/plan/report.hpp"
#include "mcplan/robot/similarity.hpp"

namespace mcplan {

/// Published tolerances of the checker, for robots of human size. For others check() takes them times the factors of
/// their Similarity, each by its unit, unless `scaled` is false; what it took stands in Violation::tolerance.
struct Tolerances {
  double dynamics = 1e-8;  ///< [m], [m/s], [rad], [rad/s], [kg m^2/s] replayed state against the next knot
  double orientation = 0.017453292519943295;  ///< [rad] replayed orientation of the base, a degree
  double center_of_pressure = 1e-3;           ///< [m] centre of pressure off the sole or off the surface
  double contact_distance = 1e-3;             ///< [m] end-effector in contact off its plane, or beyond its polygon
  double slip = 1e-3;                         ///< [m] travel of an end-effector while in contact
  double friction = 1e-3;                     ///< [-] tangential over normal force, beyond the coefficient
  double force = 1e-6;                        ///< [N] pull of a contact, or force of a free end-effector
  double force_cap = 1e-3;                    ///< [-] relative excess over max_force, or over momentum_max
  double joint = 0.02;                        ///< [-] relative excess over torque and speed limits of joints
  double moment = 1e-6;                       ///< [N m] excess over max_moment or the torsion the contact can give
  double reach = 1e-3;                        ///< [m] outside the reach box
  double yaw = 1e-2;                          ///< [rad] heading of a sole outside its range
  double clearance = 5e-3;                    ///< [m] end-effector, limb or trunk inside a solid
  double boundary = 1e-2;                     ///< [m], [m/s], [rad], [rad/s] start and goal against the scene's
  double stance = 2e-2;                       ///< [m] end-effectors in contact at the start off the nominal stance
  int switches = 1;        ///< [-] contacts made or broken in one step; surface to surface counts two
  double sample_s = 1e-3;  ///< [s] sampling of the constraints in time
  bool scaled = true;      ///< times the robot's Similarity; false: as they stand, whatever the robot's size

  /// Throws InvalidOptions naming all that is no number, and a sample_s that is not positive.
  void validate() const;
};

/// What the checker found: the worst place of every constraint, violated or not. Names and meanings:
///
///     finite             every number of the plan is finite
///     phase_duration     every phase lasts longer than a microsecond
///     dynamics           forces, gravity and moments, integrated over a phase, end at the next knot
///     at_consistency     Plan::at_phase agrees with that integration
///     orientation        contact wrenches: the angular momentum, integrated on the rotations, turns the base to the
///                        next knot and to what Plan::at_phase says
///     contact_distance   height of an end-effector in contact off its plane
///     contact_polygon    its distance beyond the polygon's boundary
///     contact_permission it may touch that surface
///     slip               its distance from where it touched down, and that of a corner of a sole that turns
///     anchor             distance of the force's anchor, or of its points, from the sole (without one, from the
///     point);
///                        not of contact wrenches, whose line of force may pass anywhere
///     center_of_pressure contact wrenches: distance of the point where the force acts from the sole (from the point,
///                        without one), from the surface's plane and from its polygon
///     path_continuity    jump of an end-effector at a knot, or within a phase: what it goes beyond its velocities
///     free_force         stiffness, moment and points of a free end-effector are none
///     stiffness_sign     mu_l >= 0
///     pull               no contact and no point of one pulls, n . f >= 0 (grasp surfaces excepted)
///     friction           |tangential force| / (n . f) <= friction coefficient, at every point (grasp surfaces
///                        excepted)
///     force_cap          |f_l| <= max_force, f_l the sum over its points
///     joint_torque       torque of knee, hip or ankle of a leg in contact over its limit, for robots with limb limits
///     joint_speed        speed of its knee over its limit, likewise
///     com_speed          |v| of the CoM beyond max_com_speed
///     moment             contact moment within max_moment and within what the sole can give (not of forces at points,
///                        which `anchor`, `pull` and `friction` hold); of contact wrenches: none along the surface
///     angular_momentum   limits of the angular momentum and of its rate that the plan claims to keep
///     reach              every end-effector, swinging or not, in its reach box about the CoM, and where knots put
///                        free ones; in contact in com_reach and partner_reach, where the robot has them, and its
///                        heading in yaw_range
///     clearance          depth of a swinging end-effector in a solid
///     limb               of the straight line from the CoM to an end-effector in a solid that this does not touch: how
///                        far it would have to be moved to be outside, beyond the 0.1 m by which knees and elbows bend,
///                        or its length inside beyond 0.15 m, whichever is more (of a robot of human size)
///     trunk              depth of a ball about the CoM, of a tenth of its height, in a solid, and of the robot's
///                        trunk, where it has one: how much nearer its line is than its radius
///     sequence_switch    contacts made or broken in one step
///     sequence_rule      the scene's contact rules, in every phase and at the end
///     start, goal        CoM, heading and contacts of the scene's stances, at rest (no start where the plan begins
///                        at a measured state, no goal where its end is open)
///
/// A constraint that nothing in the plan touches stands there with value 0 and phase -1. When `finite` or
/// `phase_duration` is violated nothing else can be evaluated, and the list ends there.
///
/// Warnings are no violations: ok() does not ask for them. There is one:
///
///     limb               length of the straight line from the CoM to an end-effector inside the solid of a surface
///     that
///                        this end-effector does not touch; the worst place of each surface, where it is more than the
///                        tolerance of clearance
///
/// With Plan::start_slack_s T > 0 what the measured start violates by itself is forgiven for a while. v(t) is the most
/// that the state would be beyond a limit until t if nothing intervened: CoM and base move on straight, at their
/// velocities, what stands stands, and what is free moves with the base. Of reach (its parts together, but yaw_range
/// apart), com_speed, joint_speed, clearance, limb, trunk, contact_distance and contact_polygon, each of each
/// end-effector, the value at time t is what is beyond the limit, less
///
///     v(t) max(0, 1 - (t / T)^2);
///
/// v is v(0) of all but reach and joint_speed, and of contact_distance and contact_polygon it is forgiven as long as a
/// contact of the start stands, since a sole does not move. All other constraints are as they are.
struct CheckResult {
  std::vector<Violation> constraints;
  bool complete = true;  ///< false: stopped by the caller; what was looked at by then is listed, and ok() is false
  std::vector<Violation> warnings = {};  ///< longest first
  std::vector<Violation> start = {};     ///< v(0) above the tolerance, worst first: ok() does not ask for it

  /// Time [s] of the earliest violation of any constraint, up to when the plan may be followed; checked_until_s where
  /// there is none, 0 where the plan could not be evaluated.
  double kept_until_s = 0.0;
  double checked_until_s = 0.0;  ///< how far the plan was looked at [s]: what ok() says is about that
  double start_slack_s = 0.0;    ///< the plan's

  bool ok() const;
  std::vector<Violation> violations() const;  ///< those beyond their tolerance, worst first
  const Violation& worst() const;             ///< largest value / tolerance, violated or not
  std::string to_string() const;  ///< a line a violation, or "ok"; then a line for each entry of start and warnings
};

/// Check a plan against a scene and a robot, from its positions, forces and polygons alone.
/// Throws InvalidPlan when the plan's arrays do not fit together or do not fit the scene and the robot, InvalidScene
/// and InvalidRobot when these are malformed, InvalidOptions when a tolerance is no number, sample_s is not positive or
/// the plan too long for it, or until_s is not positive. `stop` is polled every few hundred instants, about once a
/// millisecond; null: never. It serves deadlines, too.
///
/// With `until_s` [s], above zero, before the plan's end only what comes no later is looked at: phases that begin
/// before it, instants and knots up to it, the contacts after a knot at that very time. `goal` is not, and `finite` is
/// of the whole plan all the same.
CheckResult check(const Plan& plan, const Scene& scene, const Robot& robot, const Tolerances& tolerances = {},
                  const StopRequest& stop = {}, double until_s = std::numeric_limits<double>::infinity());

}  // namespace mcplan
