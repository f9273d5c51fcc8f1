#pragma once

#include "ddp/constants.hpp"
#include "ddp/contact_sequence.hpp"
#include "ddp/local_model.hpp"
#include "mcplan/base/logging.hpp"

namespace mcplan::ddp {

/// Valid sequence from start to goal contacts that costs least with the trajectory held fixed: dynamic programming over
/// (step, contact state) (Tazaki, sec. IV-D, INIT). Empty when none joins the two in N steps. More than `beam` states a
/// step are cut to the cheapest. Empty, too, when `stop`, asked now and then, says so.
ContactSequence initial_sequence(LocalModel& model, std::size_t beam = kBeam, const StopRequest& stop = nullptr);

}  // namespace mcplan::ddp
