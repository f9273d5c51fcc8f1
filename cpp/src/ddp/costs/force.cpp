#include <algorithm>
#include <cmath>
#include <limits>

#include "mcplan/ddp/costs/costs.hpp"

namespace mcplan::ddp {

using Eigen::Vector3d;
using Eigen::VectorXd;

void friction_cost(const Problem& problem, const VectorXd& x, const std::vector<Instant>& instants, int l, int surface,
                   double weight, Rows& rows) {
  const double friction = problem.friction[surface];
  if (std::isinf(friction)) return;
  const Vector3d& n = problem.polygons[surface].normal_W();
  rows.begin(Term::friction);
  for (const Instant& instant : instants) {
    const Vector3d d = instant.com - x.segment<3>(problem.layout.end(l));
    const double normal = n.dot(d);
    const Vector3d tangential = d - normal * n;
    const double length = tangential.norm();
    const double beyond = length - friction * normal;
    if (beyond <= 0.0) continue;
    if (!rows.with_gradient()) {
      rows.add_value(weight, beyond);
      continue;
    }
    const Vector3d direction = (length > 1e-12 ? Vector3d(tangential / length) : Vector3d::Zero()) - friction * n;
    auto g = rows.add_dense(weight, beyond);
    g = instant.com_jacobian.transpose() * direction;
    g.segment<3>(problem.layout.end(l)) -= direction;
  }
}

void force_cap_cost(const Problem& problem, const Pendulum& pendulum, const VectorXd& x, const VectorXd& u,
                    const std::vector<Instant>& instants, int l, double weight, Rows& rows) {
  const Layout& at = problem.layout;
  const double mu = pendulum.mu(u, l), cap = problem.limits[l].force_max;
  rows.begin(Term::force_cap);
  for (const Instant& instant : instants) {
    const Vector3d d = instant.com - x.segment<3>(at.end(l));
    const double distance = d.norm();
    const double beyond = mu * distance - cap;
    if (beyond <= 0.0) continue;
    if (!rows.with_gradient()) {
      rows.add_value(weight, beyond);
      continue;
    }
    auto g = rows.add_dense(weight, beyond);
    g = instant.com_jacobian.transpose() * (mu / distance * d);
    g.segment<3>(at.end(l)) -= mu / distance * d;
    const bool lambda = problem.options.stiffness_input == StiffnessInput::lambda;
    g[at.nx() + at.stiffness(l)] += distance * (lambda ? 2.0 * u[at.stiffness(l)] : 1.0);
  }
}

double moment_per_stiffness(const Problem& problem, int l, int surface) {
  const double friction = problem.friction[surface];
  // Point contacts have no sole to judge by; their max_moment alone counts.
  if (std::isinf(friction) || problem.limits[l].half_width <= 0.0) return std::numeric_limits<double>::infinity();
  // The force's normal part is mu_l times the CoM's height above the plane, which may sink well below nominal.
  constexpr double kLowestHeight = 0.6;
  return kLowestHeight * std::min(friction, 1.0) * problem.limits[l].half_width;
}

void torsion_cost(const Problem& problem, const Pendulum& pendulum, const VectorXd& u, int l, int surface,
                  double weight, Rows& rows) {
  const Layout& at = problem.layout;
  const double ratio = moment_per_stiffness(problem, l, surface);
  if (std::isinf(ratio)) return;
  rows.begin(Term::bounds);
  for (int i = 0; i < at.moment_count(); ++i) {
    if (at.moments()[i].end_effector != l) continue;
    const double moment = u[at.moment(i)], beyond = std::abs(moment) - ratio * pendulum.mu(u, l);
    if (beyond <= 0.0) continue;
    if (!rows.with_gradient()) {
      rows.add_value(weight, beyond);
      continue;
    }
    const bool lambda = problem.options.stiffness_input == StiffnessInput::lambda;
    auto g = rows.add_dense(weight, beyond);
    g[at.nx() + at.moment(i)] = moment > 0.0 ? 1.0 : -1.0;
    g[at.nx() + at.stiffness(l)] = -ratio * (lambda ? 2.0 * u[at.stiffness(l)] : 1.0);
  }
}

}  // namespace mcplan::ddp
