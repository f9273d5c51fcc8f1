#include "ddp/virtual_leg.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "ddp/constants.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d cross_with(const Vector3d& v) {
  Matrix3d out;
  out << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return out;
}

/// d(v/|v|)/dv
Matrix3d direction_derivative(const Vector3d& unit, double length) {
  return (Matrix3d::Identity() - unit * unit.transpose()) / length;
}

constexpr double kTiny = 1e-9;

}  // namespace

double VirtualLeg::min_lever(const Links& links) { return kMinLeverRatio * std::min(links.upper, links.lower); }

double VirtualLeg::max_length(const Links& links) {
  const double r = min_lever(links);
  return std::sqrt(links.upper * links.upper - r * r) + std::sqrt(links.lower * links.lower - r * r);
}

VirtualLeg::VirtualLeg(const Links& links, const Vector3d& u, const Vector3d& heading, double longer)
    : links_(links), u_(u), heading_(heading) {
  length_ = std::max(u.norm(), kTiny);
  unit_ = u / length_;
  const Vector3d normal = u.cross(heading);
  normal_length_ = std::max(normal.norm(), kTiny);
  axis_ = normal / normal_length_;
  across_ = links.bend * axis_.cross(unit_);
  const double a = links.upper, b = links.lower;
  const double d = std::max(length_ + longer, kTiny), least = min_lever(links);
  along_ = (d * d + b * b - a * a) / (2.0 * d);
  along_by_length_ = (d * d + a * a - b * b) / (2.0 * d * d);
  const double square = b * b - along_ * along_;
  lever_ = square > least * least ? std::sqrt(square) : least;
  lever_by_length_ = square > least * least ? -along_ / lever_ * along_by_length_ : 0.0;
  knee_ = along_ * unit_ + lever_ * across_;
}

void VirtualLeg::differentiate() {
  unit_by_u_ = direction_derivative(unit_, length_);
  const Matrix3d by_normal = direction_derivative(axis_, normal_length_);
  axis_by_u_ = -by_normal * cross_with(heading_);
  axis_by_heading_ = by_normal * cross_with(u_);
  const Matrix3d across_by_axis = -links_.bend * cross_with(unit_);
  const Matrix3d across_by_u = across_by_axis * axis_by_u_ + links_.bend * cross_with(axis_) * unit_by_u_;
  knee_by_u_ = (along_by_length_ * unit_ + lever_by_length_ * across_) * unit_.transpose() + along_ * unit_by_u_ +
               lever_ * across_by_u;
  knee_by_heading_ = lever_ * across_by_axis * axis_by_heading_;
}

}  // namespace mcplan::ddp
