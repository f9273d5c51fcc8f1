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
    worst = std::max(worst, clearance_depth(near, end_effector, stretch, stretch.ratio(path[i].since_lift_s),
                                            ends[i].position_W, ends[i].yaw));
  return worst;
}

/// What a swing may be like: its height [m], and the time [s] for which it has been under way.
struct Choice {
  double height, elapsed_s;
};

/// What is tried of a swing that is under way, or begins in the plan, in this order.
std::vector<Choice> choices(const Swing& swing, bool under_way, double usual_m, double fastest_m) {
  std::vector<Choice> out{{swing.height, swing.elapsed_s}};
  if (swing.elapsed_s > 0.0) out.push_back({0.0, 0.0});
  for (double factor : under_way ? kMoreLift : kOtherLifts) out.push_back({std::min(factor * usual_m, fastest_m), 0.0});
  return out;
}

/// Give a swing of the plan the first choice with which it clears the solids, or the one with which it goes in least.
void choose(Plan& plan, Swing& swing, FreeStretch stretch, const std::vector<Choice>& from,
            const std::vector<Solid>& solids, const std::vector<Eigen::AlignedBox3d>& boxes, double sample_s,
            const Similarity& similarity) {
  const std::vector<PathInstant> path = path_of(plan, swing, sample_s);
  Choice best = from.front();
  double least = HUGE_VAL;
  const Eigen::Vector3d lifted_from_W = stretch.lift_normal_W;
  for (const Choice& choice : from) {
    swing.height = choice.height;
    swing.elapsed_s = choice.elapsed_s;
    stretch.before_s = begun_s(swing, plan.robot, similarity);
    stretch.lift_normal_W = choice.elapsed_s > 0.0 ? swing.lift_normal_W.normalized() : lifted_from_W;
    const double depth = depth_on(path, solids, boxes, plan.robot.end_effectors[swing.end_effector], stretch);
    if (depth < least) {
      least = depth;
      best = choice;
    }
    if (least <= 0.0) break;
  }
  swing.height = best.height;
  swing.elapsed_s = best.elapsed_s;
  if (!(best.elapsed_s > 0.0)) swing.lift_normal_W = lifted_from_W;
}

}  // namespace

std::vector<Swing> swings_under_way(const Plan& plan, double t) {
  const std::vector<double> times = plan.knot_times();
  std::vector<Swing> out;
  for (int e = 0; e < plan.end_effector_count(); ++e) {
    const Swing* last = nullptr;
    for (const Swing& swing : plan.swings)
      if (swing.end_effector == e && times[swing.first_phase] < t && !(last && swing.first_phase < last->first_phase))
        last = &swing;
    if (!last) continue;
    out.push_back(*last);
    out.back().elapsed_s += t - times[last->first_phase];
  }
  return out;
}

std::vector<Eigen::Vector3d> sole_normals(const Plan& plan, double t) {
  const std::vector<Solid> solids = solids_of(plan.scene);
  const Similarity similarity = similarity_of(plan.robot, plan.scene.gravity);
  const std::vector<double> times = plan.knot_times();
  const int count = static_cast<int>(plan.phases.size());
  int k = 0;
  while (k + 1 < count && times[k + 1] <= t) ++k;
  std::vector<Eigen::Vector3d> out(plan.end_effector_count(), Eigen::Vector3d::UnitZ());
  for (int e = 0; e < plan.end_effector_count(); ++e) {
    if (const int surface = plan.phases[k].contacts[e].surface; surface >= 0)
      out[e] = solids[surface].polygon.normal_W();
    for (const FreeStretch& stretch : free_stretches(plan, solids, e, plan.robot, similarity)) {
      if (k < stretch.first_phase || k >= stretch.end_phase) continue;
      const double s = std::clamp(stretch.ratio(t - stretch.start_s), 0.0, 1.0);
      const Eigen::Vector3d normal = stretch.normal(s);
      if (normal.norm() > 1e-6) out[e] = normal.normalized();
    }
  }
  return out;
}

void choose_swings(Plan& plan, bool heights, const std::vector<Swing>& under_way,
                   const std::vector<Eigen::Vector3d>& normals_W) {
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
    for (FreeStretch stretch : free_stretches(plan, solids, e)) {
      if (stretch.first_phase == 0 && plan.measured_start && e < static_cast<int>(normals_W.size()))
        stretch.lift_normal_W = normals_W[e];
      Swing swing;
      swing.end_effector = e;
      swing.first_phase = stretch.first_phase;
      swing.end_phase = stretch.end_phase;
      swing.lift_normal_W = stretch.lift_normal_W;
      swing.land_normal_W = stretch.land_normal_W;
      const bool leaves = in_contact(plan, stretch.first_phase - 1, e),
                 arrives = in_contact(plan, stretch.end_phase, e);
      const bool in_air = plan.measured_start && !leaves && stretch.first_phase == 0;
      swing.height = (leaves || arrives) && !in_air ? usual_height : 0.0;
      for (const Swing& begun : under_way)
        if (begun.end_effector == e && in_air && arrives) {
          swing.height = begun.height;
          swing.elapsed_s = begun.elapsed_s;
          swing.lift_normal_W = begun.lift_normal_W;
        }
      plan.swings.push_back(swing);
      if (!(leaves || arrives) || !heights) continue;
      // What is left of a swing may be too short to be lifted in: an arc rises and falls by its height twice as fast as
      // a triangle at its steepest, 4 h / T.
      const double most = in_air ? kLiftSpeed * similarity.velocity() * stretch.duration_s / 4.0 : HUGE_VAL;
      choose(plan, plan.swings.back(), stretch, choices(swing, in_air, usual_height, most), solids, boxes, sample_s,
             similarity);
    }
}

}  // namespace mcplan
