#pragma once

#include "ddp/search.hpp"
#include "mcplan/plan/plan.hpp"

namespace mcplan::ddp {

/// Plan in SI units from a trajectory with exact contacts: phases, knots, and swings that leave and arrive along the
/// surfaces' normals and are high enough to clear the scene (Tazaki, sec. IV-E); without `swing_heights` they are as
/// high as usual.
Plan to_plan(const Problem& problem, const Incumbent& incumbent, bool swing_heights = true);

/// The inverse, for warm starts: phases `first`.. of a plan as trajectory and sequence of `problem`, which has as many
/// steps as remain. Surfaces are matched by name, a contact with one that is gone becomes free. Empty sequence when the
/// robots differ.
Incumbent from_plan(const Problem& problem, const Plan& plan, int first);

}  // namespace mcplan::ddp
