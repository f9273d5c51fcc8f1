#include "wb/kinematics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace mcplan::wb {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Kinematics::Kinematics(const Problem& problem) : links_(problem.links) {
  const std::size_t count = links_.size();
  chains_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (links_[i].parent >= 0) chains_[i] = chains_[links_[i].parent];
    chains_[i].push_back(static_cast<int>(i));
  }
  rotations_.assign(count, Matrix3d::Identity());
  positions_.assign(count, Vector3d::Zero());
  linear_ = angular_ = moments_ = positions_;
  masses_.assign(count, 0.0);
}

void Kinematics::update(const Eigen::Ref<const Eigen::VectorXd>& q) {
  const int count = static_cast<int>(links_.size());
  for (int i = 0; i < count; ++i) {
    const Link& link = links_[i];
    Matrix3d R = link.rotation;
    Vector3d p = link.position;
    if (link.prismatic)
      p += R * (q[i] * link.axis);
    else
      R = R * Eigen::AngleAxisd(q[i], link.axis).toRotationMatrix();
    if (link.parent >= 0) {
      p = rotations_[link.parent] * p + positions_[link.parent];
      R = rotations_[link.parent] * R;
    }
    rotations_[i] = R;
    positions_[i] = p;
    const Vector3d axis = R * link.axis;
    angular_[i] = link.prismatic ? Vector3d(Vector3d::Zero()) : axis;
    linear_[i] = link.prismatic ? axis : Vector3d(p.cross(axis));
    masses_[i] = link.mass;
    moments_[i] = link.mass * point(i, link.center_of_mass);
  }
  double mass = 0.0;
  com_.setZero();
  for (int i = count - 1; i >= 0; --i) {
    if (const int parent = links_[i].parent; parent >= 0) {
      masses_[parent] += masses_[i];
      moments_[parent] += moments_[i];
    } else {
      mass += masses_[i];
      com_ += moments_[i];
    }
  }
  com_ /= mass;
}

void Kinematics::point_jacobian(int link, const Vector3d& position_W, Eigen::Ref<Eigen::MatrixXd> out) const {
  out.setZero();
  for (int i : chains_[link]) out.col(i) = linear_[i] + angular_[i].cross(position_W);
}

void Kinematics::rotation_jacobian(int link, Eigen::Ref<Eigen::MatrixXd> out) const {
  out.setZero();
  for (int i : chains_[link]) out.col(i) = angular_[i];
}

void Kinematics::com_jacobian(Eigen::Ref<Eigen::MatrixXd> out) const {
  double mass = 0.0;
  for (const Link& link : links_) mass += link.mass;
  for (std::size_t i = 0; i < links_.size(); ++i)
    out.col(static_cast<Eigen::Index>(i)) = (masses_[i] * linear_[i] + angular_[i].cross(moments_[i])) / mass;
}

Eigen::Matrix<double, 6, 1> Kinematics::velocity(int link, const Vector3d& position_W,
                                                 const Eigen::Ref<const Eigen::VectorXd>& v) const {
  Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();
  for (int i : chains_[link]) {
    linear += v[i] * linear_[i];
    angular += v[i] * angular_[i];
  }
  Eigen::Matrix<double, 6, 1> out;
  out << linear + angular.cross(position_W), angular;
  return out;
}

/// Joint i turns the columns of all joints that it carries: dS_m / dq_i = S_i x S_m (Featherstone, Rigid Body Dynamics
/// Algorithms, section 2.5), so that the link's velocity changes by S_i x (V - V_i), V_i with joint i included.
void Kinematics::velocity_derivative(int link, const Vector3d& position_W, const Eigen::Ref<const Eigen::VectorXd>& v,
                                     Eigen::Ref<Eigen::MatrixXd> out) const {
  out.setZero();
  const std::vector<int>& chain = chains_[link];
  Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();
  for (auto i = chain.rbegin(); i != chain.rend(); ++i) {
    const Vector3d turned = angular_[*i].cross(angular);
    const Vector3d moved = angular_[*i].cross(linear) + linear_[*i].cross(angular);
    out.col(*i) << moved + turned.cross(position_W), turned;
    linear += v[*i] * linear_[*i];
    angular += v[*i] * angular_[*i];
  }
}

Vector3d rotation_log(const Matrix3d& R) {
  const Vector3d sine = 0.5 * Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  const double s = sine.norm(), c = 0.5 * (R.trace() - 1.0);
  if (s < 1e-9 && c > 0.0) return sine;
  if (s > 1e-6) return sine * (std::atan2(s, c) / s);
  const Eigen::AngleAxisd turn(R);  // half a revolution
  return turn.angle() * turn.axis();
}

/// I + [w] / 2 + (1 / |w|^2 - (1 + cos |w|) / (2 |w| sin |w|)) [w]^2: the inverse of the right Jacobian of SO(3).
Matrix3d rotation_log_jacobian(const Vector3d& log) {
  const double angle = log.norm();
  Matrix3d cross;
  cross << 0.0, -log.z(), log.y(), log.z(), 0.0, -log.x(), -log.y(), log.x(), 0.0;
  const double factor =
      angle < 1e-4 ? 1.0 / 12.0 : 1.0 / (angle * angle) - 0.5 / (angle * std::tan(0.5 * std::min(angle, 3.1)));
  return Matrix3d::Identity() + 0.5 * cross + factor * cross * cross;
}

}  // namespace mcplan::wb
