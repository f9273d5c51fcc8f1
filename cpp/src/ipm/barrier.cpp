#include "ipm/barrier.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mcplan::ipm {
namespace {

using Eigen::VectorXd;

// Names and values of the constants as in Wächter, Biegler 2006, where they have one.
constexpr double kBoundPush = 1e-2;         // kappa_1, kappa_2: of the start, off its bounds
constexpr double kProbingPush = 0.1;        // the same where the barrier is probed from there
constexpr double kMultiplierScale = 100.0;  // s_max
constexpr double kMaxMultipliers = 1e6;     // average beyond which errors are not measured by: they grow without bound
constexpr double kFirstDelta = 1e-4, kMaxDelta = 1e20, kGrowDelta = 8.0, kFirstGrowDelta = 100.0, kShrinkDelta = 3.0;
constexpr double kMinDelta = 1e-20, kDualDelta = 1e-8;
constexpr double kNearViolation = 1e-2;                 // up to which multipliers say something
constexpr double kLeastPart = 0.0625, kGrowPart = 4.0;  // of the blend of Hessians
constexpr double kFirstDamping = 1e-2;
constexpr int kManyTrials = 6;
constexpr double kShortStep = 0.01;  // of the way that is looked for, where nothing but a feasible point is
constexpr int kManyShortSteps = 15;
constexpr double kNoBound = 1e300;                   // a distance whose product with a multiplier of zero is zero
constexpr double kLongStep = 0.5, kSmallGap = 10.0;  // of a step and of a duality gap after which a cost has settled

}  // namespace

double Barrier::Errors::largest() const { return std::max({dual, primal, complementarity}); }

Barrier::Barrier(const Unknowns& unknowns, const nlp::SolverOptions& options, Oracle& functions, LinearSystem& kkt)
    : unknowns_(unknowns),
      options_(options),
      functions_(functions),
      kkt_(kkt),
      probing_(options.adaptive_barrier && !options.kernel.distant_start) {
  const int free = unknowns.free_count(), all = static_cast<int>(unknowns.lower.size());
  gradient_ = dual_ = right_a_ = dx_ = VectorXd::Zero(free);
  lambda_ = right_b_ = corrected_equalities_ = VectorXd::Zero(unknowns.equality_count());
  lower_dual_ = upper_dual_ = gap_lower_ = gap_upper_ = weights_ = VectorXd::Zero(all);
  inverse_lower_ = inverse_upper_ = pull_ = base_lower_ = base_upper_ = VectorXd::Zero(all);
  const auto finite = [](const VectorXd& bounds) { return bounds.array().isFinite().cast<double>().matrix(); };
  has_lower_ = finite(unknowns.lower);
  has_upper_ = finite(unknowns.upper);
  for (int i = 0; i < all; ++i) {
    bound_count_ += static_cast<int>(has_lower_[i] + has_upper_[i]);
    base_lower_[i] = has_lower_[i] > 0.0 ? -unknowns.lower[i] : 1.0;
    base_upper_[i] = has_upper_[i] > 0.0 ? unknowns.upper[i] : 1.0;
  }
  slack_error_ = slack_work_ = slack_multipliers_ = corrected_slacks_ = VectorXd::Zero(unknowns.slack_count());
  for (Step* step : {&step_, &affine_, &corrected_}) {
    step->t = step->lower = step->upper = VectorXd::Zero(all);
    step->lambda = VectorXd::Zero(lambda_.size());
  }
  for (LinearSystem::Solution* solution : {&rights_[0], &rights_[1], &at_zero_, &per_mu_}) {
    solution->dx = VectorXd::Zero(free);
    solution->lambda = VectorXd::Zero(lambda_.size());
  }
  history_.reserve(kHistory + 1);
  mu_ = options.initial_barrier;
}

const VectorXd& Barrier::multipliers_of_slacks() {
  slack_multipliers_ = upper_dual_.tail(unknowns_.slack_count()) - lower_dual_.tail(unknowns_.slack_count());
  return slack_multipliers_;
}

void Barrier::start(Point& point, const Duals* duals) {
  mu_ = options_.initial_barrier;
  const double push = probing_ ? kProbingPush : kBoundPush;
  const auto inside = [&](int i, double value) {
    const double low = unknowns_.lower[i], high = unknowns_.upper[i];
    const auto distance = [&](double bound, double dual) {
      const double usual = std::min(push * std::max(1.0, std::abs(bound)), push * (high - low));
      return dual > 0.0 ? std::min(usual, mu_ / dual) : usual;
    };
    if (low > -nlp::kInfinity) value = std::max(value, low + distance(low, duals ? duals->lower[i] : 0.0));
    if (high < nlp::kInfinity) value = std::min(value, high - distance(high, duals ? duals->upper[i] : 0.0));
    return value;
  };
  for (int i = 0; i < n(); ++i) point.t[i] = inside(i, point.t[i]);
  functions_.evaluate(point);
  for (int i = 0; i < unknowns_.slack_count(); ++i) point.t[n() + i] = inside(n() + i, point.inequalities[i]);
  functions_.derivatives(point, gradient_, kkt_);
  find_gaps(point);
  lower_dual_ = mu_ * inverse_lower_;
  upper_dual_ = mu_ * inverse_upper_;
  // Not those that make the gradient of the Lagrangian smallest, as is common: on walks they cost a quarter more
  // iterations, with Hessians that are less often positive.
  lambda_.setZero();
  if (duals) {
    lambda_ = duals->equalities;
    lower_dual_ = lower_dual_.cwiseMax(duals->lower);
    upper_dual_ = upper_dual_.cwiseMax(duals->upper);
  }
  fixed_mu_ = !options_.adaptive_barrier;
  history_.clear();
  filter_ = Filter(1e4 * std::max(1.0, theta(point)));
  theta_min_ = 1e-4 * std::max(1.0, theta(point));
  last_delta_ = 0.0;
  part_ = 1.0 / kGrowPart;
  damping_ = 0.0;
  trials_ = 0;
  short_steps_ = cut_steps_ = 0;
}

void Barrier::find_gaps(const Point& point) {
  gap_lower_ = point.t - unknowns_.lower;
  gap_upper_ = unknowns_.upper - point.t;
  inverse_lower_ = gap_lower_.cwiseInverse();
  inverse_upper_ = gap_upper_.cwiseInverse();
  gap_lower_ = gap_lower_.cwiseMin(kNoBound);
  gap_upper_ = gap_upper_.cwiseMin(kNoBound);
  pull_ = inverse_upper_ - inverse_lower_;
}

Barrier::Errors Barrier::errors(const Point& point, double mu) {
  dual_ = gradient_ - lower_dual_.head(n()) + upper_dual_.head(n());
  kkt_.add_equalities_transposed(lambda_, dual_);
  kkt_.add_inequalities_transposed(multipliers_of_slacks(), dual_);
  // Those of two bounds that lie close together are large and cancel each other.
  const double bounds = (upper_dual_ - lower_dual_).cwiseAbs().sum();
  const double count = static_cast<double>(lower_dual_.size() * 2);
  const auto scale = [](double average) {
    return std::clamp(average, kMultiplierScale, kMaxMultipliers) / kMultiplierScale;
  };
  const double dual_scale = scale((lambda_.cwiseAbs().sum() + bounds) / std::max(1.0, count + lambda_.size()));
  const double bound_scale = scale(bounds / std::max(1.0, count));
  const auto largest = [](const auto& values) { return values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0.0; };
  Errors out;
  out.dual = largest(dual_) / dual_scale;
  out.primal = std::max(largest(point.equalities), largest(point.slack_error()));
  out.complementarity = std::max(largest(gap_lower_.cwiseProduct(lower_dual_) - mu * has_lower_),
                                 largest(gap_upper_.cwiseProduct(upper_dual_) - mu * has_upper_)) /
                        bound_scale;
  return out;
}

bool Barrier::factor(const Point& point) {
  if (options_.kernel.blend_hessians) return factor_blend(point);
  kkt_.set_hessian(functions_.hessian(point, 1.0, lambda_, multipliers_of_slacks()));
  return factor_ladder();
}

void Barrier::set_weights() {
  weights_ = lower_dual_.array() * inverse_lower_.array() + upper_dual_.array() * inverse_upper_.array();
  kkt_.set_weights(weights_.tail(unknowns_.slack_count()), weights_.head(n()));
}

/// With the smallest of a ladder of multiples of the identity that leaves as many negative pivots as equalities.
bool Barrier::factor_ladder() {
  set_weights();
  const double start_s = functions_.deadline().now_s();
  delta_ = 0.0;
  double dual_delta = 0.0;
  bool good = false;
  for (;;) {
    const LinearSystem::Factor result = kkt_.factor(delta_, dual_delta);
    if (result == LinearSystem::Factor::good) {
      good = true;
      break;
    }
    if (result == LinearSystem::Factor::singular && dual_delta == 0.0 && lambda_.size() > 0) {
      dual_delta = kDualDelta;
      continue;
    }
    if (delta_ == 0.0)
      delta_ = last_delta_ == 0.0 ? kFirstDelta : std::max(kMinDelta, last_delta_ / kShrinkDelta);
    else
      delta_ *= last_delta_ == 0.0 ? kFirstGrowDelta : kGrowDelta;
    if (delta_ > kMaxDelta) break;
  }
  if (good && delta_ > 0.0) last_delta_ = delta_;
  linear_solver_s_ += functions_.deadline().now_s() - start_s;
  return good;
}

/// The largest of a few parts of the way from the Gauss-Newton Hessian, which is positive semidefinite, to the exact
/// one with which the inertia is right; the Gauss-Newton Hessian alone while rows are violated, where multipliers say
/// little.
bool Barrier::factor_blend(const Point& point) {
  functions_.gauss_newton_hessian(point, gauss_newton_);
  // A line search that ends with a tiny step says that the quadratic model holds nowhere near its minimum.
  if (trials_ > kManyTrials)
    damping_ = std::max(kFirstDamping, 10.0 * damping_);
  else
    damping_ = damping_ > kFirstDamping ? damping_ / 3.0 : 0.0;
  const bool near = functions_.violation(point) <= kNearViolation;
  part_ = near ? std::min(1.0, part_ == 0.0 ? kLeastPart : kGrowPart * part_) : 0.0;
  if (near) exact_ = functions_.hessian(point, 1.0, lambda_, multipliers_of_slacks());
  for (; part_ >= kLeastPart; part_ *= 0.5) {
    blend_ = gauss_newton_ + part_ * (exact_ - gauss_newton_);
    kkt_.set_hessian(blend_);
    set_weights();
    const double start_s = functions_.deadline().now_s();
    const LinearSystem::Factor result = kkt_.factor(damping_, 0.0);
    linear_solver_s_ += functions_.deadline().now_s() - start_s;
    delta_ = damping_;
    if (result == LinearSystem::Factor::good) return true;
  }
  part_ = 0.0;
  kkt_.set_hessian(gauss_newton_);
  return factor_ladder();
}

void Barrier::direction(double mu, const VectorXd& c, const VectorXd& slack_error, Step& step, bool given) {
  const double start_s = functions_.deadline().now_s();
  const int slacks = unknowns_.slack_count();
  if (given) {
    right_a_ = rights_[0].dx + mu * rights_[1].dx;
  } else {
    slack_work_ = weights_.tail(slacks).array() * slack_error.array() + mu * pull_.tail(slacks).array();
    right_a_ = gradient_ + mu * pull_.head(n());
    kkt_.add_inequalities_transposed(slack_work_, right_a_);
    right_a_ = -right_a_;
  }
  right_b_ = -c - kkt_.delta_c() * lambda_;  // the regularisation acts on what multipliers change by
  if (given)
    kkt_.refine(right_a_, right_b_, dx_, step.lambda);
  else
    kkt_.solve(right_a_, right_b_, dx_, step.lambda);
  follow(mu, slack_error, step);
  linear_solver_s_ += functions_.deadline().now_s() - start_s;
}

/// What slacks and multipliers of bounds do along a step of the variables, dx_.
void Barrier::follow(double mu, const VectorXd& slack_error, Step& step) {
  step.t.head(n()) = dx_;
  kkt_.multiply_inequalities(dx_, slack_work_);
  step.t.tail(unknowns_.slack_count()) = slack_work_ + slack_error;
  step.lower = (mu - lower_dual_.array() * step.t.array()) * inverse_lower_.array() - lower_dual_.array();
  step.upper = (mu + upper_dual_.array() * step.t.array()) * inverse_upper_.array() - upper_dual_.array();
}

/// The right side is linear in mu, and so is the step: affine_ is the one for mu = 0, and per_mu_ what each unit of mu
/// adds to the variables and to the multipliers of equalities. Not refined.
void Barrier::probe(const Point& point) {
  const double start_s = functions_.deadline().now_s();
  const int slacks = unknowns_.slack_count();
  slack_work_ = weights_.tail(slacks).array() * slack_error_.array();
  rights_[0].dx = gradient_;
  kkt_.add_inequalities_transposed(slack_work_, rights_[0].dx);
  rights_[0].dx = -rights_[0].dx;
  rights_[0].lambda = -point.equalities - kkt_.delta_c() * lambda_;
  slack_work_ = pull_.tail(slacks);
  rights_[1].dx = pull_.head(n());
  kkt_.add_inequalities_transposed(slack_work_, rights_[1].dx);
  rights_[1].dx = -rights_[1].dx;
  rights_[1].lambda.setZero();
  kkt_.solve_roughly(rights_[0], rights_[1], at_zero_, per_mu_);
  dx_ = at_zero_.dx;
  follow(0.0, slack_error_, affine_);
  probed_ = true;
  linear_solver_s_ += functions_.deadline().now_s() - start_s;
}

/// Longest step that leaves 1 - tau of every distance to a bound.
double Barrier::max_step(const VectorXd& d, double tau) const {
  if (d.size() == 0) return 1.0;
  const double fastest = (inverse_upper_.array() * d.array()).max(-inverse_lower_.array() * d.array()).maxCoeff();
  return fastest > tau ? tau / fastest : 1.0;
}

double Barrier::max_dual_step(const Step& step, double tau) const {
  if (step.lower.size() == 0) return 1.0;
  constexpr double kZero = 1e-300;  // for multipliers of bounds that are none
  const double fastest = (-step.lower.array() / lower_dual_.array().max(kZero))
                             .max(-step.upper.array() / upper_dual_.array().max(kZero))
                             .maxCoeff();
  return fastest > tau ? tau / fastest : 1.0;
}

/// Within all constraints, the cost as it was before a long step, and as the barrier leaves it: what it may still fall
/// by is the sum of all products of distances and multipliers.
bool Barrier::cost_settled(const Point& point, const Errors& now) {
  const double change = std::abs(point.cost - last_cost_),
               enough = options_.kernel.cost_tolerance * std::abs(point.cost);
  last_cost_ = point.cost;
  if (functions_.iterations() == 0 || alpha_ < kLongStep || now.primal > options_.constraint_tolerance) return false;
  const double gap = gap_lower_.dot(lower_dual_) + gap_upper_.dot(upper_dual_);
  return change <= enough && gap <= kSmallGap * enough && functions_.violation(point) <= options_.constraint_tolerance;
}

Barrier::Ending Barrier::run(Point& point, int max_iterations, const Duals* duals) {
  trial_ = point;
  header_written_ = false;
  start(point, duals);
  Step& step = step_;
  for (;;) {
    slack_error_ = point.slack_error();
    const Errors now = errors(point, 0.0);
    log(point, now, step);
    if (now.largest() <= options_.tolerance && functions_.violation(point) <= options_.constraint_tolerance)
      return {nlp::Outcome::converged, "converged"};
    if (options_.kernel.cost_tolerance > 0.0 && cost_settled(point, now))
      return {nlp::Outcome::converged, "the cost has settled at a point within all constraints"};
    if (options_.kernel.feasible_is_enough && functions_.violation(point) <= options_.constraint_tolerance)
      return {nlp::Outcome::converged, "a point within all constraints"};
    if (functions_.iterations() >= max_iterations) return {nlp::Outcome::iteration_limit, "reached max_iterations"};
    functions_.begin_iteration();
    if (!factor(point)) return {nlp::Outcome::numerical_failure, "the linear system of a step could not be solved"};
    probed_ = false;
    choose_mu(point, now);
    if (probed_) {
      dx_ = at_zero_.dx + mu_ * per_mu_.dx;
      step.lambda = at_zero_.lambda + mu_ * per_mu_.lambda;
    }
    direction(mu_, point.equalities, slack_error_, step, probed_);
    if (!step.t.allFinite())
      return {nlp::Outcome::numerical_failure, "the linear system of a step could not be solved"};
    if (!search(point, step)) {
      if (now.largest() <= 100.0 * options_.tolerance && functions_.violation(point) <= options_.constraint_tolerance)
        return {nlp::Outcome::nearly_converged,
                "no further progress; the optimality error is within 100 times the tolerance"};
      return {nlp::Outcome::numerical_failure, "the steps became too small"};
    }
    raise_mu();
    // Stuck between bounds: where such runs came to an end, it was more than a hundred steps later, and not solved.
    short_steps_ = alpha_ < kShortStep ? short_steps_ + 1 : 0;
    if (options_.kernel.feasible_is_enough && short_steps_ >= kManyShortSteps)
      return {nlp::Outcome::numerical_failure, "the steps became too small"};
  }
}

void Barrier::log(const Point& point, const Errors& now, const Step& step) {
  if (!options_.logger) return;
  if (!header_written_)
    options_.logger(LogLevel::info,
                    "iter      cost      inf_pr   inf_du   compl lg(mu)  ||d||  lg(rg) alpha_du alpha_pr  ls");
  char line[160], regularization[8] = "    -";
  if (delta_ > 0.0) std::snprintf(regularization, sizeof regularization, "%5.1f", std::log10(delta_));
  std::snprintf(line, sizeof line, "%4d%c %12.6e %8.2e %8.2e %8.2e %5.1f %8.2e %s %8.2e %8.2e %3d",
                functions_.iterations(), fixed_mu_ ? ' ' : 'a', point.cost, now.primal, now.dual, now.complementarity,
                std::log10(mu_), step.t.size() > 0 ? step.t.cwiseAbs().maxCoeff() : 0.0, regularization, alpha_dual_,
                alpha_, trials_);
  header_written_ = true;
  options_.logger(LogLevel::info, line);
}

}  // namespace mcplan::ipm
