#include <Eigen/Geometry>
#include <cstddef>
#include <string>
#include <vector>

#include "hermite.hpp"
#include "mcplan/base/error.hpp"
#include "phase_instant.hpp"
#include "plan/point_forces.hpp"

namespace mcplan::laws {
namespace {

using Eigen::Vector3d;

/// a = sum (n . f_i) p_i / sum (n . f_i), where the forces at points press at all.
void set_center_of_pressure(const Plan& plan, int surface, EndEffectorState& end) {
  if (end.points_W.empty() || surface < 0 || surface >= static_cast<int>(plan.scene.surfaces.size())) return;
  const std::vector<Vector3d>& corners = plan.scene.surfaces[surface].vertices_W;
  if (corners.size() < 3) return;
  const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[1]);  // of any length
  double pressed = 0.0;
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < end.points_W.size(); ++i) {
    const double press = normal.dot(end.point_forces_W[i]);
    pressed += press;
    sum += press * end.points_W[i];
  }
  if (pressed > 1e-9 * normal.norm()) end.center_of_pressure_W = sum / pressed;
}

void require_intervals(const Phase& phase, const std::string& field) {
  if (phase.intervals < 1 || phase.intervals > Phase::max_intervals)
    throw InvalidPlan(field + ".intervals",
                      "must lie in [1, " + text(Phase::max_intervals) + "] where forces act at points",
                      text(phase.intervals));
}

/// A force for each node and point.
void require_forces(const Phase& phase, const Contact& contact, const std::string& field) {
  const std::size_t expected = static_cast<std::size_t>(phase.node_count()) * contact.points_W.size();
  if (contact.point_forces_W.size() != expected)
    throw InvalidPlan(field + ".point_forces", "must be one per node and point (" + std::to_string(expected) + ")",
                      std::to_string(contact.point_forces_W.size()));
}

template <class Number>
void require_zero(const Number& number, const Number& zero, const std::string& contact, const char* member) {
  if (number != zero) throw InvalidPlan(contact + "." + member, "must be 0 where forces act at points", text(number));
}

}  // namespace

void PointForces::set_motion(const PhaseInstant& at, PlanState& state) {
  const Plan& plan = at.plan;
  const Phase& phase = at.phase;
  const Knot &from = at.from, &to = at.to;
  const double tau = at.since_start;
  const double mass = plan.robot.mass, gravity = plan.scene.gravity;
  const CentroidalState motion =
      integrate_phase(phase, {from.com_W, from.com_velocity_W, from.angular_momentum_W}, tau, mass, gravity);
  state.com_W = motion.com_W;
  state.com_velocity_W = motion.com_velocity_W;
  state.angular_momentum_W = motion.angular_momentum_W;

  Hermite(phase.duration, tau / phase.duration)
      .put(from.base_rpy, from.base_rpy_rate, to.base_rpy, to.base_rpy_rate, state.base_rpy, state.base_rpy_rate);

  const IntervalTime within = interval_time(phase, tau);
  state.com_acceleration_W = Vector3d(0.0, 0.0, -gravity);
  for (std::size_t l = 0; l < phase.contacts.size(); ++l) {
    EndEffectorState& end = state.end_effectors[l];
    end.points_W = phase.contacts[l].points_W;
    end.point_forces_W = point_forces(phase, phase.contacts[l], within);
    end.force_W = Vector3d::Zero();
    for (const Vector3d& force : end.point_forces_W) end.force_W += force;
    state.com_acceleration_W += end.force_W / mass;
    set_center_of_pressure(plan, phase.contacts[l].surface, end);
  }
}

void PointForces::set_moments(const Phase& /*phase*/, PlanState& state) {
  for (EndEffectorState& end : state.end_effectors) {
    end.moment_W = Vector3d::Zero();
    for (std::size_t i = 0; i < end.points_W.size(); ++i)
      end.moment_W += (end.points_W[i] - end.position_W).cross(end.point_forces_W[i]);
  }
}

void PointForces::require_queryable(const Phase& phase, int k) {
  const auto field = [k] { return "phases[" + std::to_string(k) + "]"; };  // names take longer than all the rest
  if (phase.intervals < 1 || phase.intervals > Phase::max_intervals) require_intervals(phase, field());
  const std::size_t nodes = static_cast<std::size_t>(phase.node_count());
  for (std::size_t l = 0; l < phase.contacts.size(); ++l) {
    const Contact& contact = phase.contacts[l];
    if (contact.point_forces_W.size() != nodes * contact.points_W.size())
      require_forces(phase, contact, field() + ".contacts[" + std::to_string(l) + "]");
  }
}

void PointForces::validate(const Phase& phase, const std::string& field) { require_intervals(phase, field); }

void PointForces::validate_contact(const Phase& phase, const Contact& contact, const std::string& field) {
  if (!contact.points_W.empty() && contact.surface < 0)
    throw InvalidPlan(field + ".points", "must be none at a free end-effector",
                      std::to_string(contact.points_W.size()));
  require_forces(phase, contact, field);
  const Vector3d zero = Vector3d::Zero();
  require_zero(contact.stiffness, 0.0, field, "stiffness");
  require_zero(contact.anchor_W, zero, field, "anchor");
  require_zero(contact.moment_W, zero, field, "moment");
  require_zero(contact.center_of_pressure_W, zero, field, "center_of_pressure");
}

}  // namespace mcplan::laws
