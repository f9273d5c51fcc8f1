#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

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

/// Angle of the rotation from the one to the other: |A - B| = 2 sqrt(2) |sin(angle / 2)| in Frobenius' norm.
double angle_between(const Matrix3d& a, const Matrix3d& b) {
  return 2.0 * std::asin(std::min((a - b).norm() / std::sqrt(8.0), 1.0));
}

/// Sums over the contacts of a phase, of which all of an instant's forces and moments follow:
///
///     sum_l f_l = m (mu p - s),   sum_l ((a_l - p) x f_l + tau_l) = m ((a - s) x p - c) + tau,
///     mu = sum mu_l,  s = sum mu_l s_l,  a = sum mu_l a_l,  c = sum mu_l a_l x s_l,  tau = sum tau_l
///
/// with places counted from where the CoM is as the phase begins: kilometres from the world's origin the products would
/// lose the digits that their difference is made of.
struct Wrenches {
  Wrenches(const Problem& problem, int phase)
      : mass(problem.robot.mass), inertia(problem.robot.inertia), origin_W(problem.plan.knots[phase].com_W) {
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

  double mass;
  Vector3d inertia, origin_W;
  double stiffness = 0.0;                                                        ///< mu
  Vector3d anchors = Vector3d::Zero(), lines = anchors, steady = anchors, fall;  ///< s, a - s, tau / m - c, s + g
};

/// p'' = sum_l f_l / m - g,  L' = sum_l ((a_l - p) x f_l + tau_l),  q' = (0, omega) q / 2  with  omega = R I^-1 R^T L.
Replay wrench_rate(const Wrenches& sum, const Replay& state) {
  const Vector3d com = state.com_W - sum.origin_W;
  Replay rate{state.com_velocity_W, sum.stiffness * com - sum.fall, Vector3d::Zero(), Vector3d::Zero(),
              sum.mass * (sum.lines.cross(com) + sum.steady)};
  const Vector4d& q = state.quat_wxyz;
  const Quaterniond turned(q[0], q[1], q[2], q[3]);
  const Vector3d omega = angular_velocity(turned.normalized().toRotationMatrix(), state.momentum_W, sum.inertia);
  const Quaterniond slope = Quaterniond(0.0, 0.5 * omega.x(), 0.5 * omega.y(), 0.5 * omega.z()) * turned;
  rate.quat_wxyz = {slope.w(), slope.x(), slope.y(), slope.z()};
  return rate;
}

void set_angles(Replay& state) {
  Vector4d& q = state.quat_wxyz;
  q /= q.norm();
  const Matrix3d r = Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  state.rpy = {std::atan2(r(2, 1), r(2, 2)), std::atan2(-r(2, 0), std::hypot(r(2, 1), r(2, 2))),
               std::atan2(r(1, 0), r(0, 0))};
}

/// The base turned over the phase is the next knot's.
void check_orientation_at_knot(const Problem& problem, const Sample& phase_end, Findings& findings) {
  const Matrix3d next = rotation_from_rpy(problem.plan.knots[phase_end.phase + 1].base_rpy);
  findings.offer(Constraint::orientation, angle_between(phase_end.r_WB, next), {phase_end.phase, -1, phase_end.time_s});
}

/// What the plan says of the base at an instant is what the integration says, in angles and as a quaternion.
void check_orientation(const Sample& sample, Findings& findings) {
  const Place place{sample.phase, -1, sample.time_s};
  const Vector4d& q = sample.at.base_quat_wxyz;
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
  findings.offer(Constraint::at_consistency,
                 largest((angular_velocity(at.base_rpy, at.base_rpy_rate) - omega).cwiseAbs()),
                 {sample.phase, -1, sample.time_s}, tolerance * problem.similarity.rate(), "rad/s");
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const Contact& contact = problem.plan.phases[sample.phase].contacts[l];
    if (contact.surface < 0) continue;
    const Place place{sample.phase, l, sample.time_s};
    const EndEffectorState& end = at.end_effectors[l];
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
/// the sole touches: on the surface's plane and in its polygon.
void check_center_of_pressure(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const int surface = problem.surface(sample.phase, l);
    if (surface < 0) continue;
    const Polygon& polygon = problem.solids[surface].polygon;
    const Vector3d& center = problem.plan.phases[sample.phase].contacts[l].center_of_pressure_W;
    const Place place{sample.phase, l, sample.time_s};
    findings.offer(Constraint::center_of_pressure,
                   beyond_sole(problem.robot.end_effectors[l].half_size, polygon.normal_W(),
                               sole_yaw(problem, sample, l), center - sample.at.end_effectors[l].position_W),
                   place);
    findings.offer(Constraint::center_of_pressure, std::abs(polygon.height(center)), place);
    findings.offer(Constraint::center_of_pressure, beyond_polygon(polygon, center), place);
  }
}

}  // namespace

Replay LawCheck<laws::Wrench>::start(const Problem& problem, int phase) {
  const Knot& knot = problem.plan.knots[phase];
  return {knot.com_W,       knot.com_velocity_W,     knot.base_rpy,
          Vector3d::Zero(), knot.angular_momentum_W, quat_wxyz_from_rpy(knot.base_rpy)};
}

Replay LawCheck<laws::Wrench>::advance(const Problem& problem, int phase, const Replay& from, double /*since_start*/,
                                       double h) {
  // The base turns by h |omega|, which errs by 1e-8 rad a second at 0.02.
  const double turning = std::ceil(from.momentum_W.norm() / problem.robot.inertia.minCoeff() * h / 0.02);
  const int steps = static_cast<int>(std::clamp(std::max(stiffness_steps(problem, phase, h), turning), 1.0, 64.0));
  const Wrenches wrenches(problem, phase);
  Replay state = from;
  for (int i = 0; i < steps; ++i) {
    state = rk4(state, h / steps, [&](double, const Replay& at) { return wrench_rate(wrenches, at); });
    set_angles(state);
  }
  return state;
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
