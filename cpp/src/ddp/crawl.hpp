#pragma once

#include <Eigen/Core>
#include <utility>

namespace mcplan::ddp {

/// Sorts feet in the order in which walking animals set down one after the other: of either side the rear one, then the
/// one ahead of it. The three feet that stand have the CoM between them for longer than in any other order.
///
/// @param ahead  direction of the walk
/// @param at     nominal place of the foot relative to the CoM, in the same axes
inline std::pair<bool, double> crawl_turn(const Eigen::Vector2d& ahead, const Eigen::Vector2d& at) {
  return {ahead.x() * at.y() - ahead.y() * at.x() > 0.0, ahead.dot(at)};
}

}  // namespace mcplan::ddp
