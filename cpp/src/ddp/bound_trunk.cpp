#include <algorithm>

#include "ddp/costs/prism.hpp"
#include "ddp/impossible.hpp"
#include "mcplan/base/rotation.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/robot/similarity.hpp"
#include "model/text.hpp"
#include "plan/solid_box.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

std::optional<Impossible> part_in_solid(const Scene& scene, const Robot& robot, const ResolvedStance& at,
                                        const char* name) {
  const Tolerances tolerances;
  const double length = similarity_of(robot, scene.gravity).length;
  const Eigen::Matrix3d r = rotation_from_rpy(at.base_rpy);
  for (const TrunkPart& part : robot.trunk) {
    const double lever = std::max(part.from_B.norm(), part.to_B.norm());
    const double allowed_m = (tolerances.clearance + tolerances.boundary + 2.0 * tolerances.dynamics) * length +
                             (3.0 * tolerances.boundary + tolerances.orientation) * lever;
    const Vector3d from = at.com_W + r * part.from_B, along = r * (part.to_B - part.from_B);
    Eigen::AlignedBox3d around(from);
    around.extend(Vector3d(from + along));
    for (const Surface& surface : scene.surfaces) {
      const Polygon polygon(surface.vertices_W);
      const Eigen::AlignedBox3d box = box_of({polygon, surface.thickness});
      if (box.squaredExteriorDistance(around) >= part.radius * part.radius) continue;  // most, where there are many
      const double depth_m =
          part.radius - std::max(nearest_on_line(polygon, surface.thickness, from, along).outside.distance, 0.0);
      if (!(depth_m > allowed_m)) continue;
      return Impossible{std::string(name) + ": the trunk of " + robot.name + " would be " +
                            model::digits(depth_m, "%.2g") + " m deep in the solid of " + model::shown(surface.name),
                        {"trunk", -1, "", 0.0, depth_m, allowed_m, "m", surface.name}};
    }
  }
  return std::nullopt;
}

}  // namespace

/// At its stance a plan has (`start`, `goal`) a CoM p within b of the stance's p*, from which the replayed one differs
/// by at most the tolerance of `dynamics`. A ball about the CoM, of radius r = kTrunkBall CoM heights, is no deeper
/// than c in any solid (`trunk`, `clearance`), so that p is at least r - c from it. The distance from a convex set
/// changes by no more than the point moves: where p* is nearer than
///
///     r - c - b
///
/// to a solid, there is no plan. Likewise of the parts of the robot's own trunk, r their radius and p on their line:
/// the base's angles are within b of the stance's, and replayed within that of `orientation`, which moves what is e
/// from the CoM by e (3 b + o) more.
std::optional<Impossible> trunk_in_solid(const Scene& scene, const Robot& robot, bool at_goal) {
  const char* name = at_goal ? "goal" : "start";
  const ResolvedStance at = resolve_stance(scene, robot, at_goal ? scene.goal : scene.start, name);
  const Tolerances tolerances;
  const double length = similarity_of(robot, scene.gravity).length;
  const double radius_m = kTrunkBall * robot.com_height;
  const double allowed_m = (tolerances.clearance + tolerances.boundary + 2.0 * tolerances.dynamics) * length;
  for (const Surface& surface : scene.surfaces) {
    const Outside outside = outside_prism(Polygon(surface.vertices_W), surface.thickness, at.com_W);
    const double depth_m = radius_m - std::max(outside.distance, 0.0);
    if (!(depth_m > allowed_m)) continue;
    return Impossible{std::string(name) + ": the trunk of " + robot.name + ", with the CoM at " +
                          model::digits(at.com_W, "%.4g") + ", would be in the solid of " + model::shown(surface.name),
                      {"trunk", -1, "", 0.0, depth_m, allowed_m, "m", surface.name}};
  }
  return part_in_solid(scene, robot, at, name);
}

}  // namespace mcplan::ddp
