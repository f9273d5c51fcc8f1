#include "ipm/phase_one.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mcplan::ipm {
namespace {

using Eigen::VectorXd;

constexpr double kStationary = 1e-5;  // of the gradient, over the norm of the residuals
constexpr double kHeld = 1e12;        // weight of variables that are to stay where they are

/// How far outside: negative below the lower limit, positive above the upper one.
double beyond(double value, double lower, double upper, double drawn_in) {
  const double room = std::min(drawn_in, drawn_in * (upper - lower));
  if (value < lower + room) return value - (lower + room);
  if (value > upper - room) return value - (upper - room);
  return 0.0;
}

/// Residuals at a point: of equalities, of inequalities, of bounds.
struct Residuals {
  VectorXd equalities, rows, bounds;

  Residuals(const Unknowns& unknowns, const Point& point, double drawn_in)
      : equalities(point.equalities), rows(unknowns.slack_count()), bounds(unknowns.free_count()) {
    const int n = unknowns.free_count();
    for (int i = 0; i < n; ++i) bounds[i] = beyond(point.t[i], unknowns.lower[i], unknowns.upper[i], drawn_in);
    for (int i = 0; i < unknowns.slack_count(); ++i)
      rows[i] = beyond(point.inequalities[i], unknowns.lower[n + i], unknowns.upper[n + i], drawn_in);
  }
  double half_square() const { return 0.5 * (equalities.squaredNorm() + rows.squaredNorm() + bounds.squaredNorm()); }
  double largest() const {
    const auto max = [](const VectorXd& v) { return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0.0; };
    return std::max({max(equalities), max(rows), max(bounds)});
  }
};

/// Which variables are at a bound and would leave it along minus the gradient: none, where that is no matter.
std::vector<int> held(const Unknowns& unknowns, const Point& point, const VectorXd& gradient, bool within_bounds) {
  std::vector<int> out;
  for (int i = 0; within_bounds && i < unknowns.free_count(); ++i)
    if ((point.t[i] <= unknowns.lower[i] && gradient[i] > 0.0) ||
        (point.t[i] >= unknowns.upper[i] && gradient[i] < 0.0))
      out.push_back(i);
  return out;
}

VectorXd ones_where_not_zero(const VectorXd& v) { return (v.array() != 0.0).cast<double>(); }

}  // namespace

bool PhaseOne::run(const Unknowns& unknowns, Functions& functions, Kkt& kkt, Point& point) const {
  const int n = unknowns.free_count();
  VectorXd gradient(n), right_side(n), bound_weights(n), step(n), multipliers(unknowns.equality_count());
  const VectorXd no_equalities = VectorXd::Zero(unknowns.equality_count());
  const VectorXd no_rows = VectorXd::Zero(unknowns.slack_count());
  if (max_iterations == 0) return false;
  functions.evaluate(point);
  Point trial = point;
  double lambda = damping, growth = 2.0, before = nlp::kInfinity;
  bool moved = true;
  for (int i = 0; i < max_iterations; ++i) {
    const Residuals now(unknowns, point, drawn_in);
    if (now.largest() <= enough) break;
    if (patience > 0 && i % patience == 0) {
      if (now.half_square() > (1.0 - hardly) * before) return true;
      before = now.half_square();
    }
    functions.begin_iteration();
    if (moved) {
      functions.derivatives(point, gradient, kkt);
      kkt.set_hessian(functions.hessian(point, 0.0, no_equalities, no_rows));
    }
    gradient = now.bounds;
    kkt.add_inequalities_transposed(now.rows, gradient);
    right_side = -gradient;
    kkt.add_equalities_transposed(now.equalities, gradient);
    bound_weights = ones_where_not_zero(now.bounds);
    for (int k : held(unknowns, point, gradient, within_bounds)) {
      bound_weights[k] = kHeld;
      gradient[k] = right_side[k] = 0.0;
    }
    if (gradient.norm() <= kStationary * std::sqrt(2.0 * now.half_square())) return true;
    kkt.set_weights(ones_where_not_zero(now.rows), bound_weights);
    if (kkt.factor(lambda, 1.0) == Kkt::Factor::singular) break;
    kkt.solve(right_side, -now.equalities, step, multipliers);
    if (!step.allFinite()) break;
    trial.t.head(n) = point.t.head(n) + step;
    if (within_bounds)
      trial.t.head(n) = trial.t.head(n).cwiseMax(unknowns.lower.head(n)).cwiseMin(unknowns.upper.head(n));
    functions.evaluate(trial);
    const double fallen = now.half_square() - Residuals(unknowns, trial, drawn_in).half_square();
    const double expected = 0.5 * step.dot(lambda * step - gradient);
    moved = fallen > 0.0;
    if (moved) {
      std::swap(point, trial);
      lambda *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * fallen / expected - 1.0, 3));
      growth = 2.0;
    } else {
      lambda *= growth;
      growth *= 2.0;
    }
  }
  return false;
}

}  // namespace mcplan::ipm
