#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mcplan/ddp/options.hpp"
#include "mcplan/plan/plan.hpp"
#include "mcplan/plan/report.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan::ddp {

/// The robot now, as a controller knows it.
struct Measured {
  /// An angular momentum of zero is made from the rates of the base's angles, an empty end_effector_yaw from the base's
  /// heading; without end_effector_velocities_W free end-effectors move as planned.
  Knot state;

  /// Surface on which each end-effector truly stands, by its index in the scene of the plan under way, -1: free; empty:
  /// the contacts that are planned at that time.
  std::vector<int> contacts;
};

/// A velocity to walk at, instead of the scene's goal.
struct VelocityCommand {
  Eigen::Vector2d velocity_B = Eigen::Vector2d::Zero();  ///< [m/s] of the CoM: ahead and to the left of the heading
  double yaw_rate = 0.0;                                 ///< [rad/s]
};

/// How to plan on from a measured state. Defaults serve a controller that asks ten times a second.
struct ReplanOptions {
  Options search;  ///< model, weights, limits, time_limit_s; what finds a sequence is not used

  /// Contacts that are due within this time are made and broken as planned, when and where. [s] of a robot of human
  /// size
  double committed_s = 0.1;

  /// Time within which what the measured state itself violates has to be made good (Plan::start_slack_s); likewise.
  double start_slack_s = 0.6;

  int phases_min = 6;  ///< the horizon never gets shorter than this: at its end the robot stands

  std::optional<VelocityCommand> command;  ///< walk on so instead of to the goal
  /// Number of phases that are planned ahead under a command. To a goal twice as many are planned anew, up to where all
  /// feet stand and have stepped; what comes later stays as it was planned.
  int horizon = 12;
  bool other_sequences = true;  ///< where the plan's own sequence does not do, try others near to it
  bool recovery_first = false;  ///< pushed, steps that catch the robot before its own sequence
  bool crossing = false;        ///< and a step of the foot in the air across the one that stands

  /// Iterations times phases, over all sequences, after which no other one is tried: a bound of the time of a call
  /// that, unlike time_limit_s, gives the same plan on any machine. The plan's own sequence gets its iterations anyway,
  /// as does what brings a plan within a limit that it misses by little, and unless this is 0, a stop, steps or a hand
  /// that catch a push, and up to three other ways to the goal.
  int max_work = 1000;

  /// The checker has accepted the plan under way, to its end. What is kept of it, on the same scene and for the same
  /// robot, is not looked at again: Report::checked_until_s says how far the checker has looked. Long plans are
  /// replanned several times faster so.
  bool previous_accepted = false;

  /// Throws InvalidOptions naming all that is out of its range.
  void validate() const;
};

/// Plan on from the state that is measured at time t [s] of a plan: the phase under way and those after it are kept as
/// they were planned where they still do, with phases added at the end as the robot goes on and steps put in or taken
/// out where the measured state asks for it.
///
/// The report says where the plan comes from (Report::plan_from), up to when it keeps all limits
/// (Report::kept_until_s), and what the measured state violates by itself (Report::start_violations). Theory:
/// docs/theory/ddp.md, "Replanning"; use: docs/replanning.md.
///
/// Throws InvalidInput where t lies outside the plan, InvalidPlan where the state does not fit the robot, InvalidScene,
/// InvalidRobot, InvalidOptions.
PlanResult replan(const Plan& previous, double t, const Measured& measured, const ReplanOptions& options = {});

/// The same on another scene or for another robot than the plan's: surfaces and end-effectors of the same names.
PlanResult replan(const Plan& previous, double t, const Measured& measured, const Scene& scene, const Robot& robot,
                  const ReplanOptions& options = {});

}  // namespace mcplan::ddp
