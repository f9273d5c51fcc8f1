#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "ddp/problem.hpp"
#include "ddp/replan/rest.hpp"
#include "ddp/search.hpp"
#include "mcplan/base/deadline.hpp"
#include "mcplan/plan/checker.hpp"

namespace mcplan::ddp {

/// What all trials of one replan share.
struct Now {
  const Scene* scene;  ///< with the goal that is in force
  const Robot* robot;
  const ReplanOptions* options;
  const Deadline* deadline;
  Measured measured;          ///< contacts given, on their planes
  std::vector<int> surfaces;  ///< that are looked at, by index in the scene, ascending
  Similarity similarity;
  Eigen::Vector3d pushed_W = Eigen::Vector3d::Zero();  ///< [m/s] velocity of the CoM, measured minus planned
  std::vector<Swing> under_way = {};                   ///< of the plan under way, for what is in the air
  std::vector<Eigen::Vector3d> normals_W = {};         ///< of its soles
  const Robot* given_robot = nullptr;  ///< whose the plan is, where it is planned with narrower limits than its own
};

/// A sequence that was tried from the measured state, and what came of it.
struct Trial {
  Plan plan;
  CheckResult check;
  Evaluation evaluation;
  bool exact = false;    ///< the dynamics hold to rounding
  bool planned = false;  ///< nothing was solved: what was planned
  bool coarse = false;   ///< looked at in few instants, which was enough to see that it exceeds limits
  Ending ending = Ending::done;
  int phases = 0;                                                    ///< that are new
  int work = 0;                                                      ///< iterations times phases
  double accepted_from_s = std::numeric_limits<double>::infinity();  ///< what comes later was accepted before
  /// Time [s] until which the checker has to look at it.
  double to_be_seen_s() const { return std::min(plan.duration(), accepted_from_s); }
  /// Whether it has.
  bool seen_in_full() const { return check.complete && !(check.checked_until_s < to_be_seen_s()); }
  /// Time [s] until which it is known to keep all limits.
  double kept_until_s() const { return ok() ? plan.duration() : check.kept_until_s; }
  /// The checker has seen all of it and accepts it.
  bool ok() const { return exact && !planned && check.ok() && seen_in_full(); }
};

/// A plan that is gone on from, and what is done about what was wrong with it.
struct Again {
  Plan from;
  bool hold_joints = false;            ///< rows for the limits of joints, which cost time
  std::vector<Violation> missed = {};  ///< limits that are planned so much further inside
};

/// The optimum of a sequence from the measured state after so many iterations at most, as a plan, checked; none where
/// the scene's rules do not allow it. With `again`, from a plan that was found so.
std::optional<Trial> try_out(const Now& now, const Rest& rest, Report& report, int iterations,
                             const Again* again = nullptr);

/// Have the checker look at all instants of a plan that has been looked at in few, if there is time.
void look_closely(Trial& trial, const Now& now);

/// Whether rows for the limits of joints may mend what is wrong with it. (Those of speed do not: what a start
/// violates.)
bool asks_too_much_of_joints(const Trial& trial);

/// Whether it is acceptable, though not accepted: planned a little further inside of its limits it may be.
bool misses_by_little(const Trial& trial, double tolerances);

/// Whether it exceeds a limit from this phase on.
bool misses_from(const Trial& trial, int phase);

/// Whether it is so far from its limits that another step does not help either.
bool hopeless(const Trial& trial);

/// What is left of the plan under way, as it was planned, from the planned state: looked at for the next two steps.
Trial as_planned(const Rest& planned, const Now& now);

/// Whether the next two steps keep all limits.
bool can_be_followed(const Trial& trial);

/// Whether a controller rather follows the one than the other: anything before a trial that time has left no plan of.
bool better(const Trial& one, const Trial& other);

}  // namespace mcplan::ddp
