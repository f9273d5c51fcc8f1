#include "mcplan/online/felt_push.hpp"

#include <algorithm>
#include <cmath>

#include "mcplan/base/error.hpp"
#include "model/read.hpp"
#include "model/text.hpp"
#include "online/felt_push_fields.hpp"

namespace mcplan::online {
namespace {

constexpr double kPoles = 150.0;       // [1/s]: a push is felt after some 14 ms
constexpr double kPolesMin = 20.0;     // likewise where velocities are noisy: after some 100 ms
constexpr double kDead_m_s2 = 0.15;    // below which nothing pushes
constexpr double kDeviations = 3.0;    // of the noise, likewise; what is further out is no noise
constexpr double kLargest_m_s2 = 3.0;  // what is more is a blow, or a mistake
constexpr double kSettles_s = 0.03;    // after contacts have changed
constexpr double kHolds = 0.2;         // while nothing can be said, of the time for which it was felt, ...
constexpr double kHoldsMax_s = 0.3;    // ... at most, ...
constexpr double kFades_s = 0.1;       // ... and over which it fades then
constexpr double kPause_s = 0.1;       // in a push, of which it does not begin anew
constexpr double kNoise_s = 1.0;       // over which the noise is averaged
constexpr double kQuiet_m_s = 1e-3;    // noise that asks for no slower poles
constexpr double kAbsurd = 1e6;        // [m/s, m/s^2] what no robot does, nor what is not finite

void require_positive(const char* name, double value) {
  if (!(value > 0.0 && std::isfinite(value)))
    throw InvalidInput(name, "must be positive and finite", model::number_text(value));
}

}  // namespace

void FeltPush::validate() const {
  model::Findings found;
  model::check_struct(*this, model::Place(model::Place(), "push"), found);
  found.raise<InvalidInput>();
}

Eigen::Vector3d com_shift_W(const FeltPush& push, double com_height, double gravity) {
  push.validate();
  require_positive("com_height", com_height);
  require_positive("gravity", gravity);
  const double omega = std::sqrt(gravity / com_height);
  const double share = -std::expm1(-omega * kLastsRatio * push.lasted_s);
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  out.head<2>() = share / (omega * omega) * push.acceleration_W;
  return out;
}

const FeltPush& PushObserver::update(const Eigen::Vector2d& velocity_W,
                                     const std::optional<Eigen::Vector2d>& promised_W, double dt_s) {
  require_positive("dt_s", dt_s);
  const bool measured = velocity_W.norm() < kAbsurd;
  const bool known = measured && promised_W && promised_W->norm() < kAbsurd;
  settled_s_ = known ? settled_s_ + dt_s : 0.0;
  const double deviation_m_s2 = set_poles(dt_s);
  if (settled_s_ > std::max(kSettles_s, 1.5 * dt_s)) {
    observe(velocity_W, *promised_W, dt_s);
    unsure_s_ = 0.0;
  } else {
    // How noisy velocities are is known before anything is felt: two of them differ by twice their variance.
    if (!observed_ && settled_s_ > 1.5 * dt_s)
      learn(std::sqrt(0.5) * (velocity_W - velocity_W_ - dt_s * *promised_W), dt_s);
    if (measured) velocity_W_ = velocity_W;
    unsure_s_ += dt_s;
    if (unsure_s_ > std::min(kHolds * (felt_s_ - unsure_s_), kHoldsMax_s))
      acceleration_W_ *= std::max(1.0 - dt_s / kFades_s, 0.0);
  }
  tell(std::max(kDead_m_s2, kDeviations * deviation_m_s2), dt_s);
  return push_;
}

/// As fast as noise allows whose standard deviations in a_hat, which are returned [m/s^2], are within the dead zone: of
/// white noise of variance s^2 in v, a_hat has 2 t^3 s^2 / dt^2 with t = (1 - q) / (1 + q), and poles at q = exp(-w
/// dt).
double PushObserver::set_poles(double dt_s) {
  const double noise_m_s = std::sqrt(variance_);
  const auto half = [dt_s](double poles) { return std::tanh(0.5 * poles * dt_s); };
  const double allowed = kDead_m_s2 / kDeviations * dt_s / std::max(noise_m_s, 1e-12);
  const double t = std::clamp(std::cbrt(0.5 * allowed * allowed), half(kPolesMin), half(kPoles));
  q_ = (1.0 - t) / (1.0 + t);
  return std::sqrt(2.0 * t * t * t) / dt_s * noise_m_s;
}

void PushObserver::observe(const Eigen::Vector2d& velocity_W, const Eigen::Vector2d& promised_W, double dt_s) {
  const Eigen::Vector2d expected_W = velocity_W_ + dt_s * (promised_W + acceleration_W_);
  const Eigen::Vector2d error_W = velocity_W - expected_W;
  velocity_W_ = expected_W + (1.0 - q_ * q_) * error_W;
  acceleration_W_ += (1.0 - q_) * (1.0 - q_) / dt_s * error_W;
  const double size = acceleration_W_.norm();
  if (size > kLargest_m_s2) acceleration_W_ *= kLargest_m_s2 / size;

  // Of white noise v - v_hat has (6 + 2 q) / (1 + q)^3 of its variance.
  Eigen::Vector2d noise_W = std::sqrt((1.0 + q_) * (1.0 + q_) * (1.0 + q_) / (6.0 + 2.0 * q_)) * error_W;
  const double usual = kDeviations * std::sqrt(2.0) * std::max(std::sqrt(variance_), kQuiet_m_s);
  if (noise_W.norm() > usual) noise_W *= usual / noise_W.norm();
  learn(noise_W, dt_s);
  observed_ = true;
}

void PushObserver::learn(const Eigen::Vector2d& noise_W, double dt_s) {
  learnt_s_ = std::min(learnt_s_ + dt_s, kNoise_s);
  variance_ += dt_s / learnt_s_ * (0.5 * noise_W.squaredNorm() - variance_);
}

/// Say what is felt and for how long: beyond the dead zone without a jump, and through short pauses.
void PushObserver::tell(double dead_m_s2, double dt_s) {
  const double ratio = dead_m_s2 / std::max(acceleration_W_.norm(), dead_m_s2);
  push_ = {(1.0 - ratio * ratio) * acceleration_W_, 0.0};
  quiet_s_ = ratio < 1.0 ? 0.0 : quiet_s_ + dt_s;
  if (quiet_s_ > kPause_s || impulse_W_.dot(push_.acceleration_W) < 0.0) {
    impulse_W_.setZero();
    felt_s_ = 0.0;
  }
  if (ratio >= 1.0) return;
  impulse_W_ += dt_s * push_.acceleration_W;
  felt_s_ += dt_s;
  push_.lasted_s = std::min(impulse_W_.dot(push_.acceleration_W) / push_.acceleration_W.squaredNorm(), felt_s_);
}

}  // namespace mcplan::online
