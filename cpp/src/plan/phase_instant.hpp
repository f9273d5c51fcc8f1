#pragma once

#include "base/base_rotation.hpp"
#include "mcplan/plan/plan.hpp"

namespace mcplan {

/// What a force law is given of an instant: the phase, the knots at its ends, and the time since it began.
struct PhaseInstant {
  const Plan& plan;
  const Phase& phase;
  const Knot& from;
  const Knot& to;
  double since_start = 0.0;               ///< [s]
  const BaseRotation* turning = nullptr;  ///< from the first knot, where somebody has it already
};

}  // namespace mcplan
