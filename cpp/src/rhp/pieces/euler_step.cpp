#include "rhp/pieces/euler_step.hpp"

#include "rhp/pieces/contact_point.hpp"

namespace mcplan::rhp {
namespace {

constexpr int kY0 = 0, kY1 = 3, kRate = 6, kT = 9;  // places in x

std::vector<int> gather(int y0, int y1, int rate, int duration) {
  std::vector<int> variables;
  append(variables, y0, 3);
  append(variables, y1, 3);
  append(variables, rate, 3);
  append(variables, duration, 1);
  return variables;
}

}  // namespace

EulerStep::EulerStep(const std::string& name, int y0, int y1, int rate, int duration, int intervals)
    : Piece(name, gather(y0, y1, rate, duration), 3), ratio_(1.0 / intervals) {}

void EulerStep::values(const nlp::ConstVector& x, nlp::Vector f) const {
  f = x.segment<3>(kY1) - x.segment<3>(kY0) - ratio_ * x[kT] * x.segment<3>(kRate);
}

void EulerStep::jacobian(const nlp::ConstVector& x, nlp::Matrix J) const {
  J.middleCols<3>(kY0).diagonal().setConstant(-1.0);
  J.middleCols<3>(kY1).diagonal().setConstant(1.0);
  J.middleCols<3>(kRate).diagonal().setConstant(-ratio_ * x[kT]);
  J.col(kT) = -ratio_ * x.segment<3>(kRate);
}

void EulerStep::hessian(const nlp::ConstVector&, const nlp::ConstVector& weights, nlp::Matrix H) const {
  H.block<1, 3>(kT, kRate) = -ratio_ * weights.transpose();
}

}  // namespace mcplan::rhp
