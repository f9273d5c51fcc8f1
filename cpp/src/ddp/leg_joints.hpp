#pragma once

#include <Eigen/Core>
#include <array>

#include "ddp/pendulum.hpp"
#include "ddp/problem.hpp"
#include "ddp/virtual_leg.hpp"

namespace mcplan::ddp {

/// An instant of a phase: the state at its begin and its input, and where the body is by then.
struct BodyAt {
  const Eigen::VectorXd &x, &u;
  double fraction;
  Eigen::Vector3d com, velocity;
  Eigen::Matrix3d rotation_WB;
};

/// A leg in contact at an instant: its hip (ddp/hip.hpp) moves with the CoM, the base and all legs, its ankle stands on
/// the surface, and it pushes with f = mu (p - s) at a. Non-dimensional.
struct StandingLeg {
  StandingLeg(const Problem& problem, const Pendulum& pendulum, int l, const Eigen::Matrix3d& sole, const BodyAt& at);

  const LimbLimits& limb;
  VirtualLeg::Links links;
  double by_com;          ///< by which the hip moves with the CoM
  Eigen::Vector3d own_B;  ///< of the hip: what turns with the base
  double mu;
  bool has_sole;
  Eigen::Vector3d u;         ///< hip - ankle
  Eigen::Vector3d heading;   ///< towards which the knee bends: that of the sole, or of the base
  Eigen::Vector3d up;        ///< the base's vertical
  Eigen::Vector3d lever;     ///< p - s
  Eigen::Vector3d force;     ///< mu lever
  Eigen::Vector3d acting;    ///< a - ankle
  Eigen::Vector3d velocity;  ///< of the hip, as the CoM moves it
};

/// Limits of the joints of such a leg, |value| <= limit:
///
///     |axis . ((a - joint) x f)| <= torque       of knee, hip and ankle, divided by the length of the upper link,
///     d <= the length at which the knee's lever is least,
///     |d'| <= lever(d) knee_speed                d the length of the leg.
///
/// Limits are planned smaller by kJointMargin. What turns of the base and legs that swing add to the hip's velocity is
/// left out, and the contact's own moment; not so in the checker. Theory: docs/theory/ddp.md, "Joint limits".
class LegJoints {
 public:
  enum Row { knee, hip_roll, hip_pitch, ankle_roll, ankle_pitch, length, speed };
  static constexpr std::array<Row, 5> kTorques = {knee, hip_roll, hip_pitch, ankle_roll, ankle_pitch};

  explicit LegJoints(const StandingLeg& leg);

  /// The torque or speed that a limb has for a row, infinite where it has none; of lengths there is none.
  static double limit_of(const LimbLimits& limb, Row row);

  double value(Row row) const;
  double limit(Row row) const;  ///< infinite: none

  /// Whether the force is too small for any of the limits on torques, as most forces of contacts that are only priced
  /// are.
  bool presses_little() const;

  /// Derivatives of sign value - limit by what the leg is made of.
  struct Slopes {
    Eigen::Vector3d u = Eigen::Vector3d::Zero(), heading = Eigen::Vector3d::Zero(), up = Eigen::Vector3d::Zero(),
                    force = Eigen::Vector3d::Zero(), acting = Eigen::Vector3d::Zero(),
                    velocity = Eigen::Vector3d::Zero();
  };
  Slopes slopes(Row row, double sign);

 private:
  Eigen::Vector3d axis(Row row) const;
  Eigen::Vector3d from_joint(Row row) const;  ///< a - joint
  Slopes torque_slopes(Row row) const;

  const StandingLeg& leg_;
  VirtualLeg bent_, stretched_;  ///< shorter by the margin, and longer
  bool differentiated_ = false;
  Eigen::Vector3d roll_;
  double across_length_;
};

}  // namespace mcplan::ddp
