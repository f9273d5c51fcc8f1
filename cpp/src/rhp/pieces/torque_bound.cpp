#include "rhp/pieces/torque_bound.hpp"

namespace mcplan::rhp {
namespace {

using Eigen::Vector2d;

std::vector<int> with_psi(std::vector<int> variables, int psi) {
  if (psi >= 0) append(variables, psi, TorqueForms::kCount);
  return variables;
}

}  // namespace

std::vector<int> TorqueForms::variables(int com, const Placement& placement, const ContactPoint& point) {
  std::vector<int> variables;
  append(variables, com, 3);
  append(variables, placement.variable, 2);
  append(variables, point.variable, point.count());
  return variables;
}

TorqueForms::TorqueForms(const Placement& placement, const ContactPoint& point, double force_unit)
    : directions_(point.directions_W(placement)) {
  // lever = D z + d, force = F z
  Eigen::Matrix<double, 3, kSize> D = Eigen::Matrix<double, 3, kSize>::Zero(), F = D;
  D.leftCols<3>() = -Eigen::Matrix3d::Identity() / kLeverUnit;
  D.middleCols<2>(3) = placement.axes_W.leftCols<2>() / kLeverUnit;
  const Eigen::Vector3d d = (placement.origin_W + point.offset_W) / kLeverUnit;
  F.rightCols<3>() = kForceUnit / force_unit * Eigen::Matrix3d::Identity();

  // Torque component i = l_j d_k - l_k d_j with (i, j, k) cyclic: alpha = (-l_k, l_j), delta = (d_j, d_k).
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (int sign : {0, 1}) {
      const double s = sign == 0 ? 1.0 : -1.0;
      const int at = 2 * i + sign;
      E_[at].row(0) = -D.row(k) + s * F.row(j);
      E_[at].row(1) = D.row(j) + s * F.row(k);
      e_[at] = Vector2d(-d[k], d[j]);
      EE_[at] = E_[at].transpose() * E_[at];
    }
  }
}

TorqueForms::Point TorqueForms::point(const nlp::ConstVector& x) const {
  Point z;
  z.head<5>() = x.head<5>();
  z.tail<3>().noalias() = directions_ * x.segment(5, directions_.cols());
  return z;
}

void TorqueForms::expand_row(const Eigen::Matrix<double, 1, kSize>& row, int at, nlp::Matrix J) const {
  J.row(at).head<5>() = row.head<5>();
  J.row(at).segment(5, directions_.cols()).noalias() = row.tail<3>() * directions_;
}

void TorqueForms::expand(const Square& square, nlp::Matrix H) const {
  const auto n = directions_.cols();
  H.topLeftCorner<5, 5>() = square.topLeftCorner<5, 5>();
  H.block(5, 0, n, 5).noalias() = directions_.transpose() * square.bottomLeftCorner<3, 5>();
  const Eigen::Matrix3d force = square.bottomRightCorner<3, 3>();
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d along = force * directions_.col(i);
    for (int j = i; j < n; ++j) H(5 + j, 5 + i) = along.dot(directions_.col(j));
  }
}

TorqueBound::TorqueBound(int com, const Placement& placement, const ContactPoint& point, double force_unit, int psi)
    : Piece("torque_bound", with_psi(TorqueForms::variables(com, placement, point), psi), TorqueForms::kCount),
      forms_(placement, point, force_unit),
      lifted_(psi >= 0) {}

void TorqueBound::values(const nlp::ConstVector& x, nlp::Vector f) const {
  const TorqueForms::Point z = forms_.point(x);
  for (int j = 0; j < TorqueForms::kCount; ++j)
    f[j] = forms_.form(j, z).squaredNorm() - (lifted_ ? x[forms_.size() + j] : 0.0);
}

void TorqueBound::jacobian(const nlp::ConstVector& x, nlp::Matrix J) const {
  const TorqueForms::Point z = forms_.point(x);
  for (int j = 0; j < TorqueForms::kCount; ++j) {
    forms_.expand_row(2.0 * forms_.form(j, z).transpose() * forms_.slope(j), j, J);
    if (lifted_) J(j, forms_.size() + j) = -1.0;
  }
}

void TorqueBound::hessian(const nlp::ConstVector&, const nlp::ConstVector& weights, nlp::Matrix H) const {
  TorqueForms::Square sum = TorqueForms::Square::Zero();
  for (int j = 0; j < TorqueForms::kCount; ++j) sum += 2.0 * weights[j] * forms_.squared_slope(j);
  forms_.expand(sum, H);
}

TorqueCost::TorqueCost(int com, const Placement& placement, const ContactPoint& point, double force_unit, double weight)
    : Piece("torque_cost", TorqueForms::variables(com, placement, point), 1),
      forms_(placement, point, force_unit),
      weight_(weight) {}

void TorqueCost::values(const nlp::ConstVector& x, nlp::Vector f) const {
  const TorqueForms::Point z = forms_.point(x);
  f[0] = 0.0;
  for (int j = 0; j < TorqueForms::kCount; ++j) {
    const double square = forms_.form(j, z).squaredNorm();
    f[0] += weight_ * square * square;
  }
}

void TorqueCost::jacobian(const nlp::ConstVector& x, nlp::Matrix J) const {
  const TorqueForms::Point z = forms_.point(x);
  Eigen::Matrix<double, 1, TorqueForms::kSize> row = Eigen::Matrix<double, 1, TorqueForms::kSize>::Zero();
  for (int j = 0; j < TorqueForms::kCount; ++j) {
    const Vector2d e = forms_.form(j, z);
    row += 4.0 * weight_ * e.squaredNorm() * (e.transpose() * forms_.slope(j));
  }
  forms_.expand_row(row, 0, J);
}

void TorqueCost::hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const {
  const TorqueForms::Point z = forms_.point(x);
  const double w = weights[0] * weight_;
  TorqueForms::Square sum = TorqueForms::Square::Zero();
  for (int j = 0; j < TorqueForms::kCount; ++j) {
    const Vector2d e = forms_.form(j, z);
    const TorqueForms::Point slope = forms_.slope(j).transpose() * e;
    sum += 4.0 * w * e.squaredNorm() * forms_.squared_slope(j) + 8.0 * w * slope * slope.transpose();
  }
  forms_.expand(sum, H);
}

}  // namespace mcplan::rhp
