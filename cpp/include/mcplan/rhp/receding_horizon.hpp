#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "mcplan/base/status.hpp"
#include "mcplan/plan/plan.hpp"
#include "mcplan/plan/report.hpp"
#include "mcplan/rhp/options.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan::rhp {

/// Where the robot is: the start of a horizon.
struct State {
  Eigen::Vector3d com_W = Eigen::Vector3d::Zero();               ///< [m]
  Eigen::Vector3d com_velocity_W = Eigen::Vector3d::Zero();      ///< [m/s]
  Eigen::Vector3d angular_momentum_W = Eigen::Vector3d::Zero();  ///< [kg m^2/s] about the CoM
  std::vector<Eigen::Vector3d> feet_W;                           ///< [m] sole centres, one per foot
  std::vector<int> surfaces;                                     ///< on which they stand
};

/// Where the step that a cycle executes comes from.
enum class StepFrom {
  none,           ///< nothing is executed
  converged,      ///< the solver converged
  iterate,        ///< the best point of a solve that was cut short, usable as it is
  previous_plan,  ///< the solve was cut short: what the last cycle with a plan of its own predicted for now, usable
};

/// A step of a solve that was cut short is usable where it keeps all constraints of its program, or the checker finds
/// no violation of more than so many tolerances.
inline constexpr double kUsableRatio = 10.0;

/// How often walk() goes on with a cycle that the time limit has cut short without a step.
inline constexpr int kFurtherCalls = 50;

/// How one cycle went.
struct Cycle {
  int index = 0;
  Status status = Status::numerical_failure;  ///< solved: converged, and the checker accepts the executed step
  std::string message;
  bool executed = false;  ///< a step was taken into the walk: step_from is not none
  StepFrom step_from = StepFrom::none;
  nlp::Solver solver = nlp::Solver::ipopt;  ///< that found it: ipopt or ipm
  int iterations = 0;
  double time_s = 0.0;           ///< wall clock, problem set up and checked included
  double evaluation_s = 0.0;     ///< of which in functions and derivatives
  double linear_solver_s = 0.0;  ///< of which in the linear solver
  int variables = 0, constraints = 0;
  double cost = 0.0;               ///< of the whole horizon, for a robot of human size
  double acceleration_cost = 0.0;  ///< executed step: integral of |acceleration|^2 [m^2/s^3]
  double momentum_cost = 0.0;      ///< executed step: integral of |L|^2
  double distance_m = 0.0;         ///< executed step: travel of the CoM along the heading
  double duration_s = 0.0;         ///< executed step
  double defect = 0.0;             ///< largest dynamics defect of the transcription, in its units
  double drift_com_m = 0.0;     ///< end of the executed step: its forces replayed in continuous time against its states
  double drift_momentum = 0.0;  ///< the same of L [kg m^2/s]
  Violation worst_violation;    ///< of the executed step; without one, of the program's best point
};

/// A walk.
struct Walk {
  Plan plan;      ///< the executed steps, one after the other
  Report report;  ///< of the worst cycle: status, message; times summed; of the whole plan: violation, warnings
  std::vector<Cycle> cycles;
  bool success = false;  ///< every step that was asked for was found

  double distance_m() const;      ///< travelled by the CoM along the heading
  double acc_per_m() const;       ///< integral of |acceleration|^2 per metre, executed steps
  double momentum_per_m() const;  ///< integral of |L|^2 per metre, executed steps
  double drift_com_m() const;     ///< largest of a cycle
  double drift_momentum() const;
};

/// Multi-fidelity receding-horizon planning of a walk on two feet (Wang et al.): one nonlinear program a cycle over
/// `lookahead` steps, of which the first is executed.
///
///     auto planner = mcplan::rhp::RecedingHorizon(scene, robot, options);
///     mcplan::rhp::Walk walk = planner.walk();
///
/// or cycle by cycle, from measured states:
///
///     while (planner.step(measured).status == mcplan::Status::solved) execute(planner.executed());
///
/// Theory: docs/theory/rhp.md. Not thread-safe.
class RecedingHorizon {
 public:
  /// The contact sequence is scene.steps; after its end the feet go on in turn on its last surface.
  /// Throws InvalidScene, InvalidRobot or InvalidOptions.
  RecedingHorizon(const Scene& scene, const Robot& robot, const Options& options = {});

  /// The contact sequence and the start are those of a plan; the walk comes to rest after its last step.
  /// Throws InvalidPlan where the plan lifts both feet at once or uses other end-effectors than feet.
  RecedingHorizon(const Scene& scene, const Robot& robot, const Plan& sequence, const Options& options = {});
  ~RecedingHorizon();
  RecedingHorizon(RecedingHorizon&&) noexcept;
  RecedingHorizon& operator=(RecedingHorizon&&) noexcept;

  /// Run all cycles that options ask for, or until one fails. One that time_limit_s cuts short without a step has not
  /// failed yet: step() is called again up to kFurtherCalls times, and no longer than the step before lasts.
  Walk walk();

  /// One cycle from where the last one ended. After one that a limit cut short without a step it goes on where that one
  /// stopped.
  Cycle step();

  /// One cycle from a measured state. Throws InvalidInput where it does not fit the robot.
  Cycle step(const State& measured);

  const State& state() const;  ///< at the start of the next cycle
  Plan executed() const;       ///< the step that the last solved cycle executes, starting from time 0
  Plan horizon() const;        ///< its whole horizon, predicted steps included, as far as they have forces
  Walk result() const;         ///< what was executed so far; a failed cycle leaves it as it was and is recorded

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mcplan::rhp
