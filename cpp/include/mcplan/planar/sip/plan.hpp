#pragma once

#include "mcplan/planar/sip/options.hpp"
#include "mcplan/planar/sip/planner.hpp"
#include "mcplan/planar/task.hpp"

namespace mcplan::sip {

/// Joint splines, durations and contact forces of a planar robot through the stances of a task, by semi-infinite
/// programming. The plan is solved if the result's report says so: the checker has then accepted it. Throws
/// InvalidPlanarTask, InvalidRobot or InvalidOptions. Planner is behind it, for warm starts.
Result plan(const PlanarTask& task, const Options& options = {});

}  // namespace mcplan::sip
