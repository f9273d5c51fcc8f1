#include "base/entire_functions.hpp"
#include "phase_instant.hpp"

namespace mcplan::laws {

using Eigen::Vector3d;

/// p'' = Lambda p - sum mu_l s_l - g, solved by the entire functions (docs/theory/ddp.md, "Closed form"), and the
/// small-angle rotation of the paper, eqs. (10)-(11): theta'' = I^-1 sum tau_l.
void Pendulum::set_motion(const PhaseInstant& at, PlanState& state) {
  const Plan& plan = at.plan;
  const Phase& phase = at.phase;
  const Knot& from = at.from;
  const double tau = at.since_start;
  double stiffness = 0.0;
  Vector3d pull(0.0, 0.0, plan.scene.gravity), moment = Vector3d::Zero();
  for (const Contact& contact : phase.contacts) {
    stiffness += contact.stiffness;
    pull += contact.stiffness * contact.anchor_W;
    moment += contact.moment_W;
  }
  const EntireFunctions f(stiffness * tau * tau);
  const Vector3d acceleration = stiffness * from.com_W - pull;
  state.com_W = from.com_W + tau * f(1) * from.com_velocity_W + tau * tau * f(2) * acceleration;
  state.com_velocity_W = f(0) * from.com_velocity_W + tau * f(1) * acceleration;
  state.com_acceleration_W = stiffness * state.com_W - pull;

  const Vector3d spin_up = moment.cwiseQuotient(plan.robot.inertia);
  state.base_rpy = from.base_rpy + tau * from.base_rpy_rate + 0.5 * tau * tau * spin_up;
  state.base_rpy_rate = from.base_rpy_rate + tau * spin_up;
  state.angular_momentum_W = plan.robot.inertia.cwiseProduct(state.base_rpy_rate);

  for (std::size_t l = 0; l < phase.contacts.size(); ++l) {
    const Contact& contact = phase.contacts[l];
    state.end_effectors[l].force_W = plan.robot.mass * contact.stiffness * (state.com_W - contact.anchor_W);
    if (contact.surface >= 0) state.end_effectors[l].center_of_pressure_W = contact.anchor_W;
  }
}

}  // namespace mcplan::laws
