// The line search of the barrier method: Wächter, Biegler 2006, sections 2.3 and 2.4, whose names of constants it
// keeps.

#include <algorithm>
#include <cmath>
#include <limits>

#include "ipm/barrier.hpp"

namespace mcplan::ipm {
namespace {

using Eigen::VectorXd;

constexpr double kSwitchViolation = 1.1, kSwitchCost = 2.3, kSwitch = 1.0;  // s_theta, s_phi, delta
constexpr double kArmijo = 1e-8;                                            // eta_phi
constexpr double kRounding = 10.0 * 2.2e-16;
constexpr double kLeastProduct = 1e-100;
constexpr int kMaxTrials = 30, kMaxCorrections = 4;
constexpr double kCorrectionProgress = 0.99;  // kappa_soc
constexpr double kDualReset = 1e10;           // kappa_Sigma
constexpr double kLeastTau = 0.99;            // tau_min

}  // namespace

double Barrier::theta(const Point& point) const {
  double sum = point.equalities.cwiseAbs().sum();
  for (int i = 0; i < unknowns_.slack_count(); ++i) sum += std::abs(point.slack_error(i));
  return sum;
}

double Barrier::barrier_cost(const Point& point, double mu) const {
  // The logarithm of products, as long as these are far from what a number can hold.
  double logs = 0.0, product = 1.0;
  const auto add = [&](double gap) {
    if (!(gap > 0.0)) product = std::numeric_limits<double>::quiet_NaN();
    product *= gap;
    if (product > kLeastProduct && product < 1.0 / kLeastProduct) return;
    logs += std::log(product);
    product = 1.0;
  };
  for (int i = 0; i < point.t.size(); ++i) {
    if (unknowns_.lower[i] > -nlp::kInfinity) add(point.t[i] - unknowns_.lower[i]);
    if (unknowns_.upper[i] < nlp::kInfinity) add(unknowns_.upper[i] - point.t[i]);
  }
  return point.cost - mu * (logs + std::log(product));
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
  g = max_alpha * slack_error_;
  for (int i = 0; i < g.size(); ++i) g[i] += trial.slack_error(i);
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
    g *= alpha;
    for (int k = 0; k < g.size(); ++k) g[k] += trial_.slack_error(k);
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
  for (int i = 0; i < point.t.size(); ++i) {
    const double low = mu_ * inverse_lower_[i], high = mu_ * inverse_upper_[i];
    lower_dual_[i] = std::clamp(lower_dual_[i], low / kDualReset, low * kDualReset);
    upper_dual_[i] = std::clamp(upper_dual_[i], high / kDualReset, high * kDualReset);
  }
  functions_.derivatives(point, gradient_, kkt_);
}

}  // namespace mcplan::ipm
