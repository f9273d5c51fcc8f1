#pragma once

#include "mcplan/plan/plan.hpp"

namespace mcplan::online {

/// Off the planned height by less than this [m], for a robot of human size as for a smaller one, a robot counts as
/// being at it.
constexpr double kHeightMargin_m = 0.03;

/// The state from which to plan on at time t [s] in the plan under way: the measured one, but with height and vertical
/// velocity of the CoM as planned where z - z_planned, and the same with sqrt(h / g) times the difference of the
/// velocities added, are smaller than the margin [m].
///
/// A controller holds the height with a small error: a robot of a tenth more mass than its model hangs a centimeter
/// lower. A plan that begins there forgets that, and so does the next one: ten times a second a little lower, until the
/// robot falls. (Measured: TALOS and G1, on the spot with a mass 10 % off, fell after 14 s.) From the planned height
/// the controller keeps pulling. On the level the measured state counts: steps are what holds the robot there.
Knot with_planned_height(Knot measured, const Plan& plan, double t, double margin_m = kHeightMargin_m);

}  // namespace mcplan::online
