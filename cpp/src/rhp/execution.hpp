#pragma once

#include <Eigen/Core>

#include "mcplan/plan/plan.hpp"
#include "rhp/horizon.hpp"
#include "rhp/walker.hpp"

namespace mcplan::rhp {

/// The first `steps` steps of a solution as a plan that starts at time 0. Under forward Euler its knots are the states
/// of the discretised motion; with linear forces they are the integral of the forces from `state` on.
Plan executed_plan(const Walker& walker, const State& state, const Horizon& horizon, const Eigen::VectorXd& x,
                   int steps);

/// Where a plan made by executed_plan ends.
State end_of(const Walker& walker, const Plan& plan);

/// Append a plan that starts where the other one ends.
void append_plan(Plan& plan, const Plan& next);

/// Running cost of the executed step and how far a replay of its forces is from the solution's states at its end.
struct Measures {
  double acceleration_cost = 0.0, momentum_cost = 0.0;
  double drift_com_m = 0.0, drift_momentum = 0.0;
  double defect = 0.0;  ///< largest residual of an equality of the whole horizon
};
Measures measure(const Walker& walker, const State& state, const Horizon& horizon, const Eigen::VectorXd& x,
                 const Plan& executed);

}  // namespace mcplan::rhp
