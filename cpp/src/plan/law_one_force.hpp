#pragma once

#include <Eigen/Core>

#include "base/entire_functions.hpp"
#include "phase_instant.hpp"

namespace mcplan::laws {

/// The CoM's motion in closed form, by the entire functions of stiffness x (time since the phase began)^2
/// (docs/theory/ddp.md, "Closed form").
void set_com(const PhaseInstant& at, const Pull& pull, const EntireFunctions& f, PlanState& state);

/// f_l at the CoM that stands in the state, and where it acts: the anchor or the centre of pressure.
void set_forces(const PhaseInstant& at, Eigen::Vector3d Contact::*acts_at_W, PlanState& state);

}  // namespace mcplan::laws
