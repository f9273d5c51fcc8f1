#pragma once

#include <Eigen/Dense>

#include "mcplan/base/rotation.hpp"
#include "plan/fixtures.hpp"

/// Plans of contact wrenches, made by hand, and the numerical integration that they come from.
namespace fixtures {

using Eigen::Matrix3d;

/// CoM, angular momentum and orientation.
struct Body {
  Vector3d com, velocity, momentum;
  Matrix3d turned;
};

inline Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d out;
  out << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return out;
}

/// Columns: where rates of roll, pitch and yaw turn about, from R' R^T of each of them alone.
inline Matrix3d turning_axes(const Vector3d& rpy) {
  Matrix3d axes;
  for (int i = 0; i < 3; ++i) {
    const Matrix3d spin = mcplan::rotation_derivative(rpy, i) * mcplan::rotation_from_rpy(rpy).transpose();
    axes.col(i) = Vector3d(spin(2, 1), spin(0, 2), spin(1, 0));
  }
  return axes;
}

inline Vector3d rpy_of(const Matrix3d& r) {
  return {std::atan2(r(2, 1), r(2, 2)), std::asin(-r(2, 0)), std::atan2(r(1, 0), r(0, 0))};
}

inline double angle_between(const Matrix3d& a, const Matrix3d& b) {
  const Eigen::AngleAxisd turn(a.transpose() * b);
  return std::abs(turn.angle());
}

/// m p'' = sum f_l - m g, L' = sum ((a_l - p) x f_l + tau_l), R' = [R I^-1 R^T L]x R  with  f_l = m mu_l (p - s_l), in
/// `steps` steps of RK4.
inline Body integrate_wrenches(const mcplan::Plan& plan, int phase, double until, int steps = 2000) {
  const auto rate = [&](const Body& b) {
    Body slope{b.velocity, Vector3d(0, 0, -plan.scene.gravity), Vector3d::Zero(), Matrix3d::Zero()};
    for (const auto& contact : plan.phases[phase].contacts) {
      const Vector3d force = plan.robot.mass * contact.stiffness * (b.com - contact.anchor_W);
      slope.velocity += force / plan.robot.mass;
      slope.momentum += (contact.center_of_pressure_W - b.com).cross(force) + contact.moment_W;
    }
    const Vector3d in_base = b.turned.transpose() * b.momentum;
    slope.turned = cross_matrix(b.turned * in_base.cwiseQuotient(plan.robot.inertia)) * b.turned;
    return slope;
  };
  const auto add = [](const Body& b, double h, const Body& slope) {
    return Body{b.com + h * slope.com, b.velocity + h * slope.velocity, b.momentum + h * slope.momentum,
                b.turned + h * slope.turned};
  };
  const mcplan::Knot& from = plan.knots[phase];
  Body b{from.com_W, from.com_velocity_W, from.angular_momentum_W, mcplan::rotation_from_rpy(from.base_rpy)};
  const double h = until / steps;
  for (int i = 0; i < steps; ++i) {
    const Body k1 = rate(b), k2 = rate(add(b, h / 2, k1)), k3 = rate(add(b, h / 2, k2)), k4 = rate(add(b, h, k3));
    b = add(add(add(add(b, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
  }
  return b;
}

/// Rates of the angles that the momentum of a knot gives.
inline void set_base_rate(mcplan::Knot& knot, const Vector3d& inertia) {
  const Matrix3d r = mcplan::rotation_from_rpy(knot.base_rpy);
  const Vector3d omega = r * (r.transpose() * knot.angular_momentum_W).cwiseQuotient(inertia);
  knot.base_rpy_rate = turning_axes(knot.base_rpy).inverse() * omega;
}

/// CoM, momentum and base of the knots from `first` on as they follow from that one and the forces.
inline void replay_wrench_knots(mcplan::Plan& plan, int first = 0) {
  set_base_rate(plan.knots[first], plan.robot.inertia);
  for (std::size_t k = first; k < plan.phases.size(); ++k) {
    const Body end = integrate_wrenches(plan, static_cast<int>(k), plan.phases[k].duration);
    mcplan::Knot& next = plan.knots[k + 1];
    next.com_W = end.com;
    next.com_velocity_W = end.velocity;
    next.angular_momentum_W = end.momentum;
    next.base_rpy = rpy_of(end.turned);
    set_base_rate(next, plan.robot.inertia);
  }
}

/// The forces of a pendulum's plan act at their anchors, and every sole heads straight ahead.
inline void give_wrenches(mcplan::Plan& plan) {
  for (auto& phase : plan.phases) {
    phase.law = mcplan::laws::Wrench();
    for (auto& contact : phase.contacts) contact.center_of_pressure_W = contact.anchor_W;
  }
  for (auto& knot : plan.knots) knot.end_effector_yaw.assign(4, 0.0);
}

/// The walk, its base turned to the left in the first two phases and back in the last two: by feet that push opposite
/// ways along x, which moves nothing but L, and in the same phases tilted a little by centres of pressure 1 mm ahead of
/// the line of force, or behind it.
inline mcplan::Plan wrench_walk() {
  mcplan::Plan plan = walk();
  give_wrenches(plan);
  const double signs[][2] = {{0, 1}, {1, -1}, {10, -1}, {11, 1}};
  for (const auto& [k, sign] : signs) {
    auto& feet = plan.phases[static_cast<int>(k)].contacts;
    const double apart = feet[left_foot].anchor_W.y() - feet[right_foot].anchor_W.y();
    const double push = sign * 1.5 / (plan.robot.mass * apart);  // 1.5 N m
    feet[left_foot].anchor_W.x() += push / feet[left_foot].stiffness;
    feet[right_foot].anchor_W.x() -= push / feet[right_foot].stiffness;
    for (int foot : {left_foot, right_foot}) feet[foot].center_of_pressure_W.x() += sign * 1e-3;
  }
  replay_wrench_knots(plan);
  return plan;
}

/// Three phases at rest on two feet 15 mm behind the CoM, with vertical forces under the CoM's x: s_l lies below the
/// CoM, 0.1 m beside the foot.
inline mcplan::Plan stand_on_wrenches() {
  mcplan::Plan plan;
  plan.scene = hall();
  plan.scene.goal = plan.scene.start;
  plan.robot = biped();
  mcplan::Knot knot;
  knot.com_W.z() = kHeight;
  knot.end_effectors_W = {{-0.015, 0.1, 0}, {-0.015, -0.1, 0}, {0, 0.3, 0.75}, {0, -0.3, 0.75}};
  knot.end_effector_velocities_W.assign(4, Vector3d::Zero());
  knot.end_effector_yaw.assign(4, 0.0);
  mcplan::Phase phase;
  phase.duration = kPhase;
  phase.law = mcplan::laws::Wrench();
  phase.contacts.resize(4);
  for (int foot : {left_foot, right_foot}) {
    phase.contacts[foot].surface = ground;
    phase.contacts[foot].stiffness = 0.5 * kGravity / (kHeight + 0.2);
    phase.contacts[foot].anchor_W = {0.0, 0.0, -0.2};
    phase.contacts[foot].center_of_pressure_W = {0.0, foot == left_foot ? 0.1 : -0.1, 0.0};
  }
  plan.knots.assign(4, knot);
  plan.phases.assign(3, phase);
  plan.final_contacts = {ground, ground, -1, -1};
  return plan;
}

/// One phase of free flight with a spin.
inline mcplan::Plan spinning_flight(const Vector3d& momentum, const Vector3d& inertia) {
  mcplan::Plan plan = flight();
  plan.robot.inertia = inertia;
  plan.measured_start = plan.open_end = true;
  plan.phases[0].law = mcplan::laws::Wrench();
  plan.knots[0].com_velocity_W = {0.5, 0.0, 2.0};
  plan.knots[0].angular_momentum_W = momentum;
  plan.knots[1] = plan.knots[0];
  replay_wrench_knots(plan);
  for (auto& knot : plan.knots)
    for (int l = 0; l < 4; ++l) {
      knot.end_effectors_W[l] =
          knot.com_W + mcplan::rotation_from_rpy(knot.base_rpy) * plan.robot.end_effectors[l].nominal_B;
      knot.end_effector_velocities_W[l] = knot.com_velocity_W;
    }
  return plan;
}

}  // namespace fixtures
