#pragma once

#include "ddp/cost_terms.hpp"
#include "mcplan/base/rotation.hpp"

namespace mcplan::ddp {

/// Rows of p_min <= R(theta)' (p_l - p) <= p_max of one end-effector. The CoM and the base may depend on all of z
/// (`inside` a phase) or be the state's own (null).
inline void write_reach(const StepView& step, int l, const Eigen::Vector3d& com, const Eigen::Vector3d& rpy,
                        const Instant* inside, Rows& rows) {
  const Layout& at = step.problem.layout;
  const EndLimits& limit = step.problem.limits[l];
  const double weight = inside ? step.schedule.interior_weight : step.schedule.tuning.limit_weight;
  const Eigen::Matrix3d r = rotation_from_rpy(rpy);
  const Eigen::Vector3d offset = step.x.segment<3>(at.end(l)) - com;
  const Eigen::Vector3d relative = r.transpose() * offset;
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
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    for (int axis : at.axes()) turn[axis] = rotation_derivative(rpy, axis).col(i).dot(offset);
    if (inside) {
      inside->add_along(-r.col(i), turn, g);
      continue;
    }
    g.segment<3>(at.com()) -= r.col(i);
    for (int a = 0; a < at.axis_count(); ++a) g[at.angle(a)] += turn[at.axes()[a]];
  }
}

}  // namespace mcplan::ddp
