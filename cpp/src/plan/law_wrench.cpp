#include <Eigen/Geometry>

#include "base/base_rotation.hpp"
#include "law_one_force.hpp"

namespace mcplan::laws {

using Eigen::Vector3d;

/// The pendulum about s_l with forces that act at a_l. With P(t) the integral of the CoM's position and rho = sum mu_l
/// r_l, r_l = s_l - a_l,
///
///     L(t) = L + m (P(t) x rho - t sum mu_l a_l x r_l) + t sum tau_l
void Wrench::set_motion(const PhaseInstant& at, PlanState& state) {
  const Knot& from = at.from;
  const Vector3d& inertia = at.plan.robot.inertia;
  const double tau = at.since_start, mass = at.plan.robot.mass;
  const Pull pull(at);
  const EntireFunctions f(pull.stiffness * tau * tau), half(0.25 * pull.stiffness * tau * tau);
  set_com(at, pull, f, state);

  Vector3d rho = Vector3d::Zero(), steady = Vector3d::Zero();
  for (const Contact& contact : at.phase.contacts) {
    const Vector3d line = contact.anchor_W - contact.center_of_pressure_W;
    rho += contact.stiffness * line;
    steady += contact.moment_W / mass - contact.stiffness * contact.center_of_pressure_W.cross(line);
  }
  const Vector3d acceleration = pull.acceleration_W(from.com_W);
  const auto momentum_at = [&](double t, const EntireFunctions& functions) -> Vector3d {
    const Vector3d travelled =
        t * from.com_W + t * t * (functions(2) * from.com_velocity_W + t * functions(3) * acceleration);
    return from.angular_momentum_W + mass * (travelled.cross(rho) + t * steady);
  };
  state.angular_momentum_W = momentum_at(tau, f);
  const Vector3d middle_W = momentum_at(0.5 * tau, half);
  state.base_rpy =
      at.turning != nullptr
          ? at.turning->rpy(middle_W, state.angular_momentum_W, tau)
          : BaseRotation(from.base_rpy, from.angular_momentum_W, inertia).rpy(middle_W, state.angular_momentum_W, tau);
  state.base_rpy_rate = rpy_rate(state.base_rpy, state.angular_momentum_W, inertia);
  set_forces(at, &Contact::center_of_pressure_W, state);
}

}  // namespace mcplan::laws
