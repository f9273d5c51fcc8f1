#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mcplan/ddp/replan.hpp"
#include "mcplan/online/felt_push.hpp"
#include "mcplan/online/planned_height.hpp"
#include "mcplan/online/planned_turn.hpp"

namespace mcplan::online {

/// What a state estimator says at an instant.
struct MeasuredState {
  double time_s = 0.0;     ///< on the clock of the controller
  ddp::Measured measured;  ///< the robot, and the surfaces that it touches
  FeltPush push;           ///< of a PushObserver; none unless it is given
};

/// What came of a replan.
struct Update {
  /// The new plan and how its solve went; its time begins at begins_s. None where the state was refused: `error` says
  /// why.
  std::optional<PlanResult> result;
  std::string error;
  double begins_s = 0.0;      ///< time of the clock at which the plan begins: that of the measured state
  double took_s = 0.0;        ///< wall clock of the computation
  double kept_until_s = 0.0;  ///< time of the clock until which all limits are kept
  /// What the plan's CoM is beside the robot's: references of the CoM are the plan's less this (com_shift_W()) [m].
  Eigen::Vector3d com_shift_W = Eigen::Vector3d::Zero();
  bool usable = false;       ///< whether to follow it rather than the plan under way: follows()
  std::uint64_t ticket = 0;  ///< number of the submitted state, counted from 1
};

/// Those of a replan beside a controller: steps that catch a push come first, since while the robot is pushed every new
/// plan takes the push for over.
inline ddp::ReplanOptions beside_a_controller() {
  ddp::ReplanOptions options;
  options.recovery_first = true;
  return options;
}

/// How to replan beside a controller.
struct PlannerOptions {
  ddp::ReplanOptions replan = beside_a_controller();  ///< its command holds until it is changed,
                                                      ///< previous_accepted for the first plan
  double period_s = 0.1;                              ///< how often states are submitted
  double height_margin_m = kHeightMargin_m;           ///< up to which plans begin at the planned height, 0: as measured
  double turn_margin_rad_s = kTurnMargin_rad_s;       ///< of what the base turns otherwise than planned, left out

  /// Throws InvalidOptions naming all that is out of its range.
  void validate() const;
};

/// Replans from measured states in a thread of its own.
///
/// A state that is submitted while the planner computes waits, and replaces one that waits already. Plans are made from
/// the plan under way, which is what take_over() said last; feet in the air are kept up (with_feet_kept_up()). All
/// functions may be called from any thread. submit(), poll(), take_over() and what changes commands hold a lock for as
/// long as a state or a plan is copied or moved, some microseconds; none waits for a computation, but for wait() and
/// the destructor. How to wire it to a robot: docs/online.md, "On a robot".
class Planner {
 public:
  /// Begins with a plan that began at begins_s on the clock of the controller. Throws InvalidOptions,
  /// InvalidPlan, InvalidInput.
  explicit Planner(Plan plan, double begins_s = 0.0, PlannerOptions options = {});

  /// Ends the computation under way at its next iteration, and the thread.
  ~Planner();
  Planner(const Planner&) = delete;
  Planner& operator=(const Planner&) = delete;

  /// Asks for a plan from a measured state. Returns the number that its update will have, unless a later state
  /// replaces this one.
  std::uint64_t submit(MeasuredState state);

  /// The latest update that has not been handed out yet, if there is one.
  std::optional<Update> poll();

  /// The same, after whatever was submitted is computed, or so much time [s] is over.
  std::optional<Update> wait(double timeout_s = std::numeric_limits<double>::infinity());

  /// The controller follows this update from now on: the next plans are made from it. What was solved is not looked at
  /// again (ReplanOptions::previous_accepted), so that a plan may be changed by its caller only with another status.
  /// Throws InvalidInput where it has no plan, InvalidPlan.
  void take_over(const Update& update);

  /// What holds for computations that begin from now on: the velocity to walk at, none: to the scene's goal; the scene,
  /// for ground that was measured anew, none: the plan's own; robots to plan for, one after the other until a plan is
  /// usable, none: the first plan's own.
  void set_command(std::optional<ddp::VelocityCommand> command);
  void set_scene(std::optional<Scene> scene);
  void set_robots(std::vector<Robot> robots);

  Plan plan() const;        ///< the plan under way
  double begins_s() const;  ///< when it began, on the clock of the controller
  bool busy() const;        ///< whether a state waits or is computed from

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace mcplan::online
