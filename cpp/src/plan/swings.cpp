#include "mcplan/plan/swings.hpp"

#include "mcplan/plan/clearance.hpp"
#include "mcplan/robot/similarity.hpp"
#include "plan_shape.hpp"

namespace mcplan {
namespace {

bool touches(const Plan& plan, int k, int end_effector) {
  const int n = static_cast<int>(plan.phases.size());
  if (k < 0 || k > n) return false;
  return (k == n ? plan.final_contacts[end_effector] : plan.phases[k].contacts[end_effector].surface) >= 0;
}

}  // namespace

void choose_swings(Plan& plan) {
  plan.swings.clear();
  require_shape(plan, plan.scene.surfaces.size());
  const std::vector<Solid> solids = solids_of(plan.scene);
  const Similarity similarity = similarity_of(plan.robot, plan.scene.gravity);
  const double usual_height = swing_height_of(plan.robot, similarity), sample_s = 0.01 * similarity.time;
  for (int e = 0; e < plan.end_effector_count(); ++e)
    for (const FreeStretch& stretch : free_stretches(plan, solids, e)) {
      Swing swing;
      swing.end_effector = e;
      swing.first_phase = stretch.first_phase;
      swing.end_phase = stretch.end_phase;
      swing.lift_normal_W = stretch.lift_normal_W;
      swing.land_normal_W = stretch.land_normal_W;
      const bool leaves = touches(plan, stretch.first_phase - 1, e), arrives = touches(plan, stretch.end_phase, e);
      swing.height = leaves || arrives ? usual_height : 0.0;
      plan.swings.push_back(swing);
      if (swing.height == 0.0) continue;
      // The least of a few heights that clears the scene.
      double best_depth = clearance_depth(plan, solids, e, stretch, sample_s);
      double best_height = swing.height;
      for (double factor : {1.5, 2.0, 3.0, 4.0, 0.5}) {
        if (best_depth <= 0.0) break;
        plan.swings.back().height = factor * swing.height;
        const double depth = clearance_depth(plan, solids, e, stretch, sample_s);
        if (depth >= best_depth) continue;
        best_depth = depth;
        best_height = plan.swings.back().height;
      }
      plan.swings.back().height = best_height;
    }
}

}  // namespace mcplan
