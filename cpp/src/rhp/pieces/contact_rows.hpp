#pragma once

#include <Eigen/Core>
#include <vector>

#include "mcplan/nlp/problem.hpp"
#include "rhp/pieces/contact_point.hpp"

namespace mcplan::rhp {

/// m a - sum_i f_i = -m g e_z: the CoM's acceleration a [m/s^2] (Wang et al., eq. 2b). Rows divided by kForceUnit.
void add_acceleration(nlp::Problem& problem, int acceleration, const std::vector<Placement>& placements,
                      const std::vector<ContactPoint>& points, double mass, double gravity);

/// Friction pyramid of a point whose normal force is at least zero by its bound, phi_j = 2 pi j / sides, with `turned`
/// 2 pi (j + 1/2) / sides:
///
///     cos(phi_j) f_t1 + sin(phi_j) f_t2 <= mu cos(pi / sides) f_n        inside the circular cone
///
/// and with `outer` |f_t1|, |f_t2| <= mu f_n, the paper's pyramid of four sides around it.
void add_friction(nlp::Problem& problem, const ContactPoint& point, double friction, int sides, bool outer,
                  bool turned = false);

/// The edges of a friction pyramid in world axes, with unit normal component: f = sum of edges times factors that are
/// not negative. They span what the rows of add_friction allow; inside the circular cone those that are `turned`: the
/// first edge lies along t1.
Eigen::Matrix3Xd pyramid_edges(const Placement& placement, double friction, int sides, bool outer);

/// Every world component of the point's force within +- limit [N]. On level ground these are bounds of the variables;
/// rows that friction and the others imply are left out.
void add_force_box(nlp::Problem& problem, const Placement& placement, const ContactPoint& point, double limit,
                   double friction);

}  // namespace mcplan::rhp
