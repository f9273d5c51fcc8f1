#pragma once

#include <Eigen/Core>

#include "mcplan/plan/checker.hpp"
#include "mcplan/plan/plan.hpp"
#include "rhp/horizon.hpp"
#include "rhp/walker.hpp"

namespace mcplan::rhp {

/// The first `steps` steps of a solution as a plan that starts at time 0. Under forward Euler its knots are the states
/// of the discretised motion; with linear forces they are the integral of the forces from `state` on.
Plan executed_plan(const Walker& walker, const State& state, const Horizon& horizon, const Eigen::VectorXd& x,
                   int steps);

/// Step `step` of a plan made by executed_plan, by its forces alone, from another state on; it claims to keep the
/// limits of the angular momentum, whatever the model that it was planned with.
Plan predicted_step(const Walker& walker, const State& state, const Plan& horizon, int step);

/// Whether a step may be executed though it is none of a converged program: nothing is beyond kUsableRatio tolerances.
bool usable(const CheckResult& found);

/// Where a plan made by executed_plan ends.
State end_of(const Walker& walker, const Plan& plan);

/// Append a plan that starts where the other one ends.
void append_plan(Plan& plan, const Plan& next);

/// Integrals over a plan of the squares of the CoM's acceleration [m^2/s^3] and of the angular momentum.
struct RunningCost {
  double acceleration = 0.0, momentum = 0.0;
};
RunningCost running_cost(const Walker& walker, const Plan& plan);

/// Running cost of the executed step and how far a replay of its forces is from the solution's states at its end.
struct Measures {
  double acceleration_cost = 0.0, momentum_cost = 0.0;
  double drift_com_m = 0.0, drift_momentum = 0.0;
  double defect = 0.0;  ///< largest residual of an equality of the whole horizon
};
Measures measure(const Walker& walker, const State& state, const Horizon& horizon, const Eigen::VectorXd& x,
                 const Plan& executed);

}  // namespace mcplan::rhp
