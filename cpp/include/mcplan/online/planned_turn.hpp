#pragma once

#include "mcplan/plan/plan.hpp"

namespace mcplan::online {

/// So much of what a base turns otherwise than planned [rad/s] is left to the controller.
constexpr double kTurnMargin_rad_s = 0.3;

/// The state from which to plan on at time t [s] in the plan under way: the measured one, but what the rates of the
/// base's angles are off the planned ones is shorter by the margin [rad/s], or nothing, and the angular momentum's
/// difference by the same ratio.
///
/// A foot that lands, and legs that swing, turn a base by some tenths of a radian a second for some hundredths of a
/// second, and a controller turns it back. A plan that begins with that rate knows no such controller: it takes all of
/// the momentum off by the forces of the next steps. (Measured: where the G1 landed on `up_and_down` with 0.25 rad/s, a
/// plan of a cost of 0.24 became one of 69 that missed the reach of a leg, and the robot stopped.) In flight, where no
/// controller can, and where the CoM's velocity is off by more than 0.08 m/s, since what pushes a robot turns it as
/// well, the measured state counts.
Knot with_planned_turn(Knot measured, const Plan& plan, double t, double margin_rad_s = kTurnMargin_rad_s);

}  // namespace mcplan::online
