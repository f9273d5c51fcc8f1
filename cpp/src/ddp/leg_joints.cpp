#include "ddp/leg_joints.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "ddp/constants.hpp"
#include "ddp/hip.hpp"

namespace mcplan::ddp {

using Eigen::Matrix3d;
using Eigen::Vector3d;

StandingLeg::StandingLeg(const Problem& problem, const Pendulum& pendulum, int l, const Matrix3d& sole,
                         const BodyAt& at)
    : limb(problem.limits[l].limb),
      links{limb.upper, limb.lower, limb.bends_backward ? -1.0 : 1.0},
      mu(pendulum.mu(at.u, l)),
      has_sole(problem.limits[l].half_size.maxCoeff() > 0.0),
      heading(has_sole ? sole.col(0) : at.rotation_WB.col(0)),
      up(at.rotation_WB.col(2)),
      lever(at.com - problem.layout.line_point(at.x, at.u, l)),
      force(mu * lever) {
  const Hip hip(problem, limb, at.com, at.rotation_WB, at.x, &at.u, at.fraction);
  by_com = hip.by_com;
  own_B = hip.own_B;
  velocity = by_com * at.velocity;
  const Vector3d ankle = at.x.segment<3>(problem.layout.end(l)) + sole * limb.ankle;
  u = hip.place_W - ankle;
  acting = problem.layout.acting_point(at.x, at.u, l) - ankle;
}

// The knee of a leg that is shorter has the longer lever, that of one that is longer turns faster.
LegJoints::LegJoints(const StandingLeg& leg)
    : leg_(leg),
      bent_(leg.links, leg.u, leg.heading, -leg.limb.margin),
      stretched_(leg.links, leg.u, leg.heading, leg.limb.margin) {
  const Vector3d across = bent_.axis().cross(leg.up);
  across_length_ = std::max(across.norm(), 1e-9);
  roll_ = across / across_length_;
}

bool LegJoints::presses_little() const {
  const LimbLimits& limb = leg_.limb;
  const double least = std::min({limb.knee_torque, limb.hip_torque.minCoeff(), limb.ankle_torque.minCoeff()});
  const double longest = leg_.acting.norm() + std::max(leg_.u.norm(), limb.lower);
  return leg_.force.norm() * longest <= kJointMargin * least;
}

/// Of the torque. The knee's axis is the pitch axis of hip and ankle, too.
Vector3d LegJoints::axis(Row row) const {
  if (row == hip_roll) return roll_;
  return row == ankle_roll ? leg_.heading : bent_.axis();
}

Vector3d LegJoints::from_joint(Row row) const {
  if (row == knee) return leg_.acting - bent_.from_ankle();
  return row == hip_roll || row == hip_pitch ? Vector3d(leg_.acting - leg_.u) : leg_.acting;
}

double LegJoints::value(Row row) const {
  if (row == length) return stretched_.length() + leg_.limb.margin;
  if (row == speed) return stretched_.direction().dot(leg_.velocity);
  return axis(row).dot(from_joint(row).cross(leg_.force)) / leg_.limb.upper;
}

double LegJoints::limit_of(const LimbLimits& limb, Row row) {
  switch (row) {
    case knee:
      return limb.knee_torque;
    case hip_roll:
      return limb.hip_torque[0];
    case hip_pitch:
      return limb.hip_torque[1];
    case ankle_roll:
      return limb.ankle_torque[0];
    case ankle_pitch:
      return limb.ankle_torque[1];
    case speed:
      return limb.knee_speed;
    case length:
      break;
  }
  return std::numeric_limits<double>::infinity();
}

double LegJoints::limit(Row row) const {
  if (row == length) return VirtualLeg::max_length(leg_.links);
  const double planned = kJointMargin * limit_of(leg_.limb, row);
  return row == speed ? stretched_.lever() * planned : planned / leg_.limb.upper;
}

LegJoints::Slopes LegJoints::torque_slopes(Row row) const {
  const Vector3d about = axis(row), from = from_joint(row), moment = from.cross(leg_.force);
  Slopes by;
  by.force = about.cross(from);
  by.acting = leg_.force.cross(about);
  // By the axis.
  if (row == ankle_roll) {
    by.heading += moment;
  } else {
    Vector3d by_pitch = moment;
    if (row == hip_roll) {
      const Vector3d by_across = (moment - roll_ * roll_.dot(moment)) / across_length_;
      by_pitch = leg_.up.cross(by_across);
      by.up += by_across.cross(bent_.axis());
    }
    by.u += bent_.axis_by_u().transpose() * by_pitch;
    by.heading += bent_.axis_by_heading().transpose() * by_pitch;
  }
  // By the joint's place.
  if (row == hip_roll || row == hip_pitch) by.u -= by.acting;
  if (row == knee) {
    by.u -= bent_.knee_by_u().transpose() * by.acting;
    by.heading -= bent_.knee_by_heading().transpose() * by.acting;
  }
  return by;
}

LegJoints::Slopes LegJoints::slopes(Row row, double sign) {
  if (!differentiated_) {
    bent_.differentiate();
    stretched_.differentiate();
    differentiated_ = true;
  }
  Slopes by;
  if (row == length) {
    by.u = sign * stretched_.direction();
  } else if (row == speed) {
    by.velocity = sign * stretched_.direction();
    by.u = sign * stretched_.direction_by_u().transpose() * leg_.velocity -
           kJointMargin * leg_.limb.knee_speed * stretched_.lever_by_length() * stretched_.direction();
  } else {
    by = torque_slopes(row);
    for (Vector3d* slope : {&by.u, &by.heading, &by.up, &by.force, &by.acting}) *slope *= sign / leg_.limb.upper;
  }
  return by;
}

}  // namespace mcplan::ddp
