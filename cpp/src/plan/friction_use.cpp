#include "mcplan/plan/friction_use.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mcplan/robot/similarity.hpp"
#include "mcplan/scene/polygon.hpp"
#include "phase_state.hpp"
#include "plan_shape.hpp"

namespace mcplan {
std::map<std::string, double> friction_use(const Plan& plan, double sample_s) {
  require_shape(plan, plan.scene.surfaces.size());
  std::vector<Eigen::Vector3d> normals;
  for (const Surface& surface : plan.scene.surfaces) normals.push_back(Polygon(surface.vertices_W).normal_W());
  const Similarity similarity = similarity_of(plan.robot, plan.scene.gravity);
  const double least_force = 1e-3 * similarity.force();
  sample_s *= similarity.time;
  std::map<std::string, double> use;
  for (std::size_t k = 0; k < plan.phases.size(); ++k) {
    const PhaseFrame frame = phase_frame(plan, static_cast<int>(k));
    const double duration = plan.phases[k].duration;
    const int samples = samples_of(plan.phases[k], sample_s);
    for (int i = 0; samples > 0 && i <= samples; ++i) {
      const PlanState state = state_in_phase(plan, frame, duration * i / samples);
      for (std::size_t l = 0; l < state.end_effectors.size(); ++l) {
        const EndEffectorState& end = state.end_effectors[l];
        if (end.surface < 0 || end.force_W.norm() < least_force) continue;
        const double normal = normals[end.surface].dot(end.force_W);
        const double tangential = (end.force_W - normal * normals[end.surface]).norm();
        double& max_use = use[plan.robot.end_effectors[l].name];
        max_use = std::max(max_use, normal > 0.0 ? tangential / normal : std::numeric_limits<double>::infinity());
      }
    }
  }
  return use;
}

}  // namespace mcplan
