#include "evaluation.hpp"
#include "require.hpp"

namespace mcplan::planar_laws {

/// None: forces do not follow from the motion.
Gain Polynomial::gain(const PlanarPlan& /*plan*/, int /*phase*/) { return {}; }

void Polynomial::set_components(const Instant& at, Eigen::VectorXd& components) {
  components.noalias() = at.plan.force_polynomials[at.splines.interval].transpose() *
                         Eigen::Vector4d(1.0, at.s, at.s * at.s, at.s * at.s * at.s);
}

void Polynomial::require_shape(const PlanarPlan& plan) {
  const PlanarTask& task = plan.task;
  const int intervals = task.interval_count();
  require_size("force_polynomials", plan.force_polynomials.size(), intervals);
  for (int i = 0; i < intervals; ++i)
    planar::require_matrix("force_polynomials[" + std::to_string(i) + "]", plan.force_polynomials[i], 4,
                           2 * planar::point_count(task, task.phases[task.phase_of(i)]));
}

void Polynomial::validate(const PlanarPlan& plan) {
  for (std::size_t i = 0; i < plan.force_polynomials.size(); ++i)
    planar::require_finite("force_polynomials[" + std::to_string(i) + "]", plan.force_polynomials[i]);
}

void Polynomial::clear_others(PlanarPlan& plan) { plan.weights.clear(); }

}  // namespace mcplan::planar_laws
