// The line search of the barrier method: Wächter, Biegler 2006, sections 2.3 and 2.4, whose names of constants it
// keeps.

#include <algorithm>
#include <cmath>
#include <limits>

#include "ipm/barrier.hpp"
#include "ipm/chunk.hpp"

namespace mcplan::ipm {
namespace {

using Eigen::VectorXd;

constexpr double kSwitchViolation = 1.1, kSwitchCost = 2.3, kSwitch = 1.0;  // s_theta, s_phi, delta
constexpr double kArmijo = 1e-8;                                            // eta_phi
constexpr double kRounding = 10.0 * 2.2e-16;
constexpr double kLeastProduct = 1e-200;
constexpr int kFactors = 4;  // of a lower and an upper distance each
constexpr int kMaxTrials = 30, kMaxCorrections = 4;
constexpr double kCorrectionProgress = 0.99;  // kappa_soc
constexpr double kDualReset = 1e10;           // kappa_Sigma
constexpr double kLeastTau = 0.99;            // tau_min

}  // namespace

double Barrier::theta(const Point& point) const {
  return point.equalities.cwiseAbs().sum() + point.slack_error().cwiseAbs().sum();
}

double Barrier::barrier_cost(const Point& point, double mu) const {
  // Logarithms of products of a few distances each, as long as these are far from what a number can hold. A bound that
  // is none has a distance of one.
  const int count = static_cast<int>(point.t.size());
  const auto distances = [&](int i, Chunk& lower, Chunk& upper) {
    const ConstChunkAt t(point.t.data() + i);
    lower = ConstChunkAt(has_lower_.data() + i) * t + ConstChunkAt(base_lower_.data() + i);
    upper = ConstChunkAt(base_upper_.data() + i) - ConstChunkAt(has_upper_.data() + i) * t;
  };
  Chunk logs = Chunk::Zero(), least = Chunk::Ones(), lower, upper;
  int i = 0;
  for (; i + kFactors * kChunk <= count; i += kFactors * kChunk) {
    Chunk product = Chunk::Ones();
    for (int k = 0; k < kFactors; ++k) {
      distances(i + k * kChunk, lower, upper);
      least = least.min(lower).min(upper);
      product *= lower * upper;
    }
    if (product.minCoeff() > kLeastProduct && product.maxCoeff() < 1.0 / kLeastProduct) {
      logs += product.log();
      continue;
    }
    for (int k = 0; k < kFactors; ++k) {
      distances(i + k * kChunk, lower, upper);
      logs += lower.log() + upper.log();
    }
  }
  double sum = logs.sum();
  for (; i < count; ++i) {
    const double low = has_lower_[i] * point.t[i] + base_lower_[i], high = base_upper_[i] - has_upper_[i] * point.t[i];
    least[0] = std::min({least[0], low, high});
    sum += std::log(low) + std::log(high);
  }
  return least.minCoeff() > 0.0 ? point.cost - mu * sum : std::numeric_limits<double>::quiet_NaN();
}

bool Barrier::acceptable(double theta_trial, double phi_trial, double alpha, bool& armijo) {
  if (!filter_.accepts(theta_trial, phi_trial)) return false;
  const double noise = kRounding * std::abs(phi_now_);
  const bool switching = theta_now_ <= theta_min_ && slope_ < 0.0 &&
                         alpha * std::pow(-slope_, kSwitchCost) > kSwitch * std::pow(theta_now_, kSwitchViolation);
  armijo = switching && phi_trial <= phi_now_ + kArmijo * alpha * slope_ + noise;
  if (switching) return armijo;
  return theta_trial <= (1.0 - Filter::kMargin) * theta_now_ ||
         phi_trial <= phi_now_ - Filter::kMargin * theta_now_ + noise;
}

/// Steps of half the length until one is acceptable; false where none is.
bool Barrier::search(Point& point, Step& step) {
  const double tau = std::max(kLeastTau, 1.0 - mu_);
  theta_now_ = theta(point);
  phi_now_ = barrier_cost(point, mu_);
  slope_ = gradient_.dot(step.t.head(n())) + mu_ * pull_.dot(step.t);
  const double max_alpha = max_step(step.t, tau);
  alpha_dual_ = max_dual_step(step, tau);
  double alpha = max_alpha;
  for (trials_ = 1; trials_ <= kMaxTrials; ++trials_, alpha *= 0.5) {
    trial_.t = point.t + alpha * step.t;
    functions_.evaluate(trial_);
    bool armijo = false;
    const double theta_trial = theta(trial_);
    if (acceptable(theta_trial, barrier_cost(trial_, mu_), alpha, armijo)) {
      if (!armijo) filter_.add(theta_now_, phi_now_);
      take(point, step, alpha, alpha_dual_);
      return true;
    }
    if (trials_ == 1 && theta_trial >= theta_now_ && correct(point, trial_, alpha, step)) {
      take(point, step, alpha_, alpha_dual_);
      return true;
    }
    if (alpha * step.t.cwiseAbs().maxCoeff() < 1e-14) break;
  }
  alpha_ = alpha;
  return false;
}

/// Second-order corrections: the same matrix, with the violation at the end of the step in the right side.
bool Barrier::correct(const Point& point, const Point& trial, double max_alpha, Step& step) {
  const double tau = std::max(kLeastTau, 1.0 - mu_);
  VectorXd &c = corrected_equalities_, &g = corrected_slacks_;
  c = max_alpha * point.equalities + trial.equalities;
  g = max_alpha * slack_error_ + trial.slack_error();
  double before = theta(trial);
  Step& corrected = corrected_;
  for (int i = 0; i < kMaxCorrections; ++i) {
    direction(mu_, c, g, corrected);
    const double alpha = max_step(corrected.t, tau);
    trial_.t = point.t + alpha * corrected.t;
    functions_.evaluate(trial_);
    const double now = theta(trial_);
    bool armijo = false;
    if (acceptable(now, barrier_cost(trial_, mu_), max_alpha, armijo)) {
      if (!armijo) filter_.add(theta_now_, phi_now_);
      alpha_ = alpha;
      alpha_dual_ = max_dual_step(corrected, tau);
      step = corrected;
      return true;
    }
    if (!(now <= kCorrectionProgress * before)) return false;
    before = now;
    c = alpha * c + trial_.equalities;
    g = alpha * g + trial_.slack_error();
  }
  return false;
}

void Barrier::take(Point& point, const Step& step, double alpha, double alpha_dual) {
  alpha_ = alpha;
  lambda_ += alpha * (step.lambda - lambda_);
  lower_dual_ += alpha_dual * step.lower;
  upper_dual_ += alpha_dual * step.upper;
  std::swap(point, trial_);
  find_gaps(point);
  const auto near = [this](VectorXd& dual, const VectorXd& inverse) {
    dual = dual.cwiseMax(mu_ / kDualReset * inverse).cwiseMin(mu_ * kDualReset * inverse);
  };
  near(lower_dual_, inverse_lower_);
  near(upper_dual_, inverse_upper_);
  functions_.derivatives(point, gradient_, kkt_);
}

}  // namespace mcplan::ipm
