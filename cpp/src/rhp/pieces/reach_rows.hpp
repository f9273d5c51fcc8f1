#pragma once

#include <Eigen/Core>

#include "mcplan/nlp/problem.hpp"
#include "mcplan/rhp/options.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/polygon.hpp"
#include "rhp/pieces/contact_point.hpp"

namespace mcplan::rhp {

/// K (c - p) <= k for a foot in contact (Wang et al., eq. 1f). Polytope in world axes.
void add_com_reach(nlp::Problem& problem, int com, const Placement& foot, const Polytope& reach_W);

/// Q (p_other - p) <= q between two feet on the ground (eq. 1e). Polytope in world axes.
void add_foot_reach(nlp::Problem& problem, const Placement& foot, const Placement& other, const Polytope& reach_W);

/// height.min <= c_z - p_z <= height.max [m] for a foot in contact.
void add_com_height(nlp::Problem& problem, int com, const Placement& foot, const Range& height);

/// The whole sole on the surface: e_j . (p - v_j) <= -(|e_j . t1| half_1 + |e_j . t2| half_2) for every edge j (eq.
/// 1d).
void add_foothold(nlp::Problem& problem, const Placement& foot, const Polygon& surface,
                  const Eigen::Vector2d& half_size);

}  // namespace mcplan::rhp
