#include "ddp/rows.hpp"

#include <algorithm>
#include <array>

namespace mcplan::ddp {

namespace {

/// Where a gradient is not zero, and how many there are (or one more than `at` holds).
template <std::size_t N>
int nonzeros(const Eigen::Ref<const Eigen::VectorXd>& gradient, std::array<int, N>& at) {
  std::size_t count = 0;
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    if (gradient[i] == 0.0) continue;
    if (count == N) return static_cast<int>(N) + 1;
    at[count++] = static_cast<int>(i);
  }
  return static_cast<int>(count);
}

}  // namespace

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
  terms_[term_] += cost;
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

void Rows::accumulate(double& c, Eigen::VectorXd& g, Eigen::MatrixXd& h) const {
  c += cost_;
  // Most rows touch a point and what shifts it, a few of z's numbers: a full update would be wasted on them.
  constexpr int kFew = 10;
  std::array<int, kFew> at;
  for (int r = 0; r < count(); ++r) {
    const double d = precision_[r];
    if (single_[r] >= 0) {
      g[single_[r]] += d * value_[r];
      h(single_[r], single_[r]) += d;
    } else if (const int few = nonzeros(gradient_.col(r), at); few <= kFew) {
      for (int i = 0; i < few; ++i) {
        const double di = d * gradient_(at[i], r);
        g[at[i]] += di * value_[r];
        for (int j = 0; j <= i; ++j) h(at[j], at[i]) += di * gradient_(at[j], r);
      }
    } else {
      g += d * value_[r] * gradient_.col(r);
      for (int j = 0; j < nz_; ++j)
        if (const double dj = d * gradient_(j, r); dj != 0.0) h.col(j).head(j + 1) += dj * gradient_.col(r).head(j + 1);
    }
  }
}

}  // namespace mcplan::ddp
