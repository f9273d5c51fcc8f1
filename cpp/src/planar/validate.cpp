#include <variant>

#include "evaluation.hpp"
#include "require.hpp"
#include "task_fields.hpp"

namespace mcplan {
namespace planar {
namespace {

void require_index(const std::string& field, int value, std::size_t count) {
  if (value < 0 || value >= static_cast<int>(count))
    throw InvalidPlanarTask(field, "must be an index below " + std::to_string(count), text(value));
}

/// Indices of the task alone; all else is for PlanarTask::validate().
void require_indices(const PlanarTask& task) {
  const PlanarRobot& robot = task.robot;
  if (robot.bodies.empty()) throw InvalidRobot("bodies", "needs at least one body, the base", "none");
  for (std::size_t b = 1; b < robot.bodies.size(); ++b)
    if (robot.bodies[b].parent < 0 || robot.bodies[b].parent >= static_cast<int>(b))
      throw InvalidRobot("bodies[" + std::to_string(b) + "].parent", "must be an earlier body (no loops)",
                         text(robot.bodies[b].parent));
  for (const PlanarEndEffector& end : robot.end_effectors)
    require_index("end_effectors", end.body, robot.bodies.size());
  if (task.phases.empty()) throw InvalidPlanarTask("phases", "needs at least one phase", "none");
  require_intervals(task);
  for (std::size_t k = 0; k < task.phases.size(); ++k) {
    const PlanarPhase& phase = task.phases[k];
    const std::string field = "phases[" + std::to_string(k) + "].contacts";
    if (phase.contacts.empty()) throw InvalidPlanarTask(field, "needs at least one contact", "none");
    for (const PlanarContact& contact : phase.contacts) {
      require_index(field, contact.end_effector, robot.end_effectors.size());
      require_index(field, contact.surface, task.surfaces.size());
    }
  }
}

}  // namespace

void require_intervals(const PlanarTask& task) {
  for (std::size_t k = 0; k < task.phases.size(); ++k) {
    const int intervals = task.phases[k].intervals;
    if (intervals < 1 || intervals > model::max_phase_intervals)
      throw InvalidPlanarTask("phases[" + std::to_string(k) + "].intervals",
                              "must lie in [1, " + text(model::max_phase_intervals) + "]", text(intervals));
  }
}

void require_shape(const PlanarPlan& plan) {
  const PlanarTask& task = plan.task;
  require_indices(task);
  const std::size_t phases = task.phases.size();
  const int intervals = task.interval_count();
  require_size("durations", plan.durations.size(), phases);
  require_matrix("control_points", plan.control_points, task.robot.joint_count(), intervals + 3);
  if (plan.base_control_points.size() > 0)
    require_matrix("base_control_points", plan.base_control_points, 3, intervals + 3);
  std::visit([&](auto law) { law.require_shape(plan); }, plan.force_law);
}

}  // namespace planar

void PlanarPlan::validate() const {
  task.validate();
  planar::require_shape(*this);
  for (std::size_t k = 0; k < durations.size(); ++k)
    planar::require_positive("durations[" + std::to_string(k) + "]", durations[k]);
  planar::require_finite("control_points", control_points);
  planar::require_finite("base_control_points", base_control_points);
  std::visit([&](auto law) { law.validate(*this); }, force_law);
}

}  // namespace mcplan
