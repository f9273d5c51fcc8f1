#include "mcplan/rhp/pieces/torque_bound.hpp"

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

TorqueForms::TorqueForms(const Placement& placement, const ContactPoint& point, double force_unit) {
  // lever = D x + d, force = F x
  Eigen::Matrix3Xd D = Eigen::Matrix3Xd::Zero(3, 5 + point.count()), F = D;
  D.leftCols<3>() = -Eigen::Matrix3d::Identity() / kLeverUnit;
  D.middleCols<2>(3) = placement.axes_W.leftCols<2>() / kLeverUnit;
  const Eigen::Vector3d d = (placement.origin_W + point.offset_W) / kLeverUnit;
  F.rightCols(point.count()) = kForceUnit / force_unit * point.directions_W(placement);

  // Torque component i = l_j d_k - l_k d_j with (i, j, k) cyclic: alpha = (-l_k, l_j), delta = (d_j, d_k).
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (int sign : {0, 1}) {
      const double s = sign == 0 ? 1.0 : -1.0;
      const int at = 2 * i + sign;
      E_[at].resize(2, D.cols());
      E_[at].row(0) = -D.row(k) + s * F.row(j);
      E_[at].row(1) = D.row(j) + s * F.row(k);
      e_[at] = Vector2d(-d[k], d[j]);
      EE_[at] = E_[at].transpose() * E_[at];
    }
  }
}

TorqueBound::TorqueBound(int com, const Placement& placement, const ContactPoint& point, double force_unit, int psi)
    : Piece("torque_bound", with_psi(TorqueForms::variables(com, placement, point), psi), TorqueForms::kCount),
      forms_(placement, point, force_unit),
      lifted_(psi >= 0) {}

void TorqueBound::values(const nlp::ConstVector& x, nlp::Vector f) const {
  const auto z = x.head(forms_.size());
  for (int j = 0; j < TorqueForms::kCount; ++j)
    f[j] = forms_.form(j, z).squaredNorm() - (lifted_ ? x[forms_.size() + j] : 0.0);
}

void TorqueBound::jacobian(const nlp::ConstVector& x, nlp::Matrix J) const {
  const auto z = x.head(forms_.size());
  for (int j = 0; j < TorqueForms::kCount; ++j) {
    J.row(j).head(forms_.size()).noalias() = 2.0 * forms_.form(j, z).transpose() * forms_.slope(j);
    if (lifted_) J(j, forms_.size() + j) = -1.0;
  }
}

void TorqueBound::hessian(const nlp::ConstVector&, const nlp::ConstVector& weights, nlp::Matrix H) const {
  auto block = H.topLeftCorner(forms_.size(), forms_.size());
  for (int j = 0; j < TorqueForms::kCount; ++j) block += 2.0 * weights[j] * forms_.squared_slope(j);
}

TorqueCost::TorqueCost(int com, const Placement& placement, const ContactPoint& point, double force_unit, double weight)
    : Piece("torque_cost", TorqueForms::variables(com, placement, point), 1),
      forms_(placement, point, force_unit),
      weight_(weight) {}

void TorqueCost::values(const nlp::ConstVector& x, nlp::Vector f) const {
  const auto z = x.head(forms_.size());
  f[0] = 0.0;
  for (int j = 0; j < TorqueForms::kCount; ++j) {
    const double square = forms_.form(j, z).squaredNorm();
    f[0] += weight_ * square * square;
  }
}

void TorqueCost::jacobian(const nlp::ConstVector& x, nlp::Matrix J) const {
  const auto z = x.head(forms_.size());
  for (int j = 0; j < TorqueForms::kCount; ++j) {
    const Vector2d e = forms_.form(j, z);
    J.row(0).noalias() += 4.0 * weight_ * e.squaredNorm() * (e.transpose() * forms_.slope(j));
  }
}

void TorqueCost::hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const {
  const auto z = x.head(forms_.size());
  const double w = weights[0] * weight_;
  for (int j = 0; j < TorqueForms::kCount; ++j) {
    const Vector2d e = forms_.form(j, z);
    H += 4.0 * w * e.squaredNorm() * forms_.squared_slope(j);
    const auto& slope = forms_.slope(j);
    for (int column = 0; column < forms_.size(); ++column)
      H.col(column).noalias() += 8.0 * w * e.dot(slope.col(column)) * (slope.transpose() * e);
  }
}

}  // namespace mcplan::rhp
