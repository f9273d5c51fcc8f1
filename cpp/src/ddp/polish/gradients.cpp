#include "ddp/polish/gradients.hpp"

namespace mcplan::ddp::polish {

using Eigen::Ref;
using Eigen::Vector3d;
using Eigen::VectorXd;

void add_by_pose(const Lifted& at, const Eigen::Matrix<double, 6, 1>& by_pose, Ref<VectorXd> g) {
  const Layout& layout = at.fixed.problem().layout;
  if (at.instant == 0) {
    g.segment<3>(Layout::com()) += by_pose.head<3>();
    for (int a = 0; a < layout.axis_count(); ++a) g[layout.angle(a)] += by_pose[3 + layout.axes()[a]];
    return;
  }
  const Phase& phase = at.fixed.phase(at.k);
  const auto moved = at.lifted.middleRows<6>(6 * (at.instant - 1));
  for (std::size_t c = 0; c < phase.moving.size(); ++c)
    g[phase.moving[c]] += by_pose.dot(moved.col(static_cast<int>(c)));
}

void add_by_legs(const FixedSequence& fixed, int k, double fraction, const Vector3d& by_legs, Ref<VectorXd> g) {
  const Problem& problem = fixed.problem();
  for (int m : problem.jointed.ends) g.segment<3>(problem.layout.end(m)) += by_legs;
  for (const Phase::Swinging& swinging : fixed.phase(k).swinging)
    if (problem.limits[swinging.l].limb.given()) g.segment<3>(swinging.stride) += fraction * by_legs;
}

}  // namespace mcplan::ddp::polish
