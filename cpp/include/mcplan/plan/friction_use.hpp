#pragma once

#include <map>
#include <string>

#include "mcplan/plan/plan.hpp"

namespace mcplan {

/// Largest ratio of tangential to normal force [-] of every end-effector that carries one, over the whole plan, whether
/// or not its surface demands a friction cone: on a surface that may be held it says what a mere push would need.
/// Infinite where the force pulls. Of forces
/// at points their sum counts. Forces below 1e-3 N are left out; sampled every `sample_s` [s]: both for a robot of
/// human size, times the factors of the robot's Similarity. Throws InvalidPlan where sizes or indices do not fit
/// together, InvalidInput for a sampling that is not positive or too fine. Phases without a duration are left out.
std::map<std::string, double> friction_use(const Plan& plan, double sample_s = 0.005);

}  // namespace mcplan
