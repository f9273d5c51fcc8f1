#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>

#include "mcplan/base/error.hpp"
#include "mcplan/planar/task.hpp"
#include "plan/plan_shape.hpp"

/// What validate.cpp and the force laws hold a plan's arrays to. All throw InvalidPlan.
namespace mcplan::planar {

/// Throws InvalidPlanarTask when a phase has no piece of a spline, or more than can be meant.
void require_intervals(const PlanarTask& task);

inline void require_matrix(const std::string& field, const Eigen::MatrixXd& matrix, Eigen::Index rows,
                           Eigen::Index columns) {
  if (matrix.rows() != rows || matrix.cols() != columns)
    throw InvalidPlan(field, "must be " + std::to_string(rows) + " x " + std::to_string(columns),
                      std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols()));
}

inline void require_positive(const std::string& field, double value) {
  if (!(std::isfinite(value) && value > 0.0)) throw InvalidPlan(field, "must be a positive number", text(value));
}

inline void require_finite(const std::string& field, const Eigen::MatrixXd& matrix) {
  if (!matrix.allFinite()) throw InvalidPlan(field, "must be finite numbers", "nan or inf");
}

/// Points in contact in a phase.
inline std::size_t point_count(const PlanarTask& task, const PlanarPhase& phase) {
  std::size_t count = 0;
  for (const PlanarContact& contact : phase.contacts)
    count += task.robot.end_effectors[contact.end_effector].points.size();
  return count;
}

}  // namespace mcplan::planar
