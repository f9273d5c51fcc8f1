#include "evaluation.hpp"
#include "plane.hpp"
#include "require.hpp"

namespace mcplan::planar_laws {

Gain LeastNorm::gain(const PlanarPlan& plan, int phase) {
  Gain out;
  out.moment_point_W = moment_point_W(plan.task, phase);
  out.gain = least_norm_gain(plan.task, phase, plan.weights[phase]);
  return out;
}

/// What is left over at the base without any force is what all forces together have to give.
void LeastNorm::set_components(const Instant& at, Eigen::VectorXd& components) {
  const Eigen::Vector3d desired = planar_inverse_dynamics(at.plan.task.robot, at.frames, {}).base_residual;
  const Eigen::Vector2d to_base_W = at.frames[0].position_W - at.gain.moment_point_W;
  const double moment = desired.z() + planar::cross(to_base_W, desired.head<2>());
  components.noalias() = at.gain.gain * Eigen::Vector3d(desired.x(), desired.y(), moment);
}

void LeastNorm::require_shape(const PlanarPlan& plan) {
  const std::size_t phases = plan.task.phases.size();
  require_size("weights", plan.weights.size(), phases);
  for (std::size_t k = 0; k < phases; ++k)
    require_size("weights[" + std::to_string(k) + "]", plan.weights[k].size(),
                 planar::point_count(plan.task, plan.task.phases[k]));
}

void LeastNorm::validate(const PlanarPlan& plan) {
  for (std::size_t k = 0; k < plan.weights.size(); ++k) {
    for (Eigen::Index v = 0; v < plan.weights[k].size(); ++v)
      planar::require_positive("weights[" + std::to_string(k) + "][" + std::to_string(v) + "]", plan.weights[k][v]);
    least_norm_gain(plan.task, static_cast<int>(k), plan.weights[k]);
  }
}

void LeastNorm::clear_others(PlanarPlan& plan) { plan.force_polynomials.clear(); }

}  // namespace mcplan::planar_laws
