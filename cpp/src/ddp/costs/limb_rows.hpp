#pragma once

#include "ddp/constants.hpp"
#include "ddp/cost_terms.hpp"
#include "prism.hpp"

namespace mcplan::ddp {

/// A solid is higher than the CoM; hands reach over what is lower.
inline bool stands_beside(const Polygon& polygon, const Eigen::Vector3d& com) { return polygon.height(com) < 0.0; }

/// By how much [negative] the straight limb from the CoM to a hand is too near to a solid, at which share of it, and
/// the direction in which that grows less; 0: far enough. The hand is drawn to the side on which the CoM is.
struct LimbInside {
  double value = 0.0, share = 0.0;
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();
};

/// With `to_the_end` the hand itself counts as well, else the limb alone.
inline LimbInside limb_inside(const Polygon& polygon, double thickness, const Eigen::Vector3d& com,
                              const Eigen::Vector3d& hand, bool to_the_end) {
  int side = 0;
  for (int e = 1; e < polygon.edge_count(); ++e)
    if (polygon.overshoot(e, com) > polygon.overshoot(side, com)) side = e;
  const bool beside = polygon.overshoot(side, com) > 0.0;
  LimbInside worst;
  for (const double share : {0.4, 0.6, 0.8, 1.0}) {
    if (share == 1.0 && !to_the_end) break;
    const Eigen::Vector3d place = com + share * (hand - com);
    const auto [distance, outward] = outside_prism(polygon, thickness, place);
    if (distance >= kSwingRoom) continue;
    const double value = (beside ? polygon.overshoot(side, place) : distance) - kSwingRoom;
    if (value < worst.value) worst = {value, share, beside ? polygon.edge_outward_W(side) : outward};
  }
  return worst;
}

}  // namespace mcplan::ddp
