#include <Eigen/Geometry>
#include <cstddef>

#include "mcplan/base/error.hpp"
#include "mcplan/plan/plan.hpp"

namespace mcplan::laws {

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

}  // namespace mcplan::laws
