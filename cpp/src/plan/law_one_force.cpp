#include "law_one_force.hpp"

#include <Eigen/Geometry>
#include <cstddef>

#include "mcplan/base/error.hpp"
#include "mcplan/plan/plan.hpp"

namespace mcplan {

using Eigen::Vector3d;

Pull::Pull(const Plan& plan, const Phase& phase) : pull_W(0.0, 0.0, plan.scene.gravity) {
  for (const Contact& contact : phase.contacts) {
    stiffness += contact.stiffness;
    pull_W += contact.stiffness * contact.anchor_W;
  }
}

namespace laws {

void set_com(const PhaseInstant& at, const Pull& pull, const EntireFunctions& f, PlanState& state) {
  const double tau = at.since_start;
  const Vector3d acceleration = pull.acceleration_W(at.from.com_W);
  state.com_W = at.from.com_W + tau * f(1) * at.from.com_velocity_W + tau * tau * f(2) * acceleration;
  state.com_velocity_W = f(0) * at.from.com_velocity_W + tau * f(1) * acceleration;
  state.com_acceleration_W = pull.acceleration_W(state.com_W);
}

void set_forces(const PhaseInstant& at, Vector3d Contact::*acts_at_W, PlanState& state) {
  for (std::size_t l = 0; l < at.phase.contacts.size(); ++l) {
    const Contact& contact = at.phase.contacts[l];
    EndEffectorState& end = state.end_effectors[l];
    end.force_W = at.plan.robot.mass * contact.stiffness * (state.com_W - contact.anchor_W);
    if (contact.surface >= 0) end.center_of_pressure_W = contact.*acts_at_W;
  }
}

void OneForce::set_moments(const Phase& phase, PlanState& state) {
  for (std::size_t l = 0; l < phase.contacts.size(); ++l) {
    EndEffectorState& end = state.end_effectors[l];
    end.moment_W = phase.contacts[l].moment_W;
    if (end.surface >= 0) end.moment_W += (end.center_of_pressure_W - end.position_W).cross(end.force_W);
  }
}

void OneForce::validate(const Phase& phase, const std::string& field) {
  if (phase.intervals != 0)
    throw InvalidPlan(field + ".intervals", "must be 0 where the law has no forces at points", text(phase.intervals));
}

void OneForce::validate_contact(const Phase& /*phase*/, const Contact& contact, const std::string& field) {
  const int points = static_cast<int>(contact.points_W.size()),
            forces = static_cast<int>(contact.point_forces_W.size());
  if (points > 0)
    throw InvalidPlan(field + ".points", "must be none where the law has no forces at points", text(points));
  if (forces > 0) throw InvalidPlan(field + ".point_forces", "must be one per node and point (0)", text(forces));
}

}  // namespace laws
}  // namespace mcplan
