#pragma once

#include "mcplan/planar/sip/options.hpp"
#include "mcplan/planar/task.hpp"

namespace mcplan::sip {

/// What a valid task may lack for this planner, by the first field that does. Throws InvalidInput.
void require_plannable(const PlanarTask& task, const Options& options);

/// The task's and the options' bounds of durations must leave something between them. Throws InvalidOptions.
void require_durations(const PlanarTask& task, const Options& options);

}  // namespace mcplan::sip
