#include "ddp/polish/elastic_barrier.hpp"

#include <algorithm>
#include <cmath>

namespace mcplan::ddp::polish {
namespace {

/// Ratio of the way to zero that slacks and multipliers may go in one step.
constexpr double kToBoundary = 0.99;

/// The slack s that minimises 1/2 w^2 (r + s)^2 - mu log s, and the multiplier y = mu / s = w^2 (r + s).
struct Optimal {
  double s, y;
};
Optimal optimal(double r, double precision, double mu) {
  const double half = 0.5 * (std::abs(r) + std::sqrt(r * r + 4.0 * mu / precision));
  if (r <= 0.0) return {half, mu / half};
  const double y = precision * half;
  return {mu / y, y};
}

/// The same of all rows, slacks alone: y = mu / s.
Eigen::ArrayXd optimal_slacks(const Eigen::ArrayXd& r, const Eigen::ArrayXd& precision, double mu) {
  const Eigen::ArrayXd half = 0.5 * (r.abs() + (r.square() + 4.0 * mu / precision).sqrt());
  return (r <= 0.0).select(half, mu / (precision * half));
}

}  // namespace

ElasticBarrier::ElasticBarrier(const Array& precision)
    : precision_(precision),
      s_(precision.size()),
      y_(precision.size()),
      weight_(precision.size()),
      newton_(precision.size()),
      step_(precision.size()) {}

void ElasticBarrier::start(const Array& r, double mu) {
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const Optimal at = optimal(r[i], precision_[i], mu);
    s_[i] = at.s;
    y_[i] = at.y;
  }
}

void ElasticBarrier::linearise(const Array& r, double mu) {
  weight_ = y_ / (s_ + y_ / precision_);
  newton_ = y_ + weight_ * (r + mu / y_ - y_ / precision_);
}

void ElasticBarrier::step(const Array& dr, const Array& r) {
  step_ = newton_ - y_ + weight_ * dr;
  double length = 1.0;
  for (Eigen::Index i = 0; i < step_.size(); ++i)
    if (length * step_[i] < -kToBoundary * y_[i]) length = -kToBoundary * y_[i] / step_[i];
  y_ += length * step_;
  s_ = (y_ / precision_ - r).max((1.0 - kToBoundary) * s_);
}

double ElasticBarrier::value(const Array& r, double mu) const {
  const Array s = optimal_slacks(r, precision_, mu);
  // A logarithm of products is a sum of logarithms; eight slacks at a time stay far from under- and overflow.
  const Eigen::Index whole = s.size() / 8 * 8;
  double logarithms = 0.0;
  for (Eigen::Index i = 0; i < whole; i += 8) logarithms += std::log(s.segment<8>(i).prod());
  logarithms += std::log(s.tail(s.size() - whole).prod());
  return 0.5 * mu * mu * (precision_ * s.square()).inverse().sum() - mu * logarithms;
}

double ElasticBarrier::slope(const Array& r, const Array& dr, double mu) const {
  return mu * (dr / optimal_slacks(r, precision_, mu)).sum();
}

double ElasticBarrier::penalty(const Array& r) const { return 0.5 * (precision_ * r.max(0.0).square()).sum(); }

}  // namespace mcplan::ddp::polish
