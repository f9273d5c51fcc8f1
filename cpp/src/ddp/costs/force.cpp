#include <algorithm>
#include <cmath>
#include <limits>

#include "mcplan/ddp/costs/costs.hpp"

namespace mcplan::ddp {

using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// d mu_l / d(its input).
double stiffness_slope(const Problem& problem, const VectorXd& u, int l) {
  return problem.options.stiffness_input == StiffnessInput::lambda ? 2.0 * u[problem.layout.stiffness(l)] : 1.0;
}

/// A row that depends on d = p(t) - s_l alone.
void add_along_direction(const Problem& problem, const Instant& instant, int l, double weight, double value,
                         const Vector3d& along, Rows& rows) {
  if (!rows.with_gradient()) {
    rows.add_value(weight, value);
    return;
  }
  auto g = rows.add_dense(weight, value);
  instant.add_along(along, Vector3d::Zero(), g);
  problem.layout.add_along_line_point(l, -along, g);
}

}  // namespace

void friction_cost(const Problem& problem, const VectorXd& x, const VectorXd& u, const std::vector<Instant>& instants,
                   int l, int surface, double weight, Rows& rows) {
  const double friction = problem.friction[surface];
  if (std::isinf(friction)) return;
  const Vector3d& n = problem.polygons[surface].normal_W();
  const Vector3d s = problem.layout.line_point(x, u, l);
  rows.begin(Term::friction);
  for (const Instant& instant : instants) {
    const Vector3d d = instant.com - s;
    const double normal = n.dot(d);
    const Vector3d tangential = d - normal * n;
    const double length = tangential.norm();
    if (problem.options.friction_sides > 0) {
      const double inside = friction * problem.pyramid_share;
      for (const Vector3d& t : problem.pyramid[surface])
        if (const double beyond = t.dot(d) - inside * normal; beyond > 0.0)
          add_along_direction(problem, instant, l, weight, beyond, t - inside * n, rows);
      continue;
    }
    const double beyond = length - friction * normal;
    if (beyond <= 0.0) continue;
    const Vector3d along = (length > 1e-12 ? Vector3d(tangential / length) : Vector3d::Zero()) - friction * n;
    add_along_direction(problem, instant, l, weight, beyond, along, rows);
  }
}

void force_cap_cost(const Problem& problem, const Pendulum& pendulum, const VectorXd& x, const VectorXd& u,
                    const std::vector<Instant>& instants, int l, double weight, Rows& rows) {
  const Layout& at = problem.layout;
  const double mu = pendulum.mu(u, l), cap = problem.limits[l].force_max;
  const Vector3d s = at.line_point(x, u, l);
  rows.begin(Term::force_cap);
  for (const Instant& instant : instants) {
    const Vector3d d = instant.com - s;
    const double distance = d.norm();
    const double beyond = mu * distance - cap;
    if (beyond <= 0.0) continue;
    add_along_direction(problem, instant, l, weight, beyond, mu / distance * d, rows);
    if (rows.with_gradient())
      rows.last_gradient()[at.nx() + at.stiffness(l)] += distance * stiffness_slope(problem, u, l);
  }
}

double torsion_arm(const Problem& problem, int l, int surface) {
  const double friction = problem.friction[surface];
  // Point contacts have no sole to judge by; their max_moment alone counts.
  if (std::isinf(friction) || problem.limits[l].half_width <= 0.0) return std::numeric_limits<double>::infinity();
  return std::min(friction, 1.0) * problem.limits[l].half_width;
}

bool about_normal(const Problem& problem, const Layout::Moment& moment, int surface) {
  constexpr double kAlong = 1.0 - 1e-9;
  return problem.model == Model::lipm ||
         std::abs(moment.direction_W.dot(problem.polygons[surface].normal_W())) >= kAlong;
}

void torsion_cost(const Problem& problem, const Pendulum& pendulum, const VectorXd& x, const VectorXd& u,
                  const std::vector<Instant>& instants, int l, int surface, double weight, Rows& rows) {
  const Layout& at = problem.layout;
  rows.begin(Term::bounds);
  const double arm = torsion_arm(problem, l, surface), mu = pendulum.mu(u, l);
  const Vector3d& n = problem.polygons[surface].normal_W();
  const Vector3d s = at.line_point(x, u, l);
  for (int i = 0; i < at.moment_count(); ++i) {
    const Layout::Moment& m = at.moments()[i];
    if (m.end_effector != l) continue;
    const double moment = u[at.moment(i)];
    // Moments that are not about this surface's normal are what the centre of pressure does.
    if (!about_normal(problem, m, surface)) {
      rows.add_single(problem.options.weights.limit, moment, at.nx() + at.moment(i));
      continue;
    }
    if (std::isinf(arm)) continue;
    const double sign = moment > 0.0 ? 1.0 : -1.0;
    for (const Instant& instant : instants) {
      const double normal = n.dot(instant.com - s), beyond = std::abs(moment) - arm * mu * normal;
      if (beyond <= 0.0) continue;
      add_along_direction(problem, instant, l, weight, beyond, -arm * mu * n, rows);
      if (!rows.with_gradient()) continue;
      auto g = rows.last_gradient();
      g[at.nx() + at.moment(i)] += sign;
      g[at.nx() + at.stiffness(l)] -= arm * normal * stiffness_slope(problem, u, l);
    }
  }
}

}  // namespace mcplan::ddp
