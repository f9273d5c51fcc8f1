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
constexpr double kDead_m_s2 = 0.15;    // below which nothing pushes
constexpr double kDeviations = 3.0;    // of the noise, likewise
constexpr double kLargest_m_s2 = 3.0;  // what is more is a blow, or a mistake
constexpr double kFades_s = 0.1;       // while nothing can be said
constexpr double kSettles_s = 0.03;    // after contacts have changed
constexpr double kNoise_s = 1.0;       // over which the noise is averaged
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
  if (!(velocity_W.norm() < kAbsurd)) return push_;  // one bad reading must not stay in it for good
  const double q = std::exp(-kPoles * dt_s);         // both poles, discrete
  const bool promised = promised_W && promised_W->norm() < kAbsurd;
  settled_s_ = promised ? settled_s_ + dt_s : 0.0;
  if (started_ && settled_s_ > kSettles_s) {
    const Eigen::Vector2d expected_W = velocity_W_ + dt_s * (*promised_W + acceleration_W_);
    const Eigen::Vector2d error_W = velocity_W - expected_W;
    velocity_W_ = expected_W + (1.0 - q * q) * error_W;
    acceleration_W_ += (1.0 - q) * (1.0 - q) / dt_s * error_W;
    variance_ += std::min(dt_s / kNoise_s, 1.0) * (0.5 * error_W.squaredNorm() - variance_);
    const double size = acceleration_W_.norm();
    if (size > kLargest_m_s2) acceleration_W_ *= kLargest_m_s2 / size;
  } else {
    velocity_W_ = velocity_W;
    acceleration_W_ *= std::max(1.0 - dt_s / kFades_s, 0.0);
  }
  started_ = true;
  // Of white noise in v the error has (6 + 2 q) / (1 + q)^3 of its variance, a_hat 2 (1 - q)^3 / (1 + q)^3 / dt^2.
  const double noise_m_s2 = (1.0 - q) / dt_s * std::sqrt((1.0 - q) / (3.0 + q) * variance_);
  const double dead_m_s2 = std::max(kDead_m_s2, kDeviations * noise_m_s2);
  const double ratio = dead_m_s2 / std::max(acceleration_W_.norm(), dead_m_s2);
  push_.acceleration_W = (1.0 - ratio * ratio) * acceleration_W_;  // without a jump
  if (ratio >= 1.0 || impulse_W_.dot(push_.acceleration_W) < 0.0) {
    impulse_W_.setZero();
    felt_s_ = push_.lasted_s = 0.0;
  }
  if (ratio >= 1.0) return push_;
  impulse_W_ += dt_s * push_.acceleration_W;
  felt_s_ += dt_s;
  push_.lasted_s = std::min(impulse_W_.dot(push_.acceleration_W) / push_.acceleration_W.squaredNorm(), felt_s_);
  return push_;
}

}  // namespace mcplan::online
