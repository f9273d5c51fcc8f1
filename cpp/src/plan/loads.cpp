#include "mcplan/plan/loads.hpp"

#include <algorithm>
#include <limits>

#include "mcplan/base/error.hpp"
#include "mcplan/scene/polygon.hpp"
#include "phase_state.hpp"
#include "plan_shape.hpp"

namespace mcplan {
namespace {

/// Weights: a contact with a smaller force has no friction to speak of.
constexpr double kNothing = 1e-6;

ContactLoad& load_of(Loads& loads, int end_effector) {
  for (ContactLoad& load : loads.contacts)
    if (load.end_effector == end_effector) return load;
  return loads.contacts.emplace_back(ContactLoad{end_effector, 0.0, 0.0});
}

/// |f - n (n . f)| / (n . f)
double friction_of(const Eigen::Vector3d& force_W, const Eigen::Vector3d& normal_W) {
  const double normal = normal_W.dot(force_W);
  if (normal <= 0.0) return std::numeric_limits<double>::infinity();
  return (force_W - normal * normal_W).norm() / normal;
}

}  // namespace

Loads loads(const Plan& plan, double sample_s) {
  if (!(sample_s > 0.0)) throw InvalidOptions("sample_s", "must be a positive number", text(sample_s));
  plan.validate();
  const double weight = plan.robot.mass * plan.scene.gravity;
  std::vector<Eigen::Vector3d> normals_W;
  for (const Surface& surface : plan.scene.surfaces) normals_W.push_back(Polygon(surface.vertices_W).normal_W());
  Loads out;
  for (int k = 0; k < static_cast<int>(plan.phases.size()); ++k) {
    const PhaseFrame frame = phase_frame(plan, k);
    const double duration = plan.phases[k].duration;
    const int samples = samples_of(plan.phases[k], sample_s);
    for (int i = 0; i <= samples; ++i) {
      const PlanState state = state_in_phase(plan, frame, duration * i / samples);
      out.angular_momentum = std::max(out.angular_momentum, state.angular_momentum_W.norm());
      for (int l = 0; l < plan.end_effector_count(); ++l) {
        const EndEffectorState& end = state.end_effectors[l];
        if (end.surface < 0) continue;
        ContactLoad& load = load_of(out, l);
        const double force = end.force_W.norm();
        load.force = std::max(load.force, force / weight);
        if (force >= kNothing * weight)
          load.friction = std::max(load.friction, friction_of(end.force_W, normals_W[end.surface]));
      }
    }
  }
  return out;
}

}  // namespace mcplan
