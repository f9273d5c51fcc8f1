#include <cmath>

#include "check_internal.hpp"

namespace mcplan::checks {

/// Every number of the plan is finite; the value counts those that are not, knot by knot and phase by phase.
bool check_finite(const Problem& problem, Findings& findings) {
  const Plan& plan = problem.plan;
  bool all = true;
  const auto offer = [&](int bad, int phase) {
    all = all && bad == 0;
    findings.offer(Constraint::finite, bad, {phase, -1, 0.0});
  };
  const auto count = [](const Eigen::Vector3d& v) { return v.allFinite() ? 0 : 1; };
  for (int k = 0; k <= problem.phase_count(); ++k) {
    const Knot& knot = plan.knots[k];
    int bad = count(knot.com_W) + count(knot.com_velocity_W) + count(knot.base_rpy) + count(knot.base_rpy_rate) +
              count(knot.angular_momentum_W);
    for (int l = 0; l < problem.end_effector_count(); ++l)
      bad += count(knot.end_effectors_W[l]) + count(knot.end_effector_velocities_W[l]);
    for (double yaw : knot.end_effector_yaw) bad += !std::isfinite(yaw);
    if (k < problem.phase_count()) {
      bad += !std::isfinite(plan.phases[k].duration);
      for (const Contact& contact : plan.phases[k].contacts) {
        bad += !std::isfinite(contact.stiffness) + count(contact.anchor_W) + count(contact.moment_W) +
               count(contact.center_of_pressure_W);
        for (const Eigen::Vector3d& point : contact.points_W) bad += count(point);
        for (const Eigen::Vector3d& force : contact.point_forces_W) bad += count(force);
      }
    }
    offer(bad, k);
  }
  if (!std::isfinite(plan.start_slack_s)) offer(1, -1);
  for (const Swing& swing : plan.swings)
    offer(!std::isfinite(swing.height) + count(swing.lift_normal_W) + count(swing.land_normal_W), swing.first_phase);
  return all;
}

/// h_k > 0 of the phases that are looked at, where a microsecond counts as nothing.
bool check_phase_duration(const Problem& problem, Findings& findings) {
  const double shortest = 1e-6 * problem.similarity.time;
  bool all = true;
  for (int k = 0; k < problem.end_phase; ++k) {
    const double missing = shortest - problem.plan.phases[k].duration;
    all = all && missing <= 0.0;
    findings.offer(Constraint::phase_duration, missing, {k, -1, 0.0});
  }
  return all;
}

}  // namespace mcplan::checks
