#include "law_one_force.hpp"

namespace mcplan::laws {

using Eigen::Vector3d;

/// Beside the CoM the small-angle rotation of the paper, eqs. (10)-(11): theta'' = I^-1 sum tau_l.
void Pendulum::set_motion(const PhaseInstant& at, PlanState& state) {
  const Knot& from = at.from;
  const Vector3d& inertia = at.plan.robot.inertia;
  const double tau = at.since_start;
  const Pull pull(at.plan, at.phase);
  set_com(at, pull, EntireFunctions(pull.stiffness * tau * tau), state);

  Vector3d moment = Vector3d::Zero();
  for (const Contact& contact : at.phase.contacts) moment += contact.moment_W;
  const Vector3d spin_up = moment.cwiseQuotient(inertia);
  state.base_rpy = from.base_rpy + tau * from.base_rpy_rate + 0.5 * tau * tau * spin_up;
  state.base_rpy_rate = from.base_rpy_rate + tau * spin_up;
  state.angular_momentum_W = inertia.cwiseProduct(state.base_rpy_rate);
  set_forces(at, &Contact::anchor_W, state);
}

}  // namespace mcplan::laws
