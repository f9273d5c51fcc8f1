#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "check_internal.hpp"
#include "plan/clearance.hpp"

namespace mcplan::checks {

using Eigen::Vector3d;

Vector3d feet_moved(const Problem& problem, const Sample& sample) {
  Vector3d from_com = Vector3d::Zero(), nominal = Vector3d::Zero();
  for (int m = 0; m < problem.end_effector_count(); ++m) {
    const EndEffector& end = problem.robot.end_effectors[m];
    if (!end.limb.given()) continue;
    from_com += sample.at.end_effectors[m].position_W - sample.replay.com_W;
    nominal += end.nominal_B;
  }
  return sample.r_WB.transpose() * from_com - nominal;
}

Vector3d hip_of(const Sample& sample, const LimbLimits& limb, const Vector3d& feet_moved_B) {
  return sample.replay.com_W + sample.r_WB * (limb.hip_B + limb.hip_shift * feet_moved_B);
}

namespace {

/// The knee of a triangle of links and a leg of that length, by the law of cosines: how far it is along the leg from
/// the ankle, and beside the leg. The leg is taken as long as links allow at most.
struct Knee {
  Knee(const LimbLimits& limb, double length) {
    const double a = limb.upper, b = limb.lower;
    const double cosine = std::clamp((b * b + length * length - a * a) / (2.0 * b * length), -1.0, 1.0);
    along = b * cosine;
    beside = b * std::sqrt(1.0 - cosine * cosine);
  }
  double along, beside;  ///< [m]
};

}  // namespace

/// torque = axis . (m + (p_l - joint) x f), m the contact's moment about the end-effector at p_l. The knee bends
/// towards where the sole heads, its axis is the pitch axis of hip and ankle, the ankle rolls about the sole's heading,
/// and the hip about what is square to the knee's axis and the base's vertical. speed = d' / lever, d the length of the
/// leg.
void Joints::check(const Problem& problem, const Sample& sample, Findings& findings) {
  last_.resize(problem.end_effector_count());
  const Vector3d feet_moved_B = feet_moved(problem, sample);
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const EndEffector& end = problem.robot.end_effectors[l];
    const LimbLimits& limb = end.limb;
    const int surface = problem.surface(sample.phase, l);
    if (surface < 0 || !limb.given()) continue;
    const Place place{sample.phase, l, sample.time_s};
    const bool has_sole = end.half_size.maxCoeff() > 0.0;
    const Eigen::Matrix3d sole =
        mcplan::sole_frame(problem.solids[surface].polygon.normal_W(), sole_yaw(problem, sample, l));
    const Vector3d& position = sample.at.end_effectors[l].position_W;
    const Vector3d ankle = position + sole * limb.ankle;
    const Vector3d leg = hip_of(sample, limb, feet_moved_B) - ankle;
    const double length = leg.norm();
    const Vector3d along = leg / length;
    const Vector3d heading = has_sole ? Vector3d(sole.col(0)) : Vector3d(sample.r_WB.col(0));
    const Vector3d ahead = (heading - along.dot(heading) * along).normalized();
    const Vector3d pitch = along.cross(ahead);
    const Vector3d hip_roll = pitch.cross(sample.r_WB.col(2)).normalized();

    // A leg that is shorter by the margin has the longer lever, one that is longer the shorter.
    const double bend = limb.bends_backward ? -1.0 : 1.0;
    const double min_lever = kMinLeverRatio * std::min(limb.upper, limb.lower);
    const Knee shorter(limb, length - limb.margin);
    const Vector3d knee = ankle + shorter.along * along + bend * std::max(shorter.beside, min_lever) * ahead;
    const Vector3d &force = sample.forces_W[l], &moment = sample.moments_W[l];
    const auto offer_torque = [&](const Vector3d& axis, const Vector3d& joint, double limit) {
      if (std::isinf(limit)) return;
      const double torque = axis.dot(moment + (position - joint).cross(force));
      findings.offer(Constraint::joint_torque, std::abs(torque) / limit - 1.0, place);
    };
    offer_torque(pitch, knee, limb.knee_torque);
    offer_torque(hip_roll, ankle + leg, limb.hip_torque[0]);
    offer_torque(pitch, ankle + leg, limb.hip_torque[1]);
    offer_torque(heading, ankle, limb.ankle_torque[0]);
    offer_torque(pitch, ankle, limb.ankle_torque[1]);

    const double max_length = std::sqrt(limb.upper * limb.upper - min_lever * min_lever) +
                              std::sqrt(limb.lower * limb.lower - min_lever * min_lever);
    findings.offer(StateLimit::reach, length + limb.margin - max_length, place);
    Seen& last = last_[l];
    const double since = sample.since_start_s - last.since_start_s;
    if (last.phase == sample.phase && since > 0.0 && std::isfinite(limb.knee_speed)) {
      const Knee middle(limb, 0.5 * (length + last.length) + limb.margin);
      const double lever = std::max(middle.beside, min_lever);
      findings.offer(StateLimit::joint_speed, std::abs(length - last.length) / since / lever / limb.knee_speed - 1.0,
                     place);
    }
    last = {sample.phase, sample.since_start_s, length};
  }
}

}  // namespace mcplan::checks
