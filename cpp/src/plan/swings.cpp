#include "plan/swings.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mcplan/robot/similarity.hpp"
#include "phase_state.hpp"
#include "plan/clearance.hpp"
#include "plan_shape.hpp"
#include "solid_box.hpp"

namespace mcplan {
namespace {

/// An end-effector that is on its way is lifted no faster [m/s, of a robot of human size]. Chosen: feet of humanoids
/// swing at up to 2 m/s.
constexpr double kLiftSpeed = 1.5;
/// Heights that are tried, in usual ones: added to an end-effector on its way, which may sink a little where it lands
/// later than planned, and instead of the usual one. Chosen.
const std::vector<double> kMoreLift{0.05, 0.25, 1.0, 1.5, 2.5, 3.5}, kOtherLifts{1.5, 2.0, 3.0, 4.0, 0.5};

bool in_contact(const Plan& plan, int k, int end_effector) {
  const int n = static_cast<int>(plan.phases.size());
  if (k < 0 || k > n) return false;
  return (k == n ? plan.final_contacts[end_effector] : plan.phases[k].contacts[end_effector].surface) >= 0;
}

/// clearance_depth() of a swing on its way, at the height that it has now.
double depth_on(const std::vector<PathInstant>& path, const std::vector<Solid>& solids,
                const std::vector<Eigen::AlignedBox3d>& boxes, const EndEffector& end_effector,
                const FreeStretch& stretch) {
  std::vector<EndEffectorState> ends;
  Eigen::AlignedBox3d way;
  for (const PathInstant& instant : path) {
    ends.push_back(lifted(instant));
    way.extend(ends.back().position_W);
  }
  // Most solids of a large scene are nowhere near.
  constexpr double kRounding = 1e-3;
  const double reach = end_effector.half_size.norm() + kRounding;
  std::vector<Solid> near;
  for (std::size_t i = 0; i < solids.size(); ++i)
    if (!(boxes[i].squaredExteriorDistance(way) > reach * reach)) near.push_back(solids[i]);
  double worst = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i)
    worst = std::max(worst, clearance_depth(near, end_effector, stretch, path[i].since_lift_s / stretch.duration_s,
                                            ends[i].position_W, ends[i].yaw));
  return worst;
}

}  // namespace

void choose_swings(Plan& plan, bool heights) {
  plan.swings.clear();
  require_shape(plan, plan.scene.surfaces.size());
  const std::vector<Solid> solids = solids_of(plan.scene);
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Solid& solid : solids) boxes.push_back(box_of(solid));
  const Similarity similarity = similarity_of(plan.robot, plan.scene.gravity);
  const double usual_height = swing_height_of(plan.robot, similarity), sample_s = 0.01 * similarity.time;
  for (int k = 0; k < static_cast<int>(plan.phases.size()); ++k)
    if (plan.phases[k].duration > 0.0 && std::isfinite(plan.phases[k].duration)) require_queryable(plan, k, 0.0);
  for (int e = 0; e < plan.end_effector_count(); ++e)
    for (const FreeStretch& stretch : free_stretches(plan, solids, e)) {
      Swing swing;
      swing.end_effector = e;
      swing.first_phase = stretch.first_phase;
      swing.end_phase = stretch.end_phase;
      swing.lift_normal_W = stretch.lift_normal_W;
      swing.land_normal_W = stretch.land_normal_W;
      const bool leaves = in_contact(plan, stretch.first_phase - 1, e),
                 arrives = in_contact(plan, stretch.end_phase, e);
      // A swing that is measured under way has been lifted already.
      const bool under_way = plan.measured_start && !leaves && stretch.first_phase == 0;
      swing.height = (leaves || arrives) && !under_way ? usual_height : 0.0;
      plan.swings.push_back(swing);
      if (!(leaves || arrives) || !heights) continue;
      // The least of a few heights that clears the scene.
      const std::vector<PathInstant> path = path_of(plan, plan.swings.back(), sample_s);
      const EndEffector& end_effector = plan.robot.end_effectors[e];
      double best_depth = depth_on(path, solids, boxes, end_effector, stretch);
      double best_height = swing.height;
      // What is left of a swing may be too short to be lifted in: an arc rises and falls by its height twice as fast as
      // a triangle at its steepest, 4 h / T.
      const double most = under_way ? kLiftSpeed * similarity.velocity() * stretch.duration_s / 4.0 : HUGE_VAL;
      for (double factor : under_way ? kMoreLift : kOtherLifts) {
        if (best_depth <= 0.0) break;
        plan.swings.back().height = std::min(factor * usual_height, most);
        const double depth = depth_on(path, solids, boxes, end_effector, stretch);
        if (depth >= best_depth) continue;
        best_depth = depth;
        best_height = plan.swings.back().height;
      }
      plan.swings.back().height = best_height;
    }
}

}  // namespace mcplan
