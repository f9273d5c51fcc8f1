#pragma once

#include <optional>
#include <vector>

#include "ddp/replan/rest.hpp"
#include "ddp/replan/trial.hpp"

namespace mcplan::ddp {

/// Steps that catch a push, and the robot that is let take them.
struct Recovery {
  Rest rest;
  Robot robot;
};

/// Steps that catch a push: the foot in the air lands, then the other one steps, then the first again, each where the
/// capture point of a linear inverted pendulum will be by then, and the robot stands, wherever that is. From both feet
/// either of them steps first. Few phases, which may be shorter than those of a walk: what is far ahead does not matter
/// to a robot that falls.
///
/// Pushed outward over the foot that stands, a robot is caught by the one in the air alone if that lands on the other
/// side. With ReplanOptions::crossing it steps across as well: first past the foot that stands, behind it or in front
/// of it, on the side on which it is by now, then to the other side.
///
/// For robots on two feet; else none.
std::vector<Recovery> recoveries(const Rest& rest, const Now& now);

/// The steps that catch a push of the plan under way, to their own end; none where it has none.
std::optional<Recovery> recovery_under_way(const Rest& rest, const Now& now);

}  // namespace mcplan::ddp
