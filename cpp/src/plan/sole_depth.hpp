#pragma once

#include <Eigen/Core>
#include <vector>

#include "plan/clearance.hpp"

namespace mcplan {

/// How far a sole that stands flat at position_W is inside a solid [m]: by how much it would have to be moved, up or to
/// a side, to be out of it; 0 when it is out of all. `own`: the surface that it stands on, whose solid is left out;
/// -1: none. A solid whose lower face is more than a foot's `height` above the sole is over it, not in it. Of an
/// end-effector without a sole it is the point's.
double sole_depth(const std::vector<Solid>& solids, int own, const EndEffector& end_effector, double height,
                  const Eigen::Vector3d& position_W, const Eigen::Matrix3d& sole_W);

/// Height of a foot [m] of a robot of a person's size (robot/similarity.hpp): chosen, thinner than any.
constexpr double kFootHeight = 0.02;

/// Depth that a sole in contact may have [m], likewise. Sides of the prism below a tilted surface lean over what lies
/// beside it by up to two centimetres, and a foot that meets bumps of 1 to 3 cm unawares stays on its plan in
/// simulation (CoM within 7 mm).
constexpr double kSoleDepth = 0.03;

}  // namespace mcplan
