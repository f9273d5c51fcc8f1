#pragma once

#include "mcplan/plan/plan.hpp"
#include "mcplan/plan/report.hpp"

namespace mcplan::online {

/// Whether it is better to follow the plan of a replan than to stay with the plan under way: it was made from the
/// measured state, and it is solved, acceptable, or keeps all limits for twice the time [s] between two replans.
bool follows(const Report& report, double period_s);

/// The plan with the ways of end-effectors that are in the air at its start kept from the ground, and none kicked up.
///
/// The way of an end-effector in the air goes on from where it is by a spline, plus what is left of its lift (Swing).
/// The spline alone sinks at once, and replan after replan toes come to drag: half way to its landing a foot is to be
/// half as high as in a swing of usual duration with that much of it left. Where it would not be, it is lifted anew.
/// With 50 ms to go such a height is a kick: its way is raised by no more than 0.5 m/s. Where the checker finds that
/// the way so changed keeps limits for less long, down to an edge that it was lifted over, it stays as it was planned.
/// Throws InvalidPlan.
Plan with_feet_kept_up(Plan plan);

}  // namespace mcplan::online
