#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "ddp/constants.hpp"
#include "ddp/hip.hpp"
#include "ddp/virtual_leg.hpp"
#include "force_rows.hpp"
#include "mcplan/base/rotation.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A leg in contact at one instant: its hip moves with the CoM, the base and all legs, its ankle stands on the surface,
/// and it pushes with f = mu (p - s) at a.
struct Stand {
  Stand(const StepView& step, const Instant& instant_in, const Matrix3d& sole)
      : instant(instant_in), limb(step.problem.limits[step.l].limb) {
    const Problem& problem = step.problem;
    const Layout& at = problem.layout;
    rotation = rotation_from_rpy(instant.rpy);
    const Hip hip(problem, limb, instant.com, rotation, step.x, step.u, instant.fraction);
    hip_B = hip.own_B;
    by_com = hip.by_com;
    ankle = step.x.segment<3>(at.end(step.l)) + sole * limb.ankle;
    has_sole = problem.limits[step.l].half_size.maxCoeff() > 0.0;
    heading = has_sole ? Vector3d(sole.col(0)) : Vector3d(rotation.col(0));
    links = {limb.upper, limb.lower, limb.bends_backward ? -1.0 : 1.0};
    u = hip.place_W - ankle;
    lever = instant.com - at.line_point(step.x, *step.u, step.l);
    mu = step.pendulum.mu(*step.u, step.l);
    force = mu * lever;
    acting = at.acting_point(step.x, *step.u, step.l) - ankle;
  }

  const Instant& instant;
  const LimbLimits& limb;  ///< in units of the problem
  VirtualLeg::Links links{};
  Matrix3d rotation;
  Vector3d hip_B, ankle, heading, u, force, lever, acting;  ///< acting: where the force acts, from the ankle
  double by_com = 1.0, mu = 0.0;
  bool has_sole = true;
};

/// A row's derivatives by what the geometry of a Stand is made of.
struct Slopes {
  Vector3d u = Vector3d::Zero(), heading = Vector3d::Zero(), up = Vector3d::Zero(), force = Vector3d::Zero(),
           acting = Vector3d::Zero(), velocity = Vector3d::Zero();
};

void add_row(const StepView& step, const Stand& stand, double value, const Slopes& by, Rows& rows) {
  const double weight = step.schedule.interior_weight;
  const Layout& at = step.problem.layout;
  auto g = rows.add_dense(weight, value);
  Vector3d along_rpy = Vector3d::Zero();
  for (int axis : at.axes()) {
    const Matrix3d turned = rotation_derivative(stand.instant.rpy, axis);
    along_rpy[axis] = by.u.dot(turned * stand.hip_B) + by.up.dot(turned.col(2));
    if (!stand.has_sole) along_rpy[axis] += by.heading.dot(turned.col(0));
  }
  stand.instant.add_along(stand.by_com * by.u + stand.mu * by.force, along_rpy, g);
  if (!by.velocity.isZero(0.0)) stand.instant.add_along_velocity(by.velocity, g);
  at.add_along_line_point(step.l, -stand.mu * by.force, g);
  at.add_along_acting_point(step.l, by.acting, g);
  // The ankle moves with the end-effector.
  g.segment<3>(at.end(step.l)) -= by.u + by.acting;
  for (int m : step.problem.jointed.ends) {
    g.segment<3>(at.end(m)) += stand.limb.hip_shift * by.u;
    g.segment<3>(at.nx() + at.stride(m)) += stand.limb.hip_shift * stand.instant.fraction * by.u;
  }
  g[at.nx() + at.stiffness(step.l)] += by.force.dot(stand.lever) * stiffness_slope(step);
}

/// |axis . ((a - joint) x f)| <= torque, of all joints of a leg at an instant, divided by the length of its upper link.
class TorqueRows {
 public:
  TorqueRows(const StepView& step, const Stand& stand, Rows& rows)
      : step_(step),
        stand_(stand),
        rows_(rows),
        // The knee of a leg that is shorter has the longer lever.
        leg_(stand.links, stand.u, stand.heading, -stand.limb.margin),
        up_(stand.rotation.col(2)) {
    const Vector3d across = leg_.axis().cross(up_);
    across_length_ = std::max(across.norm(), 1e-9);
    roll_ = across / across_length_;
  }

  void write() {
    const LimbLimits& limb = stand_.limb;
    hold(About::pitch, At::knee, limb.knee_torque);
    hold(About::roll, At::hip, limb.hip_torque[0]);
    hold(About::pitch, At::hip, limb.hip_torque[1]);
    hold(About::heading, At::ankle, limb.ankle_torque[0]);
    hold(About::pitch, At::ankle, limb.ankle_torque[1]);
  }

  /// Whether the force is too small for any of the limits, as most forces of contacts that are only priced are.
  static bool too_small(const Stand& stand) {
    const LimbLimits& limb = stand.limb;
    const double least = std::min({limb.knee_torque, limb.hip_torque.minCoeff(), limb.ankle_torque.minCoeff()});
    const double longest = stand.acting.norm() + std::max(stand.u.norm(), limb.lower);
    return stand.force.norm() * longest <= kJointMargin * least;
  }

 private:
  enum class About { pitch, roll, heading };
  enum class At { knee, hip, ankle };

  void hold(About about, At at, double limit) {
    const Vector3d axis = about == About::pitch ? leg_.axis() : about == About::roll ? roll_ : stand_.heading;
    Vector3d from = stand_.acting;
    if (at == At::hip) from -= stand_.u;
    if (at == At::knee) from -= leg_.from_ankle();
    const Vector3d moment = from.cross(stand_.force);
    const double torque = axis.dot(moment), beyond = std::abs(torque) - kJointMargin * limit;
    if (!(beyond > 0.0)) return;
    const double scale = 1.0 / stand_.limb.upper;
    if (!rows_.with_gradient()) {
      rows_.add_value(step_.schedule.interior_weight, scale * beyond);
      return;
    }
    if (!differentiated_) leg_.differentiate();
    differentiated_ = true;
    Slopes by;
    by.force = axis.cross(from);
    by.acting = stand_.force.cross(axis);
    turn(about, moment, by);
    if (at == At::hip) by.u -= by.acting;
    if (at == At::knee) {
      by.u -= leg_.knee_by_u().transpose() * by.acting;
      by.heading -= leg_.knee_by_heading().transpose() * by.acting;
    }
    for (Vector3d* slope : {&by.u, &by.heading, &by.up, &by.force, &by.acting}) *slope *= torque > 0.0 ? scale : -scale;
    add_row(step_, stand_, scale * beyond, by, rows_);
  }

  /// What the axis does to axis . moment.
  void turn(About about, const Vector3d& moment, Slopes& by) const {
    Vector3d by_pitch = moment;
    if (about == About::heading) {
      by.heading += moment;
      return;
    }
    if (about == About::roll) {
      const Vector3d by_across = (moment - roll_ * roll_.dot(moment)) / across_length_;
      by_pitch = up_.cross(by_across);
      by.up += by_across.cross(leg_.axis());
    }
    by.u += leg_.axis_by_u().transpose() * by_pitch;
    by.heading += leg_.axis_by_heading().transpose() * by_pitch;
  }

  const StepView& step_;
  const Stand& stand_;
  Rows& rows_;
  VirtualLeg leg_;
  Vector3d up_, roll_;
  double across_length_ = 1.0;
  bool differentiated_ = false;
};

/// Joint limits of the leg that carries an end-effector in contact, at every instant, of the virtual leg of LimbLimits:
///     |axis . ((a - joint) x f)| <= torque       of knee, hip and ankle,
///     |d'| <= lever(d) knee_speed                d the length of the leg,
///     d <= the length at which the knee's lever is least.
/// Limits are planned smaller by kJointMargin. What turns of the base and legs that swing add to the hip's velocity is
/// left out of the rows, not of the checker. Not in the paper.
class JointLimits final : public CostTerm {
 public:
  JointLimits() : CostTerm("joint_limits", Scope::contact, 80) {}

  bool applies(const StepView& step) const override {
    return step.schedule.tuning.hold_joints && step.between_knots() && step.problem.limits[step.l].limb.given();
  }

  void write(const StepView& step, Rows& rows) const override {
    const Matrix3d sole = step.problem.sole_frame(step.surface, step.sole_yaw);
    for (const Instant& instant : step.instants) {
      const Stand stand(step, instant, sole);
      if (!TorqueRows::too_small(stand)) TorqueRows(step, stand, rows).write();
      write_speed(step, stand, rows);
    }
  }

 private:
  static void write_speed(const StepView& step, const Stand& stand, Rows& rows) {
    const LimbLimits& limb = stand.limb;
    VirtualLeg leg(stand.links, stand.u, stand.heading, limb.margin);
    const double too_long = leg.length() + limb.margin - VirtualLeg::max_length(stand.links);
    const double max_speed = kJointMargin * limb.knee_speed;
    const double speed = stand.by_com * leg.direction().dot(stand.instant.velocity);
    const double too_fast = std::isinf(max_speed) ? 0.0 : std::abs(speed) - leg.lever() * max_speed;
    if (too_long <= 0.0 && too_fast <= 0.0) return;
    if (!rows.with_gradient()) {
      for (double beyond : {too_long, too_fast})
        if (beyond > 0.0) rows.add_value(step.schedule.interior_weight, beyond);
      return;
    }
    leg.differentiate();
    if (too_long > 0.0) {
      Slopes by;
      by.u = leg.direction();
      add_row(step, stand, too_long, by, rows);
    }
    if (too_fast > 0.0) {
      const double sign = speed > 0.0 ? 1.0 : -1.0;
      Slopes by;
      by.velocity = sign * stand.by_com * leg.direction();
      by.u = sign * stand.by_com * leg.direction_by_u().transpose() * stand.instant.velocity -
             max_speed * leg.lever_by_length() * leg.direction();
      add_row(step, stand, too_fast, by, rows);
    }
  }
};

}  // namespace

namespace cost {
const CostTerm& joint_limits() {
  static const JointLimits term;
  return term;
}
}  // namespace cost

}  // namespace mcplan::ddp
