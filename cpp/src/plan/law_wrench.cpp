#include <Eigen/Geometry>

#include "base/base_rotation.hpp"
#include "base/entire_functions.hpp"
#include "phase_instant.hpp"

namespace mcplan::laws {

using Eigen::Vector3d;

/// The pendulum about s_l with forces that act at a_l. With P(t) the integral of the CoM's position and rho = sum mu_l
/// r_l, r_l = s_l - a_l,
///
///     L(t) = L + m (P(t) x rho - t sum mu_l a_l x r_l) + t sum tau_l
void Wrench::set_motion(const PhaseInstant& at, PlanState& state) {
  const Plan& plan = at.plan;
  const Phase& phase = at.phase;
  const Knot& from = at.from;
  const double tau = at.since_start;
  const double mass = plan.robot.mass;
  double stiffness = 0.0;
  Vector3d pull(0.0, 0.0, plan.scene.gravity), rho = Vector3d::Zero(), steady = Vector3d::Zero();
  for (const Contact& contact : phase.contacts) {
    const Vector3d line = contact.anchor_W - contact.center_of_pressure_W;
    stiffness += contact.stiffness;
    pull += contact.stiffness * contact.anchor_W;
    rho += contact.stiffness * line;
    steady += contact.moment_W / mass - contact.stiffness * contact.center_of_pressure_W.cross(line);
  }
  const Vector3d acceleration = stiffness * from.com_W - pull;
  const auto momentum_at = [&](double t, const EntireFunctions& f) -> Vector3d {
    const Vector3d travelled = t * from.com_W + t * t * (f(2) * from.com_velocity_W + t * f(3) * acceleration);
    return from.angular_momentum_W + mass * (travelled.cross(rho) + t * steady);
  };
  const EntireFunctions f(stiffness * tau * tau), half(0.25 * stiffness * tau * tau);
  state.com_W = from.com_W + tau * f(1) * from.com_velocity_W + tau * tau * f(2) * acceleration;
  state.com_velocity_W = f(0) * from.com_velocity_W + tau * f(1) * acceleration;
  state.com_acceleration_W = stiffness * state.com_W - pull;
  state.angular_momentum_W = momentum_at(tau, f);
  state.base_rpy = BaseRotation(from.base_rpy, from.angular_momentum_W, plan.robot.inertia)
                       .rpy(momentum_at(0.5 * tau, half), state.angular_momentum_W, tau);
  state.base_rpy_rate = rpy_rate(state.base_rpy, state.angular_momentum_W, plan.robot.inertia);

  for (std::size_t l = 0; l < phase.contacts.size(); ++l) {
    const Contact& contact = phase.contacts[l];
    EndEffectorState& end = state.end_effectors[l];
    end.force_W = mass * contact.stiffness * (state.com_W - contact.anchor_W);
    if (contact.surface >= 0) end.center_of_pressure_W = contact.center_of_pressure_W;
  }
}

}  // namespace mcplan::laws
