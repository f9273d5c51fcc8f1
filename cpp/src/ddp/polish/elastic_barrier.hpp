#pragma once

#include <Eigen/Core>

namespace mcplan::ddp::polish {

/// Rows r <= 0 with slacks s > 0 and multipliers y > 0, which may be violated at a price: r + s = y / w^2. Where the
/// barrier mu is small a row adds 1/2 w^2 max(r, 0)^2, what the penalty of the cost terms adds.
class ElasticBarrier {
 public:
  using Array = Eigen::ArrayXd;

  /// `precision`: w^2 by row.
  explicit ElasticBarrier(const Array& precision);

  const Array& multipliers() const { return y_; }

  /// Slacks and multipliers that are optimal for these rows and a barrier.
  void start(const Array& r, double mu);

  /// Weights D and multipliers y^ = y + D (r + mu/y - y/w^2) of a Newton step: a row adds y^ a and D a a'.
  void linearise(const Array& r, double mu);
  const Array& weights() const { return weight_; }
  const Array& newton_multipliers() const { return newton_; }

  /// Take the multipliers along the Newton step, dr = a . dz of a full one, as far as they stay positive; the slacks
  /// are those that belong to the rows as they are now.
  void step(const Array& dr, const Array& r);

  /// Sum over the rows of min over s of 1/2 w^2 (r + s)^2 - mu log s: a function of the rows alone.
  double value(const Array& r, double mu) const;

  /// Its slope along dr.
  double slope(const Array& r, const Array& dr, double mu) const;

  /// Sum of 1/2 w^2 max(r, 0)^2.
  double penalty(const Array& r) const;

  /// Mean of s y, and the smallest over the mean.
  double complementarity() const { return y_.size() > 0 ? (s_ * y_).mean() : 0.0; }
  double centrality() const { return y_.size() > 0 ? (s_ * y_).minCoeff() / complementarity() : 1.0; }

 private:
  Array precision_, s_, y_, weight_, newton_, step_;
};

}  // namespace mcplan::ddp::polish
