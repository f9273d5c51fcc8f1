#pragma once

#include <Eigen/Core>

#include "base/base_rotation.hpp"
#include "mcplan/plan/plan.hpp"

namespace mcplan {

/// What moves the CoM under f_l = m mu_l (p - s_l): p'' = stiffness p - pull, with stiffness = sum mu_l [1/s^2] and
/// pull = sum mu_l s_l + g e_z [m/s^2] (Tazaki, sec. II).
struct Pull {
  Pull(const Plan& plan, const Phase& phase);

  Eigen::Vector3d acceleration_W(const Eigen::Vector3d& com_W) const { return stiffness * com_W - pull_W; }

  double stiffness = 0.0;
  Eigen::Vector3d pull_W;
};

/// What all instants of a phase of contact wrenches share, with r_l = s_l - a_l.
struct WrenchSums {
  WrenchSums(const Plan& plan, const Phase& phase, const Knot& from);

  Pull pull;
  BaseRotation turning;         ///< from the first knot
  Eigen::Vector3d rho, steady;  ///< sum mu_l r_l and sum tau_l / m - mu_l a_l x r_l
};

/// What a force law is given of an instant: the phase, the knots at its ends, and the time since it began.
struct PhaseInstant {
  const Plan& plan;
  const Phase& phase;
  const Knot& from;
  const Knot& to;
  double since_start = 0.0;            ///< [s]
  const WrenchSums* shared = nullptr;  ///< of phases of contact wrenches, where somebody has them already
};

}  // namespace mcplan
