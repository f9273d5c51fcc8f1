#include <algorithm>

#include "ddp/costs/prism.hpp"
#include "ddp/impossible.hpp"
#include "ddp/leg_lines.hpp"
#include "mcplan/base/rotation.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/robot/similarity.hpp"
#include "model/text.hpp"
#include "plan/clearance.hpp"
#include "plan/solid_box.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// Where the hips of a stance are from their nominal places, over the robot's shift: LimbLimits.
Vector3d feet_moved(const Robot& robot, const ResolvedStance& at, const Eigen::Matrix3d& r) {
  Vector3d out = Vector3d::Zero();
  for (std::size_t l = 0; l < robot.end_effectors.size(); ++l)
    if (robot.end_effectors[l].limb.given())
      out += r.transpose() * (at.end_effectors_W[l] - at.com_W) - robot.end_effectors[l].nominal_B;
  return out;
}

/// The lines of a leg that stands on a surface as the stance has it.
LegLines lines_of(const Robot& robot, const ResolvedStance& at, std::size_t l, const Surface& on) {
  const EndEffector& end = robot.end_effectors[l];
  const Eigen::Matrix3d r = rotation_from_rpy(at.base_rpy);
  const Eigen::Matrix3d sole = mcplan::sole_frame(Polygon(on.vertices_W).normal_W(), at.yaw);
  const Vector3d ankle = at.end_effectors_W[l] + sole * end.limb.ankle;
  const Vector3d hip = at.com_W + r * (end.limb.hip_B + end.limb.hip_shift * feet_moved(robot, at, r));
  const Vector3d heading = end.half_size.maxCoeff() > 0.0 ? Vector3d(sole.col(0)) : Vector3d(r.col(0));
  return {end.limb, ankle, hip - ankle, heading};
}

/// How deep a capsule about a line is in a solid [m]; negative: not at all.
double depth_in(const Surface& surface, const Vector3d& from, const Vector3d& along, double radius) {
  const Polygon polygon(surface.vertices_W);
  Eigen::AlignedBox3d around(from);
  around.extend(Vector3d(from + along));
  const Eigen::AlignedBox3d box = box_of({polygon, surface.thickness});
  if (box.squaredExteriorDistance(around) >= radius * radius) return -radius;  // most, where there are many
  const double s = nearest_on_line(polygon, surface.thickness, from, along);
  return radius - std::max(outside_solid(polygon, surface.thickness, from + s * along).distance, 0.0);
}

}  // namespace

std::optional<Impossible> leg_in_solid(const Scene& scene, const Robot& robot, bool at_goal, double tolerances) {
  const std::string name = at_goal ? "goal" : "start";
  const ResolvedStance at = resolve_stance(scene, robot, at_goal ? scene.goal : scene.start, name);
  const double allowed_m = tolerances * Tolerances().clearance * similarity_of(robot, scene.gravity).length;
  std::optional<Impossible> deepest;
  for (std::size_t l = 0; l < robot.end_effectors.size(); ++l) {
    const EndEffector& end = robot.end_effectors[l];
    if (at.contacts[l] < 0 || !end.limb.given() || !(end.limb.radius > 0.0)) continue;
    const LegLines lines = lines_of(robot, at, l, scene.surfaces[at.contacts[l]]);
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
      for (const LegLines::Part part : {LegLines::thigh, LegLines::shank}) {
        // What a foot stands on is beside its shank.
        if (part == LegLines::shank && static_cast<int>(i) == at.contacts[l]) continue;
        const double depth_m = depth_in(scene.surfaces[i], lines.from(part), lines.along(part), end.limb.radius);
        if (!(depth_m > allowed_m) || (deepest && !(depth_m > deepest->violation.value))) continue;
        deepest = Impossible{name + ": the leg of " + end.name + " would be " + model::digits(depth_m, "%.2g") +
                                 " m deep in the solid of " + model::shown(scene.surfaces[i].name) +
                                 (at_goal ? ", with the feet where they usually stand" : ""),
                             {"limb", -1, end.name, 0.0, depth_m, allowed_m, "m", scene.surfaces[i].name}};
      }
  }
  return deepest;
}

}  // namespace mcplan::ddp
