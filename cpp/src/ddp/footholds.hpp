#pragma once

#include "ddp/contact_sequence.hpp"
#include "ddp/problem.hpp"

namespace mcplan::ddp {

/// Put every end-effector in contact onto its surface and keep it there: each contact gets one foothold, the mean of
/// its knots put onto the polygon, the first ones that of the start. Strides join the knots.
void snap_positions(const Problem& problem, const ContactSequence& sequence, Trajectory& trajectory);

}  // namespace mcplan::ddp
