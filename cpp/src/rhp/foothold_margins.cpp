#include "rhp/foothold_margins.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "mcplan/base/error.hpp"
#include "mcplan/ipm/solver.hpp"
#include "mcplan/nlp/solver.hpp"
#include "rhp/pieces/reach_rows.hpp"

namespace mcplan::rhp {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Where a foot is on both feet's ground: anywhere on its surface, or where it stands.
struct Stand {
  int foot = 0, surface = -1;
  std::optional<Vector3d> at_W;
};

/// Whether there are two footholds in reach of each other, both ways: a linear program in their coordinates.
bool in_reach(const Walker& walker, const Stand& a, const Stand& b) {
  nlp::Problem problem;
  std::array<Placement, 2> feet;
  const std::array<const Stand*, 2> stands{&a, &b};
  for (int i : {0, 1}) {
    const Stand& stand = *stands[i];
    const Polygon& polygon = walker.surfaces[stand.surface];
    feet[i].foot = stand.foot;
    feet[i].surface = stand.surface;
    feet[i].axes_W = walker.frame_W(stand.surface);
    feet[i].origin_W =
        stand.at_W ? *stand.at_W : walker.nearest_foothold_W(stand.foot, stand.surface, polygon.centroid_W());
    const double free = stand.at_W ? 0.0 : nlp::kInfinity;
    feet[i].variable = problem.add_variables("foothold", 2, -free, free, {0, 0});
    if (!stand.at_W) add_foothold(problem, feet[i], polygon, walker.taken_size(stand.foot, stand.surface));
  }
  for (int i : {0, 1}) add_foot_reach(problem, feet[i], feet[1 - i], walker.feet[feet[i].foot].partner_reach_W);
  problem.finish();
  nlp::SolverOptions options;
  options.constraint_tolerance = walker.options.constraint_tolerance;
  options.kernel.feasible_is_enough = true;
  const nlp::Solution solution = ipm::solve(problem, Eigen::VectorXd::Zero(4), options);
  return solution.worst.value <= walker.options.constraint_tolerance;
}

std::string shown_surface(const Walker& walker, int surface) { return text(walker.scene.surfaces[surface].name); }

}  // namespace

FootholdMargins::FootholdMargins(const Walker& walker, const State& state, const Footsteps& footsteps) {
  if (walker.options.paper) return;
  Walker now = walker;
  std::array<Stand, 2> stands;
  for (int foot : {0, 1}) stands[foot] = {foot, state.surfaces[foot], state.feet_W[foot]};
  for (int i = 0; i < footsteps.count(); ++i) {
    const Footstep step = footsteps[i];
    const Stand& other = stands[1 - step.foot];
    stands[step.foot] = {step.foot, step.surface, std::nullopt};
    if (step.surface == other.surface) continue;
    const auto ratio = std::find_if(Walker::kMarginRatios.begin(), Walker::kMarginRatios.end(), [&](double r) {
      for (const Stand& stand : stands)
        if (!stand.at_W) now.limit_margin(stand.foot, stand.surface, r);
      return in_reach(now, stands[step.foot], other);
    });
    if (ratio != Walker::kMarginRatios.end() || !out_of_reach.empty()) continue;
    out_of_reach = "no foothold of " + walker.robot.end_effectors[walker.feet[step.foot].end_effector].name + " on " +
                   shown_surface(walker, step.surface) + " is in reach of the other foot on " +
                   shown_surface(walker, other.surface) + ", with no margin either";
  }
  ratios = now.margin_ratios;
  for (const auto& [where, ratio] : ratios)
    yielded += (yielded.empty() ? "" : ", ") + text(100.0 * ratio * walker.options.foothold_margin_m) + " cm for " +
               walker.robot.end_effectors[walker.feet[where.first].end_effector].name + " on " +
               shown_surface(walker, where.second);
  if (!yielded.empty()) yielded = "foothold_margin_m yields, for steps that are out of reach with it: " + yielded;
}

}  // namespace mcplan::rhp
