#pragma once

namespace mcplan {

/// How high an end-effector is lifted at s = 0..1 of a swing, over the swing's height: with x = s (1 - s), e = 1/20,
///
///     b(s) = 16 (1 + 4 e) x^3 / (x + e)
///
/// It is 1 half way, and its value, rate and second derivative are zero at both ends, so that accelerations go on where
/// contacts are broken and made. 16 x^2, to which it tends for e = 0, starts with 32 heights per swing's time squared;
/// 64 x^3, for large e, is half as high at a tenth of the swing, where soles are still beside edges.
class SwingLift {
 public:
  explicit SwingLift(double s) : slope_(1.0 - 2.0 * s), x_(s * (1.0 - s)) {}

  double value() const { return kScale * x_ * x_ * x_ / (x_ + kEase); }

  /// db/ds.
  double rate() const {
    const double y = x_ / (x_ + kEase);
    return kScale * y * y * (2.0 * x_ + 3.0 * kEase) * slope_;
  }

  static constexpr double kMaxRate = 3.182;  ///< of rate(), rounded up

 private:
  static constexpr double kEase = 0.05, kScale = 16.0 * (1.0 + 4.0 * kEase);
  double slope_, x_;
};

}  // namespace mcplan
