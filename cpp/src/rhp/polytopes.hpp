#pragma once

#include <Eigen/Core>

#include "mcplan/robot/robot.hpp"

namespace mcplan::rhp {

/// Box low <= x <= high as a polytope of six rows.
Polytope box_polytope(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

/// The rows of `polytope` that its intersection with a bounded box needs: those on which at least three of the
/// intersection's corners lie. The rows left out are implied by the others wherever x is in the box.
Polytope without_implied_rows(const Polytope& polytope, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

/// Where the CoM may be relative to this end-effector in contact, axes of the heading: com_reach, or what its box says.
Polytope com_reach_of(const EndEffector& foot);

/// Where `other` may stand relative to `foot`, both in contact: partner_reach, or what the two boxes say.
Polytope partner_reach_of(const EndEffector& foot, const EndEffector& other);

/// {R x : x in polytope}.
Polytope rotated(const Polytope& polytope, const Eigen::Matrix3d& R);

}  // namespace mcplan::rhp
