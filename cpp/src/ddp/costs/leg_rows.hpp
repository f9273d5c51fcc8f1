#pragma once

#include "ddp/cost_terms.hpp"
#include "ddp/hip.hpp"
#include "ddp/leg_lines.hpp"
#include "mcplan/base/rotation.hpp"
#include "prism.hpp"

namespace mcplan::ddp {

/// A leg that is a body, and whether there are solids near it.
inline bool has_leg_rows(const StepView& step) {
  return step.between_knots() && !step.problem.leg_solids.empty() && step.problem.limits[step.l].limb.radius > 0.0;
}

/// Where the ankle of a leg is at an instant and in which direction its knee bends, with what they turn by with the
/// base's yaw, and the share of the stride that the end-effector has made.
struct AnkleAt {
  Eigen::Vector3d place, heading;
  Eigen::Vector3d place_by_yaw = Eigen::Vector3d::Zero(), heading_by_yaw = Eigen::Vector3d::Zero();
  double stride = 0.0;
};

/// distance - room < 0 of the capsules about a leg from a solid, at an instant.
inline void write_leg_rows(const StepView& step, const Instant& instant, const AnkleAt& ankle, Rows& rows) {
  using Eigen::Vector3d;
  const Problem& problem = step.problem;
  const Layout& at = problem.layout;
  const LimbLimits& limb = problem.limits[step.l].limb;
  const Hip hip(problem, limb, instant.com, rotation_from_rpy(instant.rpy), step.x, step.u, instant.fraction);
  LegLines lines(limb, ankle.place, hip.place_W - ankle.place, ankle.heading);
  for (const LegLines::Part part : {LegLines::thigh, LegLines::shank}) {
    const Vector3d from = lines.from(part), along = lines.along(part);
    Eigen::AlignedBox3d around(from);
    around.extend(Vector3d(from + along));
    for (std::size_t i = 0; i < problem.leg_solids.size(); ++i) {
      const int solid = problem.leg_solids[i];
      const double room = problem.leg_rooms[step.l][i];
      if (part == LegLines::shank && solid == step.surface) continue;
      if (problem.solid_boxes[solid].squaredExteriorDistance(around) >= room * room) continue;
      const auto [s, outside] = nearest_on_line(problem.polygons[solid], problem.thickness[solid], from, along, room);
      if (outside.distance >= room) continue;
      if (!rows.with_gradient()) {
        rows.add_value(step.schedule.interior_weight, outside.distance - room);
        continue;
      }
      const Vector3d& n = outside.outward;
      const LegLines::Slopes by = lines.slopes(part, s, n);
      const Vector3d by_ankle = n - by.u;
      auto g = rows.add_dense(step.schedule.interior_weight, outside.distance - room);
      Vector3d along_rpy = Vector3d::Zero();
      for (int axis : at.axes()) along_rpy[axis] = by.u.dot(rotation_derivative(instant.rpy, axis) * hip.own_B);
      along_rpy.z() += by_ankle.dot(ankle.place_by_yaw) + by.heading.dot(ankle.heading_by_yaw);
      instant.add_along(hip.by_com * by.u, along_rpy, g);
      g.segment<3>(at.end(step.l)) += by_ankle;
      g.segment<3>(at.nx() + at.stride(step.l)) += ankle.stride * by_ankle;
      for (int m : problem.jointed.ends) {
        g.segment<3>(at.end(m)) += limb.hip_shift * by.u;
        g.segment<3>(at.nx() + at.stride(m)) += limb.hip_shift * instant.fraction * by.u;
      }
    }
  }
}

}  // namespace mcplan::ddp
