#include <cmath>

#include "evaluation.hpp"

namespace mcplan {
namespace planar {
namespace {

template <class Size>
void require_size(const std::string& field, Size size, std::size_t wanted) {
  if (static_cast<std::size_t>(size) != wanted)
    throw InvalidPlan(field, "must have " + std::to_string(wanted) + " entries", std::to_string(size));
}

void require_matrix(const std::string& field, const Eigen::MatrixXd& matrix, Eigen::Index rows, Eigen::Index columns) {
  if (matrix.rows() != rows || matrix.cols() != columns)
    throw InvalidPlan(field, "must be " + std::to_string(rows) + " x " + std::to_string(columns),
                      std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols()));
}

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
  for (std::size_t k = 0; k < task.phases.size(); ++k) {
    const PlanarPhase& phase = task.phases[k];
    const std::string field = "phases[" + std::to_string(k) + "].contacts";
    if (phase.intervals < 1)
      throw InvalidPlanarTask("phases[" + std::to_string(k) + "].intervals", "must be at least 1",
                              text(phase.intervals));
    if (phase.contacts.empty()) throw InvalidPlanarTask(field, "needs at least one contact", "none");
    for (const PlanarContact& contact : phase.contacts) {
      require_index(field, contact.end_effector, robot.end_effectors.size());
      require_index(field, contact.surface, task.surfaces.size());
    }
  }
}

std::size_t point_count(const PlanarTask& task, const PlanarPhase& phase) {
  std::size_t count = 0;
  for (const PlanarContact& contact : phase.contacts)
    count += task.robot.end_effectors[contact.end_effector].points.size();
  return count;
}

}  // namespace

void require_shape(const PlanarPlan& plan) {
  const PlanarTask& task = plan.task;
  require_indices(task);
  const std::size_t phases = task.phases.size();
  const int intervals = task.interval_count();
  require_size("durations", plan.durations.size(), phases);
  require_matrix("control_points", plan.control_points, task.robot.joint_count(), intervals + 3);
  if (plan.base_control_points.size() > 0)
    require_matrix("base_control_points", plan.base_control_points, 3, intervals + 3);
  if (plan.force_law == PlanarForceLaw::least_norm) {
    require_size("weights", plan.weights.size(), phases);
    for (std::size_t k = 0; k < phases; ++k)
      require_size("weights[" + std::to_string(k) + "]", plan.weights[k].size(), point_count(task, task.phases[k]));
    return;
  }
  require_size("force_polynomials", plan.force_polynomials.size(), intervals);
  for (int i = 0; i < intervals; ++i)
    require_matrix("force_polynomials[" + std::to_string(i) + "]", plan.force_polynomials[i], 4,
                   2 * point_count(task, task.phases[task.phase_of(i)]));
}

}  // namespace planar

namespace {

void require_positive(const std::string& field, double value) {
  if (!(std::isfinite(value) && value > 0.0)) throw InvalidPlan(field, "must be a positive number", text(value));
}

void require_finite(const std::string& field, const Eigen::MatrixXd& matrix) {
  if (!matrix.allFinite()) throw InvalidPlan(field, "must be finite numbers", "nan or inf");
}

}  // namespace

void PlanarPlan::validate() const {
  task.validate();
  planar::require_shape(*this);
  for (std::size_t k = 0; k < durations.size(); ++k)
    require_positive("durations[" + std::to_string(k) + "]", durations[k]);
  require_finite("control_points", control_points);
  require_finite("base_control_points", base_control_points);
  if (force_law == PlanarForceLaw::least_norm) {
    for (std::size_t k = 0; k < weights.size(); ++k) {
      for (Eigen::Index v = 0; v < weights[k].size(); ++v)
        require_positive("weights[" + std::to_string(k) + "][" + std::to_string(v) + "]", weights[k][v]);
      least_norm_gain(task, static_cast<int>(k), weights[k]);
    }
  } else {
    for (std::size_t i = 0; i < force_polynomials.size(); ++i)
      require_finite("force_polynomials[" + std::to_string(i) + "]", force_polynomials[i]);
  }
}

}  // namespace mcplan
