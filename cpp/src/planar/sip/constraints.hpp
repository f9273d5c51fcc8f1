#pragma once

#include <array>
#include <set>
#include <vector>

#include "mcplan/planar/plan.hpp"
#include "planar/sip/interval_motion.hpp"
#include "planar/sip/rows.hpp"

namespace mcplan::sip {

/// Pairs of discs that are kept apart: interval, index into collision_pairs, disc of the first and of the second body.
using CloseDiscs = std::set<std::array<int, 4>>;

/// Adds the pairs that a plan brings closer than a margin to each other, or into each other, at one of some instants of
/// each interval.
void add_close_discs(const PlanarPlan& plan, CloseDiscs& close);

/// What is asked of one interval, a function for each constraint; each adds its polynomials to `out`. A constraint
/// touches the parameters of its interval alone (IntervalMotion::local).
void limit_positions(IntervalMotion& motion, std::vector<Limited>& out);        ///< joints, cubic
void limit_velocities(IntervalMotion& motion, std::vector<Limited>& out);       ///< of joints, quadratic
void limit_torques(IntervalMotion& motion, std::vector<Limited>& out);          ///< |torque| <= limit
void keep_in_friction_cone(IntervalMotion& motion, std::vector<Limited>& out);  ///< mu f_n +- f_t >= 0
void keep_pushing(IntervalMotion& motion, std::vector<Limited>& out);           ///< f_n >= min_normal_force
void hold_contacts(IntervalMotion& motion, std::vector<Limited>& out);          ///< tube, band or strict
void balance_forces(IntervalMotion& motion, std::vector<Limited>& out);         ///< of forces that are parameters
void keep_clear(IntervalMotion& motion, std::vector<Limited>& out);             ///< swinging end-effectors, of surfaces
void keep_apart(IntervalMotion& motion, const CloseDiscs* close,
                std::vector<Limited>& out);                          ///< capsules of collision pairs
void pass_poses(IntervalMotion& motion, std::vector<Limited>& out);  ///< at given instants

/// All that the options ask for. `close`: what self-collision is about; null: every pair of discs.
std::vector<Limited> constraints_of(IntervalMotion& motion, const CloseDiscs* close = nullptr);

}  // namespace mcplan::sip
