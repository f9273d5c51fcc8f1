#pragma once

#include <string>
#include <vector>

#include "mcplan/plan/plan.hpp"
#include "mcplan/plan/report.hpp"

namespace mcplan {

/// Published tolerances of the checker.
struct Tolerances {
  double dynamics = 1e-8;          ///< [m], [m/s], [rad], [rad/s] replayed state against the next knot
  double contact_distance = 1e-3;  ///< [m] end-effector in contact off its plane, or beyond its polygon
  double slip = 1e-3;              ///< [m] travel of an end-effector while in contact
  double friction = 1e-3;          ///< [-] tangential over normal force, beyond the coefficient
  double force = 1e-6;             ///< [N] pull of a contact, or force of a free end-effector
  double force_cap = 1e-3;         ///< [-] relative excess over max_force
  double moment = 1e-6;            ///< [N m] excess over max_moment or the torsion the contact can give
  double reach = 1e-3;             ///< [m] outside the reach box
  double clearance = 5e-3;         ///< [m] swinging end-effector inside a solid
  double boundary = 1e-2;          ///< [m], [m/s], [rad] start and goal against the scene's
  double sample_s = 1e-3;          ///< [s] sampling of the constraints in time
};

/// What the checker found: the worst place of every constraint, violated or not.
struct CheckResult {
  std::vector<Violation> constraints;

  bool ok() const;
  std::vector<Violation> violations() const;  ///< those beyond their tolerance, worst first
  const Violation& worst() const;             ///< largest value / tolerance, violated or not
  std::string to_string() const;              ///< one line a violation, or "ok"
};

/// Check a plan against a scene and a robot, from its positions, forces and polygons alone.
/// Throws InvalidPlan when the plan's arrays do not fit together.
CheckResult check(const Plan& plan, const Scene& scene, const Robot& robot, const Tolerances& tolerances = {});

}  // namespace mcplan
