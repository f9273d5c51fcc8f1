#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "ddp/box_cut.hpp"
#include "ddp/impossible.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/base/rotation.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/robot/similarity.hpp"
#include "model/text.hpp"
#include "plan/sole_depth.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// How far a point is inside a solid that goes on downwards [m]; negative outside, or where the solid's lower face is
/// more than a foot's height above it.
double depth_below_top(const Solid& solid, const Vector3d& point, double foot_height) {
  const double below = -solid.polygon.height(point);
  return below > solid.thickness + foot_height ? -1.0 : std::min(below, -solid.polygon.outside(point));
}

/// Where an end-effector of a stance in contact may have its foothold, corners of a polygon in the world.
std::vector<Vector3d> footholds(const Surface& surface, const EndEffector& end, const ResolvedStance& at,
                                double beyond_m) {
  const Eigen::Matrix3d to_base = rotation_from_rpy(at.base_rpy).transpose();
  std::vector<Vector3d> places;
  for (const Vector3d& v : surface.vertices_W) places.push_back(to_base * (v - at.com_W));
  const Vector3d grown = Vector3d::Constant(beyond_m);
  places = cut_to_box(places, end.reach_min_B - grown, end.reach_max_B + grown);
  for (Vector3d& place : places) place = at.com_W + to_base.transpose() * place;
  return places;
}

}  // namespace

/// A sole in contact, where it was put down, is no deeper than D = kSoleDepth and the tolerance c of `clearance` in any
/// solid but its own, the shorter way up or to a side (sole_depth()). Let its middle x be d below a solid's upper face
/// and d inside of its edges, and at most h, a foot's height, below the lower face. Along an axis that makes an angle a
/// with the normal the solid reaches d beyond x upwards, and d sin(a) - h cos(a) to the other side; the sole has to
/// leave upwards where cos(a) > 1/2. So it is in the solid by at least
///
///     d sin(60 deg) - h / 2
///
/// and where that is more than D + c for all footholds that a stance allows (stance_out_of_reach()), less what they
/// move by afterwards (`slip`) or lie beside the surface, there is no plan. The set {d >= ...} is convex, so that the
/// corners of the polygon of footholds tell.
std::optional<Impossible> sole_in_solid(const Scene& scene, const Robot& robot, bool at_goal) {
  const char* name = at_goal ? "goal" : "start";
  const ResolvedStance at = resolve_stance(scene, robot, at_goal ? scene.goal : scene.start, name);
  const Tolerances tolerances;
  const double length = similarity_of(robot, scene.gravity).length, foot_m = kFootHeight * length;
  const double allowed_m = (kSoleDepth + tolerances.clearance) * length;
  std::vector<Solid> solids;
  for (const Surface& surface : scene.surfaces) solids.push_back({Polygon(surface.vertices_W), surface.thickness});
  for (std::size_t l = 0; l < robot.end_effectors.size(); ++l) {
    const EndEffector& end = robot.end_effectors[l];
    if (at.contacts[l] < 0 || end.com_reach.given()) continue;
    const Surface& own = scene.surfaces[at.contacts[l]];
    const std::vector<Vector3d> places =
        at_goal ? footholds(own, end, at, reach_allowed(end, true, length)) : std::vector{at.end_effectors_W[l]};
    const double beside_m =
        (at_goal ? std::sqrt(2.0) * tolerances.contact_distance + tolerances.slip : tolerances.stance) * length;
    for (std::size_t i = 0; i < solids.size(); ++i) {
      if (static_cast<int>(i) == at.contacts[l]) continue;
      double least = std::numeric_limits<double>::infinity();
      for (const Vector3d& place : places)
        least = std::min(least, depth_below_top(solids[i], place, foot_m - beside_m));
      const double depth_m = std::sin(M_PI / 3.0) * (least - beside_m) - 0.5 * foot_m;
      if (places.empty() || !(depth_m > allowed_m)) continue;
      return Impossible{std::string(name) + ": " + end.name + " would stand on " + text(own.name) +
                            " inside the solid of " + model::shown(scene.surfaces[i].name),
                        {"clearance", -1, end.name, 0.0, depth_m, allowed_m, "m", scene.surfaces[i].name}};
    }
  }
  return std::nullopt;
}

}  // namespace mcplan::ddp
