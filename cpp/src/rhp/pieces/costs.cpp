#include "rhp/pieces/costs.hpp"

#include <utility>

#include "rhp/pieces/contact_point.hpp"

namespace mcplan::rhp {
namespace {

std::vector<int> gather(std::initializer_list<std::pair<int, int>> groups) {
  std::vector<int> variables;
  for (const auto& [first, count] : groups) append(variables, first, count);
  return variables;
}

}  // namespace

// x = (y, T)

SquareOverTime::SquareOverTime(const std::string& name, int y, int duration, double weight)
    : Piece(name, gather({{y, 3}, {duration, 1}}), 1), weight_(weight) {}

void SquareOverTime::values(const nlp::ConstVector& x, nlp::Vector f) const {
  f[0] = weight_ * x[3] * x.head<3>().squaredNorm();
}

void SquareOverTime::jacobian(const nlp::ConstVector& x, nlp::Matrix J) const {
  J.leftCols<3>() = 2.0 * weight_ * x[3] * x.head<3>().transpose();
  J(0, 3) = weight_ * x.head<3>().squaredNorm();
}

void SquareOverTime::hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const {
  H.topLeftCorner<3, 3>().diagonal().setConstant(2.0 * weights[0] * weight_ * x[3]);
  H.block<1, 3>(3, 0) = 2.0 * weights[0] * weight_ * x.head<3>().transpose();
}

// x = (y0, y1, T)

LinearSquareOverTime::LinearSquareOverTime(const std::string& name, int y0, int y1, int duration, int intervals)
    : Piece(name, gather({{y0, 3}, {y1, 3}, {duration, 1}}), 1), third_(1.0 / (3.0 * intervals)) {}

void LinearSquareOverTime::values(const nlp::ConstVector& x, nlp::Vector f) const {
  const auto y0 = x.head<3>(), y1 = x.segment<3>(3);
  f[0] = third_ * x[6] * (y0.squaredNorm() + y0.dot(y1) + y1.squaredNorm());
}

void LinearSquareOverTime::jacobian(const nlp::ConstVector& x, nlp::Matrix J) const {
  const auto y0 = x.head<3>(), y1 = x.segment<3>(3);
  J.leftCols<3>() = third_ * x[6] * (2.0 * y0 + y1).transpose();
  J.middleCols<3>(3) = third_ * x[6] * (2.0 * y1 + y0).transpose();
  J(0, 6) = third_ * (y0.squaredNorm() + y0.dot(y1) + y1.squaredNorm());
}

void LinearSquareOverTime::hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const {
  const auto y0 = x.head<3>(), y1 = x.segment<3>(3);
  const double w = weights[0] * third_;
  H.diagonal().head<6>().setConstant(2.0 * w * x[6]);
  H.block<3, 3>(3, 0).diagonal().setConstant(w * x[6]);
  H.block<1, 3>(6, 0) = w * (2.0 * y0 + y1).transpose();
  H.block<1, 3>(6, 3) = w * (2.0 * y1 + y0).transpose();
}

SquaredDistance::SquaredDistance(const std::string& name, int y, const Eigen::VectorXd& target, double weight)
    : Piece(name, gather({{y, static_cast<int>(target.size())}}), 1), target_(target), weight_(weight) {}

void SquaredDistance::values(const nlp::ConstVector& x, nlp::Vector f) const {
  f[0] = weight_ * (x - target_).squaredNorm();
}

void SquaredDistance::jacobian(const nlp::ConstVector& x, nlp::Matrix J) const {
  J.row(0) = 2.0 * weight_ * (x - target_).transpose();
}

void SquaredDistance::hessian(const nlp::ConstVector&, const nlp::ConstVector& weights, nlp::Matrix H) const {
  H.diagonal().setConstant(2.0 * weights[0] * weight_);
}

}  // namespace mcplan::rhp
