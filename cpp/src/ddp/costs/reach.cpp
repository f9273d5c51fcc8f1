#include "mcplan/base/rotation.hpp"
#include "mcplan/ddp/costs/costs.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Rows of one end-effector. The CoM and the base may depend on all of z (inside a phase) or be the state's own.
void reach_rows(const Problem& problem, const VectorXd& x, int l, const Vector3d& com, const Vector3d& rpy,
                const Instant* inside, double weight, Rows& rows) {
  const Layout& at = problem.layout;
  const EndLimits& limit = problem.limits[l];
  const Matrix3d r = rotation_from_rpy(rpy);
  const Vector3d offset = x.segment<3>(at.end(l)) - com;
  const Vector3d relative = r.transpose() * offset;
  for (int i = 0; i < 3; ++i) {
    double beyond = 0.0;
    if (relative[i] < limit.reach_min[i])
      beyond = relative[i] - limit.reach_min[i];
    else if (relative[i] > limit.reach_max[i])
      beyond = relative[i] - limit.reach_max[i];
    else
      continue;
    if (!rows.with_gradient()) {
      rows.add_value(weight, beyond);
      continue;
    }
    auto g = rows.add_dense(weight, beyond);
    g.segment<3>(at.end(l)) += r.col(i);
    Vector3d turn = Vector3d::Zero();
    for (int axis : at.axes()) turn[axis] = rotation_derivative(rpy, axis).col(i).dot(offset);
    if (inside) {
      inside->add_along(-r.col(i), turn, g);
      continue;
    }
    g.segment<3>(at.com()) -= r.col(i);
    for (int a = 0; a < at.axis_count(); ++a) g[at.angle(a)] += turn[at.axes()[a]];
  }
}

}  // namespace

void reach_cost(const Problem& problem, const VectorXd& x, Rows& rows) {
  rows.begin(Term::reach);
  const Vector3d com = x.segment<3>(problem.layout.com()), rpy = problem.rpy(x);
  for (int l = 0; l < problem.layout.ends(); ++l)
    reach_rows(problem, x, l, com, rpy, nullptr, problem.options.weights.limit, rows);
}

void interior_reach_cost(const Problem& problem, const VectorXd& x, const std::vector<Instant>& instants, int l,
                         double weight, Rows& rows) {
  rows.begin(Term::reach);
  for (std::size_t i = 1; i + 1 < instants.size(); ++i)
    reach_rows(problem, x, l, instants[i].com, instants[i].rpy, &instants[i], weight, rows);
}

void sole_turn_cost(const Problem& problem, const std::vector<Instant>& instants, int l, double sole_yaw, double weight,
                    Rows& rows) {
  const EndLimits& limit = problem.limits[l];
  rows.begin(Term::reach);
  for (const Instant& instant : instants) {
    const double turn = sole_yaw - instant.rpy.z();
    const double beyond = turn < limit.yaw_min ? turn - limit.yaw_min : turn > limit.yaw_max ? turn - limit.yaw_max : 0;
    if (beyond == 0.0) continue;
    if (!rows.with_gradient())
      rows.add_value(weight, beyond);
    else
      instant.add_along(Vector3d::Zero(), -Vector3d::UnitZ(), rows.add_dense(weight, beyond));
  }
}

}  // namespace mcplan::ddp
