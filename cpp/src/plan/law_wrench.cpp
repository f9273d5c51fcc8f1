#include <Eigen/Geometry>
#include <optional>

#include "base/base_rotation.hpp"
#include "law_one_force.hpp"

namespace mcplan {

using Eigen::Vector3d;

WrenchSums::WrenchSums(const Plan& plan, const Phase& phase, const Knot& from)
    : pull(plan, phase),
      turning(from.base_rpy, from.angular_momentum_W, plan.robot.inertia),
      rho(Vector3d::Zero()),
      steady(Vector3d::Zero()) {
  for (const Contact& contact : phase.contacts) {
    const Vector3d line = contact.anchor_W - contact.center_of_pressure_W;
    rho += contact.stiffness * line;
    steady += contact.moment_W / plan.robot.mass - contact.stiffness * contact.center_of_pressure_W.cross(line);
  }
}

namespace laws {

/// The pendulum about s_l with forces that act at a_l. With P(t) the integral of the CoM's position and rho = sum mu_l
/// r_l, r_l = s_l - a_l,
///
///     L(t) = L + m (P(t) x rho - t sum mu_l a_l x r_l) + t sum tau_l
void Wrench::set_motion(const PhaseInstant& at, PlanState& state) {
  const std::optional<WrenchSums> own =
      at.shared == nullptr ? std::make_optional<WrenchSums>(at.plan, at.phase, at.from) : std::nullopt;
  const WrenchSums& sums = own ? *own : *at.shared;
  const Knot& from = at.from;
  const double tau = at.since_start, mass = at.plan.robot.mass;
  const EntireFunctions f(sums.pull.stiffness * tau * tau), half(0.25 * sums.pull.stiffness * tau * tau);
  set_com(at, sums.pull, f, state);

  const Vector3d acceleration = sums.pull.acceleration_W(from.com_W);
  const auto momentum_at = [&](double t, const EntireFunctions& functions) -> Vector3d {
    const Vector3d travelled =
        t * from.com_W + t * t * (functions(2) * from.com_velocity_W + t * functions(3) * acceleration);
    return from.angular_momentum_W + mass * (travelled.cross(sums.rho) + t * sums.steady);
  };
  state.angular_momentum_W = momentum_at(tau, f);
  state.base_rpy = sums.turning.rpy(momentum_at(0.5 * tau, half), state.angular_momentum_W, tau);
  set_forces(at, &Contact::center_of_pressure_W, state);
}

void Wrench::set_base_rate(const RpyTrig& trig, const Vector3d& inertia, PlanState& state) {
  state.base_rpy_rate = rpy_rate(trig, state.angular_momentum_W, inertia);
}

}  // namespace laws
}  // namespace mcplan
