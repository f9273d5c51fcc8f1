#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "check_laws.hpp"
#include "mcplan/base/rotation.hpp"

/// Contact wrenches, from the forces alone: each contact gives f_l = m mu_l (p - s_l) at a_l, and a moment tau_l.
namespace mcplan::checks {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector4d;

/// omega = R I^-1 R^T L, in the world.
Vector3d angular_velocity(const Matrix3d& r_WB, const Vector3d& momentum_W, const Vector3d& inertia) {
  return r_WB * (r_WB.transpose() * momentum_W).cwiseQuotient(inertia);
}

/// omega of rates of roll, pitch and yaw: each turns about its own axis, roll about the base's x, pitch about the
/// level y of the heading, yaw about the vertical.
Vector3d angular_velocity(const Vector3d& rpy, const Vector3d& rate) {
  const double sp = std::sin(rpy[1]), cp = std::cos(rpy[1]), sy = std::sin(rpy[2]), cy = std::cos(rpy[2]);
  return rate[0] * Vector3d(cy * cp, sy * cp, -sp) + rate[1] * Vector3d(-sy, cy, 0.0) +
         rate[2] * Vector3d(0.0, 0.0, 1.0);
}

/// The same of an instant, whose sines and cosines stand in the orientation, unless the base's x points about up or
/// down.
Vector3d stated_velocity(const Matrix3d& r_at_WB, const PlanState& at) {
  const double level = r_at_WB.col(0).head<2>().norm();
  if (!(std::abs(at.base_rpy[1]) < 1.5)) return angular_velocity(at.base_rpy, at.base_rpy_rate);
  const double pitch = at.base_rpy_rate[1] / level;
  return at.base_rpy_rate[0] * r_at_WB.col(0) +
         Vector3d(-pitch * r_at_WB(1, 0), pitch * r_at_WB(0, 0), at.base_rpy_rate[2]);
}

/// Angle of the rotation from the one to the other: |A - B| = 2 sqrt(2) |sin(angle / 2)| in Frobenius' norm.
double angle_between(const Matrix3d& a, const Matrix3d& b) {
  return 2.0 * std::asin(std::min((a - b).norm() / std::sqrt(8.0), 1.0));
}

/// q' = (0, omega) q / 2  with  omega = R I^-1 R^T L.
Vector4d turning_rate(const Matrix3d& r_WB, const Vector4d& q, const Vector3d& momentum_W,
                      const Vector3d& inverse_inertia) {
  const Vector3d omega = 0.5 * (r_WB * (r_WB.transpose() * momentum_W).cwiseProduct(inverse_inertia));
  return {-omega[0] * q[1] - omega[1] * q[2] - omega[2] * q[3], omega[0] * q[0] + omega[1] * q[3] - omega[2] * q[2],
          omega[1] * q[0] + omega[2] * q[1] - omega[0] * q[3], omega[2] * q[0] + omega[0] * q[2] - omega[1] * q[1]};
}

/// p'' = sum_l f_l / m - g,  L' = sum_l ((a_l - p) x f_l + tau_l),  and q'.
Replay wrench_rate(const Wrenches& sum, const Replay& state) {
  const Vector3d com = state.com_W - sum.origin_W;
  Replay rate{state.com_velocity_W, sum.stiffness * com - sum.fall, Vector3d::Zero(), Vector3d::Zero(),
              sum.mass * (sum.lines.cross(com) + sum.steady)};
  const Vector4d& q = state.quat_wxyz;
  const Matrix3d r_WB = Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  rate.quat_wxyz = turning_rate(r_WB, q, state.momentum_W, sum.inverse_inertia);
  return rate;
}

/// The base turned over the phase is the next knot's.
void check_orientation_at_knot(const Problem& problem, const Sample& phase_end, Findings& findings) {
  const Matrix3d next = rotation_from_rpy(problem.plan.knots[phase_end.phase + 1].base_rpy);
  findings.offer(Constraint::orientation, angle_between(phase_end.r_WB, next), {phase_end.phase, -1, phase_end.time_s});
}

/// What the plan says of the base at an instant is what the integration says, in angles and as a quaternion.
void check_orientation(const Sample& sample, Findings& findings) {
  const Place place{sample.phase, -1, sample.time_s};
  const Vector4d &q = sample.at.base_quat_wxyz, &replayed = sample.replay.quat_wxyz;
  // Far from the worst there is no need for angles: the arc sine of x is at most x + x^3, and matrices of quaternions
  // differ by at most 2 sqrt(8) of what these do, where that is little.
  const double apart = std::min((q - replayed).squaredNorm(), (q + replayed).squaredNorm());
  const double x2 = std::max((sample.r_WB - sample.r_at_WB).squaredNorm() / 8.0, 5.0 * apart);
  const double kept = findings.kept(Constraint::orientation) / (2.0 * (1.0 + x2));
  if (kept > 0.0 && x2 < 0.01 && x2 < kept * kept * kBelow) return;
  findings.offer(Constraint::orientation, angle_between(sample.r_WB, sample.r_at_WB), place);
  findings.offer(Constraint::orientation,
                 angle_between(sample.r_WB, Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix()), place);
}

/// The rates of the angles at the two knots of a phase are those of their momentum.
void check_turning_rate(const Problem& problem, int phase, Findings& findings) {
  for (int k : {phase, phase + 1}) {
    const Knot& knot = problem.plan.knots[k];
    const Vector3d omega =
        angular_velocity(rotation_from_rpy(knot.base_rpy), knot.angular_momentum_W, problem.robot.inertia);
    const Vector3d stated = angular_velocity(knot.base_rpy, knot.base_rpy_rate);
    findings.offer(Constraint::dynamics, largest((stated - omega).cwiseAbs()), {phase, -1, problem.knot_times[k]},
                   problem.tolerances.dynamics * problem.similarity.rate(), "rad/s");
  }
}

/// Of an instant: the rates of the angles are those of the replayed momentum in the orientation that the plan states
/// (which `orientation` compares); centres of pressure are the contacts'.
void check_at_wrenches(const Problem& problem, const Sample& sample, Findings& findings) {
  const double tolerance = problem.tolerances.dynamics, length = problem.similarity.length;
  const PlanState& at = sample.at;
  const Vector3d omega = angular_velocity(sample.r_at_WB, sample.replay.momentum_W, problem.robot.inertia);
  findings.offer(Constraint::at_consistency, largest((stated_velocity(sample.r_at_WB, at) - omega).cwiseAbs()),
                 {sample.phase, -1, sample.time_s}, tolerance * problem.similarity.rate(), "rad/s");
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const Contact& contact = problem.plan.phases[sample.phase].contacts[l];
    const EndEffectorState& end = at.end_effectors[l];
    if (contact.surface < 0 || end.center_of_pressure_W == contact.center_of_pressure_W) continue;
    const Place place{sample.phase, l, sample.time_s};
    findings.offer(Constraint::at_consistency,
                   largest((end.center_of_pressure_W - contact.center_of_pressure_W).cwiseAbs()), place,
                   tolerance * length, "m");
  }
}

/// tau_l is along the surface's normal n, |tau_l - n (n . tau_l)| = 0, and |n . tau_l| <= max_moment's third entry.
/// A moment along the surface is what the centre of pressure does.
void check_normal_moment(const Problem& problem, int phase, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const Contact& contact = problem.plan.phases[phase].contacts[l];
    if (contact.surface < 0) continue;
    const Vector3d& n = problem.solids[contact.surface].polygon.normal_W();
    const double torsion = n.dot(contact.moment_W);
    findings.offer(Constraint::moment, (contact.moment_W - torsion * n).norm(), problem.at_knot(phase, l));
    findings.offer(Constraint::moment, std::abs(torsion) - problem.robot.end_effectors[l].max_moment[2],
                   problem.at_knot(phase, l));
  }
}

/// |n . tau_l| <= friction a (n . f_l): the moment that friction under a sole gives, with a its shorter half side.
/// Point contacts and grasps are held by max_moment alone.
void check_torsion(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const int index = problem.surface(sample.phase, l);
    const double half = problem.robot.end_effectors[l].half_size.minCoeff();
    if (index < 0 || half <= 0.0 || problem.scene.surfaces[index].grasp) continue;
    const Vector3d& n = problem.solids[index].polygon.normal_W();
    const double torsion = n.dot(problem.plan.phases[sample.phase].contacts[l].moment_W);
    const double normal = std::max(n.dot(sample.forces_W[l]), 0.0);
    findings.offer(Constraint::moment, std::abs(torsion) - problem.scene.surfaces[index].friction * half * normal,
                   {sample.phase, l, sample.time_s});
  }
}

/// a_l lies on the sole, a rectangle about p_l with the sole's own heading (on p_l itself, without a sole), and where
/// the sole touches: on the surface's plane, and in its polygon or one that goes on in that plane.
void check_center_of_pressure(const Problem& problem, const Sample& sample, Findings& findings) {
  const bool own_yaw = !problem.plan.knots[sample.phase].end_effector_yaw.empty();
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const int surface = problem.surface(sample.phase, l);
    if (surface < 0 || (sample.still[l] && own_yaw)) continue;
    const Polygon& polygon = problem.solids[surface].polygon;
    const Vector3d& center = problem.plan.phases[sample.phase].contacts[l].center_of_pressure_W;
    const Place place{sample.phase, l, sample.time_s};
    findings.offer(Constraint::center_of_pressure,
                   beyond_sole(problem.robot.end_effectors[l].half_size, polygon.normal_W(),
                               sole_yaw(problem, sample, l), center - sample.at.end_effectors[l].position_W),
                   place);
    findings.offer(Constraint::center_of_pressure, std::abs(polygon.height(center)), place);
    findings.offer(
        Constraint::center_of_pressure,
        beyond_ground(problem, surface, l, center, beside_named_m + problem.robot.end_effectors[l].half_size.norm()),
        place);
  }
}

}  // namespace

Wrenches::Wrenches(const Problem& problem, int phase)
    : mass(problem.robot.mass),
      inverse_inertia(problem.robot.inertia.cwiseInverse()),
      origin_W(problem.plan.knots[phase].com_W) {
  for (const Contact& contact : problem.plan.phases[phase].contacts) {
    const Vector3d pulled = contact.stiffness * (contact.anchor_W - origin_W);
    const Vector3d pressed = contact.center_of_pressure_W - origin_W;
    stiffness += contact.stiffness;
    anchors += pulled;
    lines += contact.stiffness * pressed - pulled;
    steady += contact.moment_W / mass - pressed.cross(pulled);
  }
  fall = anchors + Vector3d(0.0, 0.0, problem.scene.gravity);
}

Replay LawCheck<laws::Wrench>::start(const Problem& problem, int phase) {
  const Knot& knot = problem.plan.knots[phase];
  const Vector3d none = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return {knot.com_W, knot.com_velocity_W, none, none, knot.angular_momentum_W, quat_wxyz_from_rpy(knot.base_rpy)};
}

WrenchIntegration::WrenchIntegration(const Problem& problem, int phase, double h)
    : sum_(problem, phase), h_(h), min_inertia_(problem.robot.inertia.minCoeff()), step_(sum_.stiffness, h) {}

Vector4d WrenchIntegration::turned_by_rk4(const Replay& from, double turning) const {
  const int steps = static_cast<int>(std::clamp(std::ceil(turning / 0.02), 1.0, 64.0));
  Replay state = from;
  for (int i = 0; i < steps; ++i) {
    state = rk4(state, h_ / steps, [&](double, const Replay& at) { return wrench_rate(sum_, at); });
    state.quat_wxyz /= state.quat_wxyz.norm();
  }
  return state.quat_wxyz;
}

/// The base turns by h |omega|, which errs by 1e-8 rad a second at 0.02 with RK4 and by less at 0.01 without.
void WrenchIntegration::advance(Sample& sample) {
  Replay& replay = sample.replay;
  for (int i : {3, 2, 1}) slopes_[i] = slopes_[i - 1];
  slopes_[0] = turning_rate(sample.r_WB, replay.quat_wxyz, replay.momentum_W, sum_.inverse_inertia);
  ++known_;
  const double turning = replay.momentum_W.norm() / min_inertia_ * h_;
  if (known_ < 4 || !(turning <= 0.01)) {
    replay.quat_wxyz = turned_by_rk4(replay, turning);
  } else {
    replay.quat_wxyz += h_ / 24.0 * (55.0 * slopes_[0] - 59.0 * slopes_[1] + 37.0 * slopes_[2] - 9.0 * slopes_[3]);
    replay.quat_wxyz *= 1.5 - 0.5 * replay.quat_wxyz.squaredNorm();  // its length is 1 up to a trillionth
  }
  Vector3d com = replay.com_W - sum_.origin_W;
  const Vector3d travelled = step_.apply(com, replay.com_velocity_W, sum_.fall);
  replay.com_W = sum_.origin_W + com;
  replay.momentum_W += sum_.mass * (sum_.lines.cross(travelled) + h_ * sum_.steady);
}

void LawCheck<laws::Wrench>::set_forces(const Problem& problem, Sample& sample) {
  set_forces_that_act_at(&Contact::center_of_pressure_W, problem, sample);
}

void LawCheck<laws::Wrench>::check_numbers(const Problem& problem, int phase, Findings& findings) {
  check_normal_moment(problem, phase, findings);
}

void LawCheck<laws::Wrench>::check_state(const Problem& problem, const Sample& sample, Findings& findings) {
  check_at_wrenches(problem, sample, findings);
  check_orientation(sample, findings);
}

void LawCheck<laws::Wrench>::check_bounds(const Problem& problem, const Sample& sample, Findings& findings) {
  check_torsion(problem, sample, findings);
  check_center_of_pressure(problem, sample, findings);
}

void LawCheck<laws::Wrench>::check_end(const Problem& problem, const Sample& phase_end, Findings& findings) {
  check_turning_rate(problem, phase_end.phase, findings);
  check_orientation_at_knot(problem, phase_end, findings);
}

}  // namespace mcplan::checks
