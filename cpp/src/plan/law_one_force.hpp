#pragma once

#include <Eigen/Core>

#include "base/entire_functions.hpp"
#include "phase_instant.hpp"

namespace mcplan::laws {

/// What moves the CoM under f_l = m mu_l (p - s_l): p'' = stiffness p - pull, with stiffness = sum mu_l [1/s^2] and
/// pull = sum mu_l s_l + g e_z [m/s^2] (Tazaki, sec. II).
struct Pull {
  explicit Pull(const PhaseInstant& at);

  Eigen::Vector3d acceleration_W(const Eigen::Vector3d& com_W) const { return stiffness * com_W - pull_W; }

  double stiffness = 0.0;
  Eigen::Vector3d pull_W;
};

/// The CoM's motion in closed form, by the entire functions of stiffness x (time since the phase began)^2
/// (docs/theory/ddp.md, "Closed form").
void set_com(const PhaseInstant& at, const Pull& pull, const EntireFunctions& f, PlanState& state);

/// f_l at the CoM that stands in the state, and where it acts: the anchor or the centre of pressure.
void set_forces(const PhaseInstant& at, Eigen::Vector3d Contact::*acts_at_W, PlanState& state);

}  // namespace mcplan::laws
