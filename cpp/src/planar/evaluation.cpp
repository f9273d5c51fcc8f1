#include "evaluation.hpp"

#include <cmath>
#include <variant>

#include "base/cubic_spline.hpp"
#include "plane.hpp"

namespace mcplan::planar {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

PlanarMotionOfFrame sole_of(const PlanarRobot& robot, const std::vector<PlanarMotionOfFrame>& bodies, int who) {
  const PlanarEndEffector& end = robot.end_effectors[who];
  return planar_point(bodies[end.body], end.position_B, end.angle_B);
}

}  // namespace

IntervalSplines interval_splines(const PlanarPlan& plan, int interval, const std::vector<double>& lengths) {
  const Eigen::Matrix4d basis = cubic_spline_basis<double>(spacing_about(lengths, interval));
  IntervalSplines out;
  out.interval = interval;
  out.phase = plan.task.phase_of(interval);
  out.length = lengths[interval];
  out.joints = plan.control_points.middleCols<4>(interval) * basis.transpose();
  if (plan.base_control_points.size() > 0)
    out.base = plan.base_control_points.middleCols<4>(interval) * basis.transpose();
  return out;
}

void at_polynomials(const Eigen::Matrix<double, Eigen::Dynamic, 4>& rows, double length, double s,
                    Eigen::Ref<Eigen::VectorXd> position, Eigen::Ref<Eigen::VectorXd> velocity,
                    Eigen::Ref<Eigen::VectorXd> acceleration) {
  const double rate = 2.0 / length;  // ds/dt
  position.noalias() = rows * Eigen::Vector4d(1.0, s, s * s, s * s * s);
  velocity.noalias() = rows * (rate * Eigen::Vector4d(0.0, 1.0, 2.0 * s, 3.0 * s * s));
  acceleration.noalias() = rows * (rate * rate * Eigen::Vector4d(0.0, 0.0, 2.0, 6.0 * s));
}

PhaseGain phase_gain(const PlanarPlan& plan, int phase) {
  return std::visit([&](auto law) { return law.gain(plan, phase); }, plan.force_law);
}

void Evaluation::at(const IntervalSplines& splines, const PhaseGain& gain, double s) {
  const PlanarTask& task = plan_.task;
  const PlanarPhase& phase = task.phases[splines.phase];
  PlanarConfiguration& x = state.configuration;
  const Eigen::Index joints = task.robot.joint_count();
  x.q.resize(joints);
  x.velocity.resize(joints);
  x.acceleration.resize(joints);
  at_polynomials(splines.joints, splines.length, s, x.q, x.velocity, x.acceleration);
  if (splines.base.rows() > 0)
    at_polynomials(splines.base, splines.length, s, x.base, x.base_velocity, x.base_acceleration);
  else
    compute_base(phase);

  state.phase = splines.phase;
  frames = planar_kinematics(task.robot, x);
  compute_contacts(phase);
  compute_momentum();
  compute_forces(splines, gain, s);
  compute_torques();
}

/// Eqs. (9)-(12) and their derivatives in time: with a base at rest at the origin, contact i is at r_i, turned by a_i;
///
///     angle = mean(expected angle_i - a_i),   position = mean(expected_i - R r_i),   d/dt (R r) = R (r' + w J r),
///     d2/dt2 (R r) = R (r'' + 2 w J r' + w' J r - w^2 r),   J v: v turned to its left
void Evaluation::compute_base(const PlanarPhase& phase) {
  PlanarConfiguration& x = state.configuration;
  x.base.setZero();
  x.base_velocity.setZero();
  x.base_acceleration.setZero();
  frames = planar_kinematics(plan_.task.robot, x);

  const double ratio = 1.0 / static_cast<double>(phase.contacts.size());
  soles.clear();
  for (const PlanarContact& contact : phase.contacts) {
    soles.push_back(sole_of(plan_.task.robot, frames, contact.end_effector));
    x.base[2] += ratio * (contact.angle - soles.back().angle);
    x.base_velocity[2] -= ratio * soles.back().rate;
    x.base_acceleration[2] -= ratio * soles.back().angular_acceleration;
  }
  Eigen::Matrix2d turn;
  turn << std::cos(x.base[2]), -std::sin(x.base[2]), std::sin(x.base[2]), std::cos(x.base[2]);
  const double w = x.base_velocity[2], w_dot = x.base_acceleration[2];
  for (std::size_t i = 0; i < soles.size(); ++i) {
    const Vector2d &r = soles[i].position_W, &v = soles[i].velocity_W, &a = soles[i].acceleration_W;
    x.base.head<2>() += ratio * (phase.contacts[i].position_W - turn * r);
    x.base_velocity.head<2>() -= ratio * turn * (v + w * left_of(r));
    x.base_acceleration.head<2>() -= ratio * turn * (a + 2.0 * w * left_of(v) + w_dot * left_of(r) - w * w * r);
  }
}

void Evaluation::compute_contacts(const PlanarPhase& phase) {
  soles.clear();
  state.contact_error.clear();
  for (const PlanarContact& contact : phase.contacts) {
    soles.push_back(sole_of(plan_.task.robot, frames, contact.end_effector));
    const Vector2d off_W = soles.back().position_W - contact.position_W;
    state.contact_error.emplace_back(off_W.x(), off_W.y(), soles.back().angle - contact.angle);
  }
}

void Evaluation::compute_momentum() {
  const PlanarRobot& robot = plan_.task.robot;
  state.com_W.setZero();
  state.com_velocity_W.setZero();
  state.angular_momentum = 0.0;  // about the world's origin, until the CoM is known
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    const PlanarBody& body = robot.bodies[b];
    const PlanarMotionOfFrame com = planar_point(frames[b], body.com_B);
    state.com_W += body.mass * com.position_W;
    state.com_velocity_W += body.mass * com.velocity_W;
    state.angular_momentum += body.inertia * com.rate + body.mass * cross(com.position_W, com.velocity_W);
  }
  const double mass = robot.mass();
  state.com_W /= mass;
  state.com_velocity_W /= mass;
  state.angular_momentum -= mass * cross(state.com_W, state.com_velocity_W);
}

/// Forces as the law gives them, at the actual places of the points.
void Evaluation::compute_forces(const IntervalSplines& splines, const PhaseGain& gain, double s) {
  const PlanarTask& task = plan_.task;
  const PlanarPhase& phase = task.phases[splines.phase];
  std::visit([&](auto law) { law.set_components({plan_, splines, gain, frames, s}, components_); }, plan_.force_law);

  state.forces.clear();
  for (std::size_t i = 0; i < phase.contacts.size(); ++i) {
    const PlanarContact& contact = phase.contacts[i];
    const PlanarEndEffector& end = task.robot.end_effectors[contact.end_effector];
    const Vector2d tangent_W(std::cos(contact.angle), std::sin(contact.angle));
    for (std::size_t point = 0; point < end.points.size(); ++point) {
      const Eigen::Index v = 2 * static_cast<Eigen::Index>(state.forces.size());
      PlanarPointForce force;
      force.contact = static_cast<int>(i);
      force.end_effector = contact.end_effector;
      force.surface = contact.surface;
      force.point = static_cast<int>(point);
      force.position_W = planar_point(soles[i], {end.points[point], 0.0}).position_W;
      force.tangential = components_[v];
      force.normal = components_[v + 1];
      force.force_W = force.tangential * tangent_W + force.normal * left_of(tangent_W);
      state.forces.push_back(force);
    }
  }
}

void Evaluation::compute_torques() {
  forces_.clear();
  for (const PlanarPointForce& force : state.forces)
    forces_.push_back({plan_.task.robot.end_effectors[force.end_effector].body, force.position_W, force.force_W});
  const PlanarInverseDynamics dynamics = planar_inverse_dynamics(plan_.task.robot, frames, forces_);
  state.torque = dynamics.torque;
  state.base_residual = dynamics.base_residual;
}

}  // namespace mcplan::planar
