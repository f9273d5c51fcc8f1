// How the barrier parameter falls, and when it rises: Wächter, Biegler 2006, section 2.1, whose names of constants it
// keeps, and Mehrotra's probing.

#include <algorithm>
#include <cmath>

#include "ipm/barrier.hpp"

namespace mcplan::ipm {
namespace {

constexpr double kBarrierTolerance = 10.0;                           // kappa_epsilon
constexpr double kLinearDecrease = 0.2, kSuperlinearDecrease = 1.5;  // kappa_mu, theta_mu
constexpr double kProgress = 0.9999;                                 // of the optimality error over the last iterations
constexpr double kLeastRatio = 0.1;  // of a probed barrier parameter, over the average complementarity
// The same where the Hessian was damped in the iteration's step: what is probed holds for the damped model alone.
constexpr double kDampedLeastRatio = 0.5;
// Three steps in a row cut to less than a tenth by the bounds, while mu waits for its problem's solution, say that it
// has fallen too far ahead: iterates follow a curved valley next to their bounds. It then rises again.
constexpr double kCutStep = 0.1, kRaise = 10.0, kMostRaised = 0.01;
constexpr int kManyCutSteps = 3;

}  // namespace

double Barrier::average_complementarity() const {
  return bound_count_ > 0 ? (gap_lower_.dot(lower_dual_) + gap_upper_.dot(upper_dual_)) / bound_count_ : 0.0;
}

/// Mehrotra's: how far complementarity falls along the step to mu = 0 says how far it should be asked to fall.
double Barrier::probed_mu(const Point& point, double average) {
  probe(point);
  const double primal = max_step(affine_.t, 1.0), dual = max_dual_step(affine_, 1.0);
  if (bound_count_ == 0 || average <= 0.0) return 0.0;
  const double sum = (gap_lower_ + primal * affine_.t).dot(lower_dual_ + dual * affine_.lower) +
                     (gap_upper_ - primal * affine_.t).dot(upper_dual_ + dual * affine_.upper);
  const double ratio = std::max(0.0, sum / bound_count_) / average;
  const double least = !probing_ ? 0.0 : delta_ > 0.0 ? kDampedLeastRatio : kLeastRatio;
  return std::clamp(ratio * ratio * ratio, least, 1.0) * average;
}

void Barrier::choose_mu(const Point& point, const Errors& now) {
  const double least = options_.tolerance / 10.0;
  const auto set = [&](double mu) {
    if (mu == mu_) return;
    mu_ = mu;
    filter_.clear();
  };
  if (options_.adaptive_barrier) {
    const double error = now.largest();
    const double bar = history_.empty() ? nlp::kInfinity : *std::max_element(history_.begin(), history_.end());
    const bool progress = static_cast<int>(history_.size()) < kHistory || error <= kProgress * bar;
    if (progress) {
      history_.push_back(error);
      if (static_cast<int>(history_.size()) > kHistory) history_.erase(history_.begin());
      fixed_mu_ = false;
      set(std::max(probed_mu(point, average_complementarity()), least));
      return;
    }
    if (!fixed_mu_) {
      fixed_mu_ = true;
      set(std::max(0.8 * average_complementarity(), least));
    }
  }
  while (mu_ > least && errors(point, mu_).largest() <= kBarrierTolerance * mu_)
    set(std::max(least, std::min(kLinearDecrease * mu_, std::pow(mu_, kSuperlinearDecrease))));
}

/// After steps that the bounds cut short; see kCutStep.
void Barrier::raise_mu() {
  cut_steps_ = fixed_mu_ && options_.adaptive_barrier && alpha_ < kCutStep ? cut_steps_ + 1 : 0;
  if (cut_steps_ < kManyCutSteps || mu_ >= kMostRaised) return;
  mu_ = std::min(kMostRaised, kRaise * mu_);
  filter_.clear();
  cut_steps_ = 0;
}

}  // namespace mcplan::ipm
