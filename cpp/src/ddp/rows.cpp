#include "mcplan/ddp/rows.hpp"

#include <algorithm>

namespace mcplan::ddp {

const char* to_string(Term term) {
  constexpr const char* kNames[kTermCount] = {"task", "duration", "reach",     "bounds", "contact",
                                              "free", "friction", "force_cap", "flight", "contact_change"};
  return kNames[static_cast<int>(term)];
}

void Rows::clear() {
  cost_ = 0.0;
  terms_.fill(0.0);
  precision_.clear();
  value_.clear();
  single_.clear();
}

void Rows::add_value(double weight, double value) {
  const double cost = 0.5 * weight * weight * value * value;
  cost_ += cost;
  terms_[static_cast<int>(term_)] += cost;
}

void Rows::push(double weight, double value, int single) {
  add_value(weight, value);
  const int r = count();
  precision_.push_back(weight * weight);
  value_.push_back(value);
  single_.push_back(single);
  if (r >= gradient_.cols()) gradient_.conservativeResize(nz_, std::max<Eigen::Index>(16, 2 * gradient_.cols()));
  gradient_.col(r).setZero();
}

void Rows::add_single(double weight, double value, int index) {
  if (!with_gradient_) return add_value(weight, value);
  push(weight, value, index);
  gradient_(index, count() - 1) = 1.0;
}

Eigen::Ref<Eigen::VectorXd> Rows::add_dense(double weight, double value) {
  push(weight, value, -1);
  return gradient_.col(count() - 1);
}

void Rows::accumulate(double& c, Eigen::VectorXd& g, Eigen::MatrixXd& h, Eigen::MatrixXd& scratch) const {
  c += cost_;
  int dense = 0;
  for (int r = 0; r < count(); ++r) {
    const double d = precision_[r];
    if (single_[r] >= 0) {
      g[single_[r]] += d * value_[r];
      h(single_[r], single_[r]) += d;
    } else {
      g += d * value_[r] * gradient_.col(r);
      if (scratch.rows() != nz_ || scratch.cols() <= dense) scratch.conservativeResize(nz_, std::max(16, 2 * dense));
      scratch.col(dense++) = std::sqrt(d) * gradient_.col(r);
    }
  }
  if (dense > 0) h.noalias() += scratch.leftCols(dense) * scratch.leftCols(dense).transpose();
}

}  // namespace mcplan::ddp
