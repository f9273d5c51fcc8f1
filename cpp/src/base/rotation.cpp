#include "mcplan/base/rotation.hpp"

#include <cmath>

namespace mcplan {
namespace {

using Eigen::Matrix3d;

/// Elementary rotation about `axis`, or its derivative with respect to the angle.
Matrix3d elementary(int axis, double angle, bool derivative) {
  const double c = derivative ? -std::sin(angle) : std::cos(angle);
  const double s = derivative ? std::cos(angle) : std::sin(angle);
  Matrix3d r = Matrix3d::Zero();
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  r(axis, axis) = derivative ? 0.0 : 1.0;
  r(i, i) = c;
  r(j, j) = c;
  r(i, j) = -s;
  r(j, i) = s;
  return r;
}

}  // namespace

Matrix3d rotation_from_rpy(const Eigen::Vector3d& rpy) {
  return elementary(2, rpy[2], false) * elementary(1, rpy[1], false) * elementary(0, rpy[0], false);
}

Matrix3d rotation_derivative(const Eigen::Vector3d& rpy, int i) {
  return elementary(2, rpy[2], i == 2) * elementary(1, rpy[1], i == 1) * elementary(0, rpy[0], i == 0);
}

Eigen::Vector4d quat_wxyz_from_rpy(const Eigen::Vector3d& rpy) {
  return quat_wxyz_from_rotation(rotation_from_rpy(rpy));
}

Eigen::Vector4d quat_wxyz_from_rotation(const Matrix3d& rotation) {
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace mcplan
