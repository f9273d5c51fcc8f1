#include "plan/similar.hpp"

#include <utility>

namespace mcplan {
namespace {

using Eigen::Vector3d;

void scale(std::vector<Vector3d>& vectors, double factor) {
  for (Vector3d& v : vectors) v *= factor;
}

void scale(Contact& contact, const Similarity& by) {
  contact.stiffness /= by.time * by.time;
  contact.anchor_W *= by.length;
  contact.moment_W *= by.moment();
  contact.center_of_pressure_W *= by.length;
  scale(contact.points_W, by.length);
  scale(contact.point_forces_W, by.force());
}

void scale(EndEffector& end, const Similarity& by) {
  for (Vector3d* length : {&end.frame_offset, &end.nominal_B, &end.reach_min_B, &end.reach_max_B}) *length *= by.length;
  end.usual_reach *= by.length;
  end.half_size *= by.length;
  end.max_force *= by.force();
  end.max_moment *= by.moment();
  end.reach_cut.b *= by.length;
  end.com_reach.b *= by.length;
  for (auto& partner : end.partner_reach) partner.second.b *= by.length;
  for (Vector3d* length : {&end.limb.hip_B, &end.limb.ankle}) *length *= by.length;
  for (double* length : {&end.limb.upper, &end.limb.lower, &end.limb.margin, &end.limb.radius, &end.limb.beside})
    *length *= by.length;
  end.limb.knee_torque *= by.moment();
  end.limb.hip_torque *= by.moment();
  end.limb.ankle_torque *= by.moment();
  end.limb.knee_speed /= by.time;
}

}  // namespace

Similarity inverse(const Similarity& s) { return {1.0 / s.length, 1.0 / s.time, 1.0 / s.mass}; }

Scene scaled(const Scene& scene, const Similarity& by) {
  Scene out = scene;
  out.gravity *= by.length / (by.time * by.time);
  for (Surface& surface : out.surfaces) {
    scale(surface.vertices_W, by.length);
    surface.thickness *= by.length;
  }
  out.start.position_W *= by.length;
  out.goal.position_W *= by.length;
  return out;
}

Robot scaled(const Robot& robot, const Similarity& by) {
  const Robot unset;
  Robot out = robot;
  out.mass *= by.mass;
  out.inertia *= by.mass * by.length * by.length;
  out.com_height *= by.length;
  out.max_com_speed *= by.velocity();
  if (out.swing_height != unset.swing_height) out.swing_height *= by.length;
  if (out.phase_duration != unset.phase_duration) out.phase_duration *= by.time;
  for (TrunkPart& part : out.trunk) {
    for (Vector3d* place : {&part.from_B, &part.to_B}) *place *= by.length;
    part.radius *= by.length;
  }
  for (EndEffector& end : out.end_effectors) scale(end, by);
  return out;
}

Knot scaled(const Knot& knot, const Similarity& by) {
  Knot out = knot;
  out.com_W *= by.length;
  out.com_velocity_W *= by.velocity();
  out.base_rpy_rate *= by.rate();
  scale(out.end_effectors_W, by.length);
  scale(out.end_effector_velocities_W, by.velocity());
  out.angular_momentum_W *= by.angular_momentum();
  return out;
}

Plan scaled_motion(const Plan& plan, const Similarity& by) {
  Plan out = plan;
  for (Knot& knot : out.knots) knot = scaled(knot, by);
  for (Phase& phase : out.phases) {
    phase.duration *= by.time;
    for (Contact& contact : phase.contacts) scale(contact, by);
  }
  for (Swing& swing : out.swings) {
    swing.height *= by.length;
    swing.elapsed_s *= by.time;
  }
  out.start_slack_s *= by.time;
  out.momentum_max *= by.angular_momentum();
  out.momentum_rate_max *= by.moment();
  return out;
}

}  // namespace mcplan
