#pragma once

#include <Eigen/Core>

namespace mcplan::ddp {

/// A leg of two links that bend in one plane: that of the line from ankle to hip and of the direction in which the sole
/// heads. With u = hip - ankle, d = |u|, links a above and b below the knee,
///
///     e = u x heading / |u x heading|                 the axis of the knee, to the left of a leg that stands
///     s = (d^2 + b^2 - a^2) / (2 d)                   from the ankle along u to beside the knee
///     r = sqrt(b^2 - s^2)                             from there to the knee: its lever
///     knee = ankle + s u/d + r e x u/d                behind the line for a leg that bends backward
///
/// since area = d r / 2 = a b sin(q) / 2, the knee turns by q' = d' / r, and a force along u asks it for r times the
/// force. The lever is kept above a ratio of the shorter link where the leg is stretched. Theory: docs/theory/ddp.md,
/// "Joint limits".
class VirtualLeg {
 public:
  struct Links {
    double upper, lower;
    double bend = 1.0;  ///< -1: backward
  };

  /// Bent as if the hip were `longer` farther away (nearer for negative ones); `heading` is of unit length.
  VirtualLeg(const Links& links, const Eigen::Vector3d& u, const Eigen::Vector3d& heading, double longer);

  double length() const { return length_; }                    ///< d
  double lever() const { return lever_; }                      ///< r
  const Eigen::Vector3d& direction() const { return unit_; }   ///< u / d
  const Eigen::Vector3d& axis() const { return axis_; }        ///< e
  const Eigen::Vector3d& from_ankle() const { return knee_; }  ///< knee - ankle

  /// Derivatives, worked out by differentiate().
  void differentiate();
  double lever_by_length() const { return lever_by_length_; }
  const Eigen::Matrix3d& direction_by_u() const { return unit_by_u_; }
  const Eigen::Matrix3d& axis_by_u() const { return axis_by_u_; }
  const Eigen::Matrix3d& axis_by_heading() const { return axis_by_heading_; }
  const Eigen::Matrix3d& knee_by_u() const { return knee_by_u_; }
  const Eigen::Matrix3d& knee_by_heading() const { return knee_by_heading_; }

  /// The least lever of links, and the length at which a leg has it.
  static double min_lever(const Links& links);
  static double max_length(const Links& links);

 private:
  Links links_;
  Eigen::Vector3d u_, heading_, unit_, axis_, across_, knee_;
  double length_, normal_length_, along_, along_by_length_, lever_, lever_by_length_;
  Eigen::Matrix3d unit_by_u_, axis_by_u_, axis_by_heading_, knee_by_u_, knee_by_heading_;
};

}  // namespace mcplan::ddp
