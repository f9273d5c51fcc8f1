#include <algorithm>
#include <cmath>
#include <vector>

#include "ddp/box_cut.hpp"
#include "ddp/impossible.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/base/rotation.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/robot/similarity.hpp"
#include "model/text.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// By how much the box has to grow on all sides to touch the polygon, both in frame B: their distance in the maximum
/// norm. By bisection, never more than it is by rounding.
double growth_to_touch(const std::vector<Vector3d>& polygon, const Vector3d& box_min, const Vector3d& box_max) {
  const auto touches = [&](double growth) {
    const Vector3d grown = Vector3d::Constant(growth);
    return !cut_to_box(polygon, box_min - grown, box_max + grown).empty();
  };
  if (touches(0.0)) return 0.0;
  double low = 0.0, high = (box_max - box_min).norm();
  while (!touches(high)) {
    low = high;
    high *= 2.0;
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (touches(middle) ? high : low) = middle;
  }
  return low;
}

}  // namespace

double reach_allowed(const EndEffector& end, bool at_goal, double length) {
  const Tolerances tolerances;
  const double turned = 3.0 * tolerances.boundary + tolerances.orientation;
  const double reach_m = (tolerances.reach + 2.0 * tolerances.dynamics) * length;
  const double foothold_m = (at_goal ? std::sqrt(2.0) * tolerances.contact_distance : tolerances.stance) * length;
  return reach_m + foothold_m + tolerances.boundary * length +
         turned * (farthest_reach(end) + std::sqrt(3.0) * reach_m);
}

/// At its stance a plan has (`start`, `goal`) a CoM p within b of the stance's p*, differences of roll, pitch and yaw
/// within b_r each, and the stance's contacts. The foothold x of one of them lies within c of its surface's plane
/// and within c of its polygon, so within sqrt(2) c of a point y of it (`contact_distance`, `contact_polygon`), and R^T
/// (x - p) in the reach box grown by rho (`reach`), with an R that differs from the knot's by o at most
/// (`orientation`), about a CoM that differs from the knot's by at most the tolerance of `dynamics`. The angle between
/// R and the stance's R* is at most 3 b_r + o, and |x - p| at most r + sqrt(3) rho with r the farthest corner of the
/// box. So R*^T (y - p*) lies in the box grown by
///
///     rho + sqrt(2) c + b + (3 b_r + o) (r + sqrt(3) rho)
///
/// and where no point y of the polygon does, there is no plan. At the start the foothold is within s of where the
/// stance puts it (`start`), and s takes the place of sqrt(2) c with that point for y. Of end-effectors whose contacts
/// are held to com_reach instead of the box nothing is said.
std::optional<Impossible> stance_out_of_reach(const Scene& scene, const Robot& robot, bool at_goal) {
  const Stance& stance = at_goal ? scene.goal : scene.start;
  const char* name = at_goal ? "goal" : "start";
  const ResolvedStance at = resolve_stance(scene, robot, stance, name);
  const double length = similarity_of(robot, scene.gravity).length;
  const Eigen::Matrix3d to_base = rotation_from_rpy(at.base_rpy).transpose();
  for (std::size_t l = 0; l < robot.end_effectors.size(); ++l) {
    const EndEffector& end = robot.end_effectors[l];
    if (at.contacts[l] < 0 || end.com_reach.given()) continue;
    const Surface& surface = scene.surfaces[at.contacts[l]];
    std::vector<Vector3d> polygon_B;
    for (const Vector3d& v : at_goal ? surface.vertices_W : std::vector<Vector3d>{at.end_effectors_W[l]})
      polygon_B.push_back(to_base * (v - at.com_W));
    const double beyond_m = growth_to_touch(polygon_B, end.reach_min_B, end.reach_max_B);
    const double allowed_m = reach_allowed(end, at_goal, length);
    if (!(beyond_m > allowed_m)) continue;
    return Impossible{std::string(name) + ": " + end.name + " would stand on " + text(surface.name) + ", " +
                          model::digits(beyond_m, "%.3g") + " m out of its reach from the CoM at " +
                          model::digits(at.com_W, "%.4g"),
                      {"reach", -1, end.name, 0.0, beyond_m, allowed_m, "m", surface.name}};
  }
  return std::nullopt;
}

std::optional<Impossible> start_beyond_reach(const Scene& scene, const Robot& robot, double tolerances) {
  const ResolvedStance at = resolve_stance(scene, robot, scene.start, "start");
  const double allowed_m = tolerances * Tolerances().reach * similarity_of(robot, scene.gravity).length;
  const Eigen::Matrix3d to_base = rotation_from_rpy(at.base_rpy).transpose();
  std::optional<Impossible> farthest;
  for (std::size_t l = 0; l < robot.end_effectors.size(); ++l) {
    const EndEffector& end = robot.end_effectors[l];
    if (at.contacts[l] < 0 || end.com_reach.given()) continue;
    const Vector3d place_B = to_base * (at.end_effectors_W[l] - at.com_W);
    const double beyond_m = (end.reach_min_B - place_B).cwiseMax(place_B - end.reach_max_B).maxCoeff();
    if (!(beyond_m > allowed_m) || (farthest && !(beyond_m > farthest->violation.value))) continue;
    const std::string& surface = scene.surfaces[at.contacts[l]].name;
    farthest = Impossible{"start: " + end.name + " would stand on " + text(surface) + ", " +
                              model::digits(1e3 * beyond_m, "%.3g") + " mm beyond its reach from the CoM at " +
                              model::digits(at.com_W, "%.4g"),
                          {"reach", -1, end.name, 0.0, beyond_m, allowed_m, "m", surface}};
  }
  return farthest;
}

}  // namespace mcplan::ddp
