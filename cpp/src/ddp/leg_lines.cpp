#include "ddp/leg_lines.hpp"

namespace mcplan::ddp {

using Eigen::Vector3d;

LegLines::LegLines(const LimbLimits& limb, const Vector3d& ankle, const Vector3d& u, const Vector3d& heading)
    : leg_({limb.upper, limb.lower, limb.bends_backward ? -1.0 : 1.0}, u, heading, 0.0),
      ankle_(ankle),
      u_(u),
      beside_(limb.beside) {}

Vector3d LegLines::from(Part part) const {
  return ankle_ + (part == thigh ? u_ : leg_.from_ankle()) + beside_ * leg_.axis();
}

Vector3d LegLines::along(Part part) const {
  return part == thigh ? Vector3d(leg_.from_ankle() - u_) : Vector3d(-0.5 * leg_.from_ankle());
}

LegLines::Slopes LegLines::slopes(Part part, double s, const Vector3d& n) {
  if (!differentiated_) leg_.differentiate();
  differentiated_ = true;
  const double by_u = part == thigh ? 1.0 - s : 0.0, by_knee = part == thigh ? s : 1.0 - 0.5 * s;
  return {by_u * n + by_knee * leg_.knee_by_u().transpose() * n + beside_ * leg_.axis_by_u().transpose() * n,
          by_knee * leg_.knee_by_heading().transpose() * n + beside_ * leg_.axis_by_heading().transpose() * n};
}

}  // namespace mcplan::ddp
