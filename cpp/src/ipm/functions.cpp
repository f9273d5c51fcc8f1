#include "ipm/functions.hpp"

#include <algorithm>
#include <cmath>

#include "ipm/all_finite.hpp"

namespace mcplan::ipm {
namespace {

using Eigen::VectorXd;

constexpr double kDiverged = 1e20;  // as Ipopt's diverging_iterates_tol

/// Of the Jacobian's entries, as their rows are scaled.
VectorXd entry_scales(const nlp::Problem& problem, const Unknowns& unknowns) {
  const std::vector<nlp::Entry>& entries = problem.jacobian_structure();
  VectorXd out = VectorXd::Ones(static_cast<int>(entries.size()));
  for (int i = 0; i < out.size(); ++i)
    if (const int slack = unknowns.slack_of[entries[i].row]; slack >= 0) out[i] = unknowns.scale[slack];
  return out;
}

}  // namespace

Functions::Functions(const nlp::Problem& problem, const Unknowns& unknowns, const nlp::SolverOptions& options,
                     const Deadline& deadline)
    : problem_(problem),
      unknowns_(unknowns),
      options_(options),
      deadline_(deadline),
      jacobian_(problem, options.kernel.distant_start ? entry_scales(problem, unknowns) : VectorXd()) {
  rows_.resize(problem.row_count());
  gradient_.resize(problem.variable_count());
  hessian_.resize(static_cast<int>(problem.hessian_structure().size()));
  multipliers_ = VectorXd::Zero(problem.row_count());
  left_s_ = deadline.remaining_s();
}

void Functions::begin_iteration() {
  if (options_.stop && options_.stop()) throw Halt{nlp::Outcome::interrupted, "stopped by the caller"};
  if (deadline_.limited()) look_at_clock();
  ++iterations_;
}

void Functions::look_at_clock() {
  if (options_.finishing_s && best_x_.size() > 0)
    reserved_s_ = std::min(options_.finishing_s(best_x_), 0.5 * options_.time_limit_s);
  const double left_s = deadline_.remaining_s();
  const double took_s = left_s_ - left_s;
  longest_s_ = std::max(took_s, 0.5 * longest_s_);
  left_s_ = left_s;
  if (left_s <= reserved_s_ + longest_s_) throw Halt{nlp::Outcome::time_limit, "reached time_limit_s"};
}

template <class Function>
void Functions::clocked(const VectorXd& x, const Function& function) {
  if (deadline_.limited() && deadline_.remaining_s() <= reserved_s_)
    throw Halt{nlp::Outcome::time_limit, "reached time_limit_s"};
  const double start_s = deadline_.now_s();
  const bool finite = function();
  evaluation_s_ += deadline_.now_s() - start_s;
  if (finite) return;
  if (options_.stop && options_.stop()) throw Halt{nlp::Outcome::interrupted, "stopped by the caller"};
  const std::string name = problem_.first_not_finite(x);
  throw Halt{nlp::Outcome::numerical_failure, "not finite: " + (name.empty() ? "a sum of pieces" : name)};
}

void Functions::evaluate(Point& point) {
  const int n = unknowns_.free_count();
  for (int i = 0; i < n; ++i) point.x[unknowns_.free[i]] = point.t[i];
  clocked(point.x, [&] {
    point.cost = problem_.cost(point.x);
    problem_.rows(point.x, rows_);
    return std::isfinite(point.cost) && all_finite(rows_);
  });
  for (int i = 0; i < unknowns_.equality_count(); ++i)
    point.equalities[i] = rows_[unknowns_.equalities[i]] - unknowns_.right_side[i];
  for (int i = 0; i < unknowns_.slack_count(); ++i)
    point.inequalities[i] = unknowns_.scale[i] * rows_[unknowns_.inequalities[i]];
  const double violated = violation(point), enough = options_.constraint_tolerance;
  const bool better =
      violated <= enough ? best_violation_ > enough || point.cost < best_cost_ : violated < best_violation_;
  if (!better) return;
  best_x_ = point.x;
  best_violation_ = violated;
  best_cost_ = point.cost;
}

double Functions::violation(const Point& point) const {
  const int n = unknowns_.free_count(), slacks = unknowns_.slack_count();
  const auto outside = [](const auto& value, const auto& lower, const auto& upper) {
    return (lower - value).array().max((value - upper).array());
  };
  double worst = 0.0;
  if (n > 0)
    worst = std::max(worst, outside(point.t.head(n), unknowns_.lower.head(n), unknowns_.upper.head(n)).maxCoeff());
  if (unknowns_.equality_count() > 0) worst = std::max(worst, point.equalities.cwiseAbs().maxCoeff());
  if (slacks > 0)
    worst = std::max(worst, (outside(point.inequalities, unknowns_.lower.tail(slacks), unknowns_.upper.tail(slacks)) /
                             unknowns_.scale.array())
                                .maxCoeff());
  return worst;
}

void Functions::derivatives(const Point& point, VectorXd& gradient, LinearSystem& system) {
  if (point.x.cwiseAbs().maxCoeff() > kDiverged)
    throw Halt{nlp::Outcome::numerical_failure, "the iterates diverge; is the cost bounded from below?"};
  clocked(point.x, [&] {
    problem_.gradient(point.x, gradient_);
    return jacobian_.evaluate(point.x) && all_finite(gradient_);
  });
  for (int i = 0; i < unknowns_.free_count(); ++i) gradient[i] = gradient_[unknowns_.free[i]];
  system.set_jacobian(jacobian_.values());
}

void Functions::gauss_newton_hessian(const Point& point, VectorXd& values) {
  values.resize(hessian_.size());
  clocked(point.x, [&] {
    problem_.gauss_newton_hessian(point.x, values);
    return all_finite(values);
  });
}

const VectorXd& Functions::hessian(const Point& point, double cost_factor, const VectorXd& equalities,
                                   const VectorXd& inequalities) {
  for (int i = 0; i < unknowns_.equality_count(); ++i) multipliers_[unknowns_.equalities[i]] = equalities[i];
  for (int i = 0; i < unknowns_.slack_count(); ++i)
    multipliers_[unknowns_.inequalities[i]] = unknowns_.scale[i] * inequalities[i];
  clocked(point.x, [&] {
    problem_.hessian(point.x, cost_factor, multipliers_, hessian_);
    return all_finite(hessian_);
  });
  return hessian_;
}

}  // namespace mcplan::ipm
