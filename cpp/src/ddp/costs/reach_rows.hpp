#pragma once

#include "ddp/cost_terms.hpp"
#include "mcplan/base/rotation.hpp"

namespace mcplan::ddp {

/// Rows of p_min <= R(theta)' (p_l - p) <= p_max of one end-effector, and of the faces that cut this box. The CoM and
/// the base may depend on all of z (`inside` a phase) or be the state's own (null).
inline void write_reach(const StepView& step, int l, const Eigen::Vector3d& com, const Eigen::Vector3d& rpy,
                        const Instant* inside, Rows& rows) {
  const Layout& at = step.problem.layout;
  const EndLimits& limit = step.problem.limits[l];
  const double room = inside ? step.problem.reach_room : 0.0;
  const double weight = inside ? step.schedule.interior_weight : step.schedule.tuning.limit_weight;
  const Eigen::Matrix3d r = rotation_from_rpy(rpy);
  const Eigen::Vector3d offset = step.x.segment<3>(at.end(l)) - com;
  const Eigen::Vector3d relative = r.transpose() * offset;
  // A row of n' R' (p_l - p) that is `beyond` its bound.
  const auto write = [&](const Eigen::Vector3d& n, double beyond) {
    if (!rows.with_gradient()) {
      rows.add_value(weight, beyond);
      return;
    }
    auto g = rows.add_dense(weight, beyond);
    const Eigen::Vector3d along = r * n;
    g.segment<3>(at.end(l)) += along;
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    for (int axis : at.axes()) turn[axis] = (rotation_derivative(rpy, axis) * n).dot(offset);
    if (inside) {
      inside->add_along(-along, turn, g);
      return;
    }
    g.segment<3>(at.com()) -= along;
    for (int a = 0; a < at.axis_count(); ++a) g[at.angle(a)] += turn[at.axes()[a]];
  };
  for (int i = 0; i < 3; ++i) {
    if (relative[i] < limit.reach_min[i] + room)
      write(Eigen::Vector3d::Unit(i), relative[i] - limit.reach_min[i] - room);
    else if (relative[i] > limit.reach_max[i] - room)
      write(Eigen::Vector3d::Unit(i), relative[i] - limit.reach_max[i] + room);
  }
  for (int i = 0; i < limit.cuts; ++i) {
    const double beyond = limit.cut_A.row(i).dot(relative) - limit.cut_b[i] + room;
    if (beyond > 0.0) write(limit.cut_A.row(i).transpose(), beyond);
  }
}

}  // namespace mcplan::ddp
