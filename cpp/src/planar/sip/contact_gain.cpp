#include "planar/sip/contact_gain.hpp"

#include <Eigen/LU>
#include <cmath>

namespace mcplan::sip {
namespace {

constexpr double kTangentialWeight = 10.0;  // alpha, sec. IV-B

/// Force (tangential, normal) at a point to force and moment.
Eigen::Matrix<double, 3, 2> grasp(const ContactGain::Point& point) {
  const Eigen::Vector2d &t = point.tangent, &x = point.place;
  const Eigen::Vector2d n(-t.y(), t.x());
  Eigen::Matrix<double, 3, 2> G;
  G << t.x(), n.x(), t.y(), n.y(), x.x() * t.y() - x.y() * t.x(), x.x() * n.y() - x.y() * n.x();
  return G;
}

}  // namespace

ContactGain::ContactGain(std::vector<Point> points, int parameters)
    : points_(std::move(points)), parameters_(parameters) {
  for (const Point& point : points_) grasp_.push_back(grasp(point));
  const int rows = 2 * this->points();
  value_.resize(rows, 3);
  first_.assign(parameters, Eigen::MatrixXd(rows, 3));
  second_.assign(parameters * parameters, Eigen::MatrixXd(rows, 3));
  part_.resize(parameters);
  X_.resize(parameters);
  weighted_.resize(points_.size());
  update(Eigen::VectorXd::Zero(parameters));
}

void ContactGain::update(const Eigen::Ref<const Eigen::VectorXd>& log_weights) {
  Eigen::Matrix3d omega = Eigen::Matrix3d::Zero();
  for (Eigen::Matrix3d& part : part_) part.setZero();
  for (int v = 0; v < points(); ++v) {
    const int a = points_[v].parameter;
    const double beta = a < 0 ? 1.0 : std::exp(log_weights[a]);
    weighted_[v] = Eigen::Vector2d(1.0 / (kTangentialWeight * beta), 1.0 / beta).asDiagonal() * grasp_[v].transpose();
    const Eigen::Matrix3d term = grasp_[v] * weighted_[v];
    omega += term;
    if (a >= 0) part_[a] += term;
  }
  const Eigen::Matrix3d inverse = omega.inverse();
  for (int a = 0; a < parameters_; ++a) X_[a] = part_[a] * inverse;

  const auto shifted = [&](int a, int v) -> Eigen::Matrix3d {
    return points_[v].parameter == a ? Eigen::Matrix3d(X_[a] - Eigen::Matrix3d::Identity()) : X_[a];
  };
  for (int v = 0; v < points(); ++v) {
    const Eigen::Matrix<double, 2, 3> K = weighted_[v] * inverse;
    value_.middleRows<2>(2 * v) = K;
    for (int a = 0; a < parameters_; ++a) {
      const Eigen::Matrix3d Xa = shifted(a, v);
      first_[a].middleRows<2>(2 * v) = K * Xa;
      for (int b = 0; b < parameters_; ++b) {
        Eigen::Matrix3d both = shifted(b, v) * Xa + X_[a] * X_[b];
        if (a == b) both -= X_[a];
        second_[a * parameters_ + b].middleRows<2>(2 * v) = K * both;
      }
    }
  }
}

}  // namespace mcplan::sip
