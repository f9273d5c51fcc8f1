#include <algorithm>
#include <cmath>

#include "base/base_rotation.hpp"
#include "check_laws.hpp"

namespace mcplan::checks {
namespace {

using Eigen::Vector3d;

/// Largest difference of two states among its five parts, each in its own unit; where momentum turns the base, the
/// angles are another constraint's.
void offer_difference(Constraint constraint, const Replay& a, const Replay& b, bool angles, const Place& place,
                      const Problem& problem, Findings& findings) {
  const Similarity& size = problem.similarity;
  const auto offer = [&](const Vector3d& x, const Vector3d& y, double factor, const char* unit) {
    findings.offer(constraint, largest((x - y).cwiseAbs()), place, problem.tolerances.dynamics * factor, unit);
  };
  offer(a.com_W, b.com_W, size.length, "m");
  offer(a.com_velocity_W, b.com_velocity_W, size.velocity(), "m/s");
  offer(a.momentum_W, b.momentum_W, size.angular_momentum(), "kg m^2/s");
  if (!angles) return;
  offer(a.rpy, b.rpy, 1.0, "rad");
  offer(a.rpy_rate, b.rpy_rate, size.rate(), "rad/s");
}

}  // namespace

int sample_count(const Problem& problem, int phase) {
  const Phase& p = problem.plan.phases[phase];
  const int pieces = std::max(1, p.intervals);
  return pieces * std::max(1, static_cast<int>(std::ceil(p.duration / pieces / problem.tolerances.sample_s)));
}

/// Of the quaternion where one is integrated, else of the angles.
void set_orientation(Sample& sample) {
  const Replay& replay = sample.replay;
  if (!replay.has_quaternion()) {
    sample.r_WB = RpyTrig(replay.rpy).rotation();
    sample.yaw = replay.rpy.z();
    return;
  }
  const Eigen::Vector4d& q = replay.quat_wxyz;
  sample.r_WB = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  sample.yaw = std::atan2(sample.r_WB(1, 0), sample.r_WB(0, 0));
}

/// A state that has overflowed stays as it is: it violates all that asks for it, and is not worth a step.
bool has_numbers(const Replay& replay) {
  const bool base =
      replay.has_quaternion() ? replay.quat_wxyz.allFinite() : replay.rpy.allFinite() && replay.rpy_rate.allFinite();
  return base && replay.com_W.allFinite() && replay.com_velocity_W.allFinite() && replay.momentum_W.allFinite();
}

void contact_forces(const Problem& problem, Sample& sample) {
  sample.forces_W.resize(problem.end_effector_count());
  sample.moments_W.resize(problem.end_effector_count());
  sample.cone_forces_W.resize(problem.end_effector_count());
  with_law(problem, sample.phase, [&](auto law) { law.set_forces(problem, sample); });
}

/// The state integrated over the phase is the next knot.
void check_dynamics(const Problem& problem, const Sample& phase_end, Findings& findings) {
  const int k = phase_end.phase;
  const Knot& next = problem.plan.knots[k + 1];
  offer_difference(Constraint::dynamics, phase_end.replay,
                   {next.com_W, next.com_velocity_W, next.base_rpy, next.base_rpy_rate,
                    problem.has_momentum(k) ? next.angular_momentum_W : phase_end.replay.momentum_W},
                   !problem.has_wrenches(k), {k, -1, phase_end.time_s}, problem, findings);
  with_law(problem, k, [&](auto law) { law.check_end(problem, phase_end, findings); });
}

/// What the plan says of an instant is what the integration says; forces are compared in units of the weight, moments
/// in those of the weight at a metre.
void check_at_consistency(const Problem& problem, const Sample& sample, Findings& findings) {
  const PlanState& at = sample.at;
  offer_difference(Constraint::at_consistency, sample.replay,
                   {at.com_W, at.com_velocity_W, at.base_rpy, at.base_rpy_rate,
                    problem.has_momentum(sample.phase) ? at.angular_momentum_W : sample.replay.momentum_W},
                   !problem.has_wrenches(sample.phase), {sample.phase, -1, sample.time_s}, problem, findings);
  with_law(problem, sample.phase, [&](auto law) { law.check_state(problem, sample, findings); });
  const double per_weight = 1.0 / (problem.robot.mass * problem.scene.gravity);
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const Place place{sample.phase, l, sample.time_s};
    const EndEffectorState& end = at.end_effectors[l];
    if (end.force_W != sample.forces_W[l])
      findings.offer(Constraint::at_consistency, largest((end.force_W - sample.forces_W[l]).cwiseAbs()) * per_weight,
                     place, problem.tolerances.dynamics, "of the weight");
    if (problem.surface(sample.phase, l) < 0) continue;
    findings.offer(Constraint::at_consistency, largest((end.moment_W - sample.moments_W[l]).cwiseAbs()) * per_weight,
                   place, problem.tolerances.dynamics * problem.similarity.length, "m of the weight");
  }
}

}  // namespace mcplan::checks
