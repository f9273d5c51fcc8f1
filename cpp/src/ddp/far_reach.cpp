#include "ddp/far_reach.hpp"

#include <algorithm>

#include "mcplan/base/rotation.hpp"

namespace mcplan::ddp {
namespace {

/// What searches miss limits by is nothing that was planned.
constexpr double kMissed_m = 2e-3;

}  // namespace

bool has_far_reach(const Robot& robot) {
  return std::any_of(robot.end_effectors.begin(), robot.end_effectors.end(), [](const EndEffector& end) {
    const Eigen::AlignedBox3d usual = end.usual_box();
    return usual.min().x() > end.reach_min_B.x() || usual.max().x() < end.reach_max_B.x();
  });
}

bool reaches_far(const Plan& plan) {
  if (!has_far_reach(plan.robot)) return false;
  for (std::size_t k = 1; k < plan.knots.size(); ++k) {
    const Knot& knot = plan.knots[k];
    const Eigen::Matrix3d to_base = rotation_from_rpy(knot.base_rpy).transpose();
    for (std::size_t e = 0; e < plan.robot.end_effectors.size(); ++e) {
      if (plan.phases[k - 1].contacts[e].surface < 0) continue;
      const double x = to_base.row(0).dot(knot.end_effectors_W[e] - knot.com_W);
      const Eigen::Vector2d& usual = plan.robot.end_effectors[e].usual_reach;
      if (x < usual[0] - kMissed_m || x > usual[1] + kMissed_m) return true;
    }
  }
  return false;
}

}  // namespace mcplan::ddp
