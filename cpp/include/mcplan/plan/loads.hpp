#pragma once

#include <vector>

#include "mcplan/plan/plan.hpp"

namespace mcplan {

/// Largest contact force of an end-effector over a plan.
struct ContactLoad {
  int end_effector = 0;
  double force = 0.0;  ///< [weights of the robot]
  double friction =
      0.0;  ///< [-] tangential over normal force, infinite for a pull; forces below 1e-6 weights have none
};

struct Loads {
  double angular_momentum = 0.0;      ///< largest length about the CoM [kg m^2/s]
  std::vector<ContactLoad> contacts;  ///< of the end-effectors that touch something, the first to do so first
};

/// Largest values over the whole plan, looked at least every `sample_s` [s], both ends of every phase included. Throws
/// InvalidPlan where its sizes or indices do not fit together, InvalidOptions where sample_s is not positive.
Loads loads(const Plan& plan, double sample_s = 0.005);

}  // namespace mcplan
