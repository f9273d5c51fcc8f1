#include <cmath>

#include "check_internal.hpp"

namespace mcplan::checks {
namespace {

using Eigen::Vector3d;

/// p, v, heading and contacts of a knot against a stance at rest: CoM at the stance's, v = 0, roll, pitch and yaw the
/// stance's (yaw modulo a turn), rates 0, under contact wrenches no more momentum than such rates have, every
/// end-effector on the surface that the stance names or free like it.
void check_stance(const Problem& problem, Constraint constraint, const ResolvedStance& stance, int k,
                  Findings& findings) {
  const Knot& knot = problem.plan.knots[k];
  const double tolerance = problem.tolerances.boundary;
  const Similarity& size = problem.similarity;
  const Place place = problem.at_knot(k, -1);
  Vector3d turn = knot.base_rpy - stance.base_rpy;
  turn.z() = std::remainder(knot.base_rpy.z() - stance.base_rpy.z(), 2.0 * M_PI);
  findings.offer(constraint, (knot.com_W - stance.com_W).norm(), place);
  findings.offer(constraint, knot.com_velocity_W.norm(), place, tolerance * size.velocity(), "m/s");
  findings.offer(constraint, largest(turn.cwiseAbs()), place, tolerance, "rad");
  findings.offer(constraint, knot.base_rpy_rate.norm(), place, tolerance * size.rate(), "rad/s");
  if (problem.has_wrenches(place.phase))
    findings.offer(constraint, knot.angular_momentum_W.norm(), place,
                   tolerance * size.rate() * problem.robot.inertia.maxCoeff(), "kg m^2/s");
  for (int l = 0; l < problem.end_effector_count(); ++l)
    findings.offer(constraint, problem.surface(k, l) == stance.contacts[l] ? 0.0 : 1.0, problem.at_knot(k, l), 0.0,
                   "contacts");
}

}  // namespace

/// In addition, what is in contact at the start stands where the nominal stance puts it.
void check_start(const Problem& problem, Findings& findings) {
  if (problem.plan.measured_start) return;
  const ResolvedStance stance = resolve_stance(problem.scene, problem.robot, problem.scene.start, "start");
  check_stance(problem, Constraint::start, stance, 0, findings);
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    if (stance.contacts[l] < 0) continue;
    const double off = (problem.plan.knots[0].end_effectors_W[l] - stance.end_effectors_W[l]).norm();
    findings.offer(Constraint::start, off, {0, l, 0.0}, problem.tolerances.stance, "m");
  }
}

void check_goal(const Problem& problem, Findings& findings) {
  if (problem.plan.open_end || problem.last_knot < problem.phase_count()) return;
  const ResolvedStance stance = resolve_stance(problem.scene, problem.robot, problem.scene.goal, "goal");
  check_stance(problem, Constraint::goal, stance, problem.phase_count(), findings);
}

}  // namespace mcplan::checks
