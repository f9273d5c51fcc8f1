#include <algorithm>
#include <vector>

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

/// A line of a leg that stands, and what it stands on where that is beside it: a shank's.
struct Part {
  std::size_t l = 0;
  Vector3d from, along;
  int beside = -1;
};

std::vector<Part> parts_of(const Robot& robot, const Scene& scene, const ResolvedStance& at) {
  std::vector<Part> out;
  for (std::size_t l = 0; l < robot.end_effectors.size(); ++l) {
    const LimbLimits& limb = robot.end_effectors[l].limb;
    if (at.contacts[l] < 0 || !limb.given() || !(limb.radius > 0.0)) continue;
    const LegLines lines = lines_of(robot, at, l, scene.surfaces[at.contacts[l]]);
    out.push_back({l, lines.from(LegLines::thigh), lines.along(LegLines::thigh)});
    out.push_back({l, lines.from(LegLines::shank), lines.along(LegLines::shank), at.contacts[l]});
  }
  return out;
}

/// How deep a capsule about a line is in a solid [m]; less than zero: not at all.
double depth_in(const Solid& solid, const Eigen::AlignedBox3d& box, const Part& part, double radius) {
  Eigen::AlignedBox3d around(part.from);
  around.extend(Vector3d(part.from + part.along));
  if (box.squaredExteriorDistance(around) >= radius * radius) return -radius;  // most, where there are many
  return radius -
         std::max(nearest_on_line(solid.polygon, solid.thickness, part.from, part.along).outside.distance, 0.0);
}

}  // namespace

std::optional<Impossible> leg_in_solid(const Scene& scene, const Robot& robot, bool at_goal, double tolerances) {
  const std::string name = at_goal ? "goal" : "start";
  const ResolvedStance at = resolve_stance(scene, robot, at_goal ? scene.goal : scene.start, name);
  const double allowed_m = tolerances * Tolerances().clearance * similarity_of(robot, scene.gravity).length;
  const std::vector<Part> parts = parts_of(robot, scene, at);
  std::optional<Impossible> deepest;
  for (int i = 0; i < static_cast<int>(scene.surfaces.size()) && !parts.empty(); ++i) {
    const Surface& surface = scene.surfaces[i];
    const Solid solid{Polygon(surface.vertices_W), surface.thickness};
    const Eigen::AlignedBox3d box = box_of(solid);
    for (const Part& part : parts) {
      if (part.beside == i) continue;
      const EndEffector& end = robot.end_effectors[part.l];
      const double depth_m = depth_in(solid, box, part, end.limb.radius);
      if (!(depth_m > allowed_m) || (deepest && !(depth_m > deepest->violation.value))) continue;
      deepest = Impossible{name + ": the leg of " + end.name + " would be " + model::digits(depth_m, "%.2g") +
                               " m deep in the solid of " + model::shown(surface.name) +
                               (at_goal ? ", with the feet where they usually stand" : ""),
                           {"limb", -1, end.name, 0.0, depth_m, allowed_m, "m", surface.name}};
    }
  }
  return deepest;
}

}  // namespace mcplan::ddp
