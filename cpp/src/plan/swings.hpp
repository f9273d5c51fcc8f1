#pragma once

#include <vector>

#include "mcplan/plan/plan.hpp"

namespace mcplan {

/// Fill plan.swings from its contact sequence: one for every stretch of phases in which an end-effector is free, with
/// the normals of what it leaves and reaches, and of a few heights around robot.swing_height the first that clears the
/// scene (the one that goes in least, if none does). An end-effector that neither leaves nor reaches a surface gets
/// height 0. One that is on its way at a measured start goes on as the swing of its end-effector in `under_way`, if
/// that clears the scene, and else is lifted anew by as little as does; without such a swing it has height 0 at first.
/// Without `heights` the others have the robot's, clear or not, which takes no time. Throws InvalidPlan where the rest
/// of the plan does not fit together. `normals_W`, by end-effector: how soles are tilted that are in the air at a
/// measured start; left out: not at all.
void choose_swings(Plan& plan, bool heights = true, const std::vector<Swing>& under_way = {},
                   const std::vector<Eigen::Vector3d>& normals_W = {});

/// Normals of all soles of a plan at time t [s]: of what they touch, or on the way from what they have left to what
/// they land on.
std::vector<Eigen::Vector3d> sole_normals(const Plan& plan, double t);

/// For each end-effector the swing of a plan that began last before time t [s] in it, with the time since then in
/// elapsed_s, whether it has ended or not: an end-effector may be late.
std::vector<Swing> swings_under_way(const Plan& plan, double t);

}  // namespace mcplan
