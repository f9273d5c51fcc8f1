#pragma once

#include <Eigen/Core>

#include "ddp/virtual_leg.hpp"
#include "mcplan/robot/robot.hpp"

namespace mcplan::ddp {

/// Lines of the capsules about a leg: from the hip to the knee, and from there down half of the lower link. With the
/// hip at u from the ankle, K from the ankle to the knee and e the axis of the knee (ddp/virtual_leg.hpp),
///
///     thigh(s) = ankle + (1 - s) u + s K + beside e,      shank(s) = ankle + (1 - s / 2) K + beside e,    0 <= s <= 1.
class LegLines {
 public:
  enum Part { thigh, shank };

  LegLines(const LimbLimits& limb, const Eigen::Vector3d& ankle, const Eigen::Vector3d& u,
           const Eigen::Vector3d& heading);

  Eigen::Vector3d from(Part part) const;
  Eigen::Vector3d along(Part part) const;

  /// Derivatives of n . line(s), beside that by the ankle with u and heading as they are, which is n.
  struct Slopes {
    Eigen::Vector3d u, heading;
  };
  Slopes slopes(Part part, double s, const Eigen::Vector3d& n);

 private:
  VirtualLeg leg_;
  Eigen::Vector3d ankle_, u_;
  double beside_;
  bool differentiated_ = false;
};

/// Distance from such a line at which solids are kept, in units of the radius. Chosen: posture and plan differ by a few
/// centimetres.
constexpr double kLegRoom = 1.25;

}  // namespace mcplan::ddp
