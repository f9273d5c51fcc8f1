#pragma once

#include <optional>
#include <string>

#include "mcplan/plan/report.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

/// Necessary conditions of a plan, from scene and robot alone, in microseconds: where one fails there is no plan that
/// the checker accepts, whatever the options, and the search need not begin. Each is a function of its own with its
/// proof beside it. The proofs take the checker's constraints with its published tolerances, at every instant and not
/// only at those that it looks at, and the force laws of this search. Theory: docs/theory/ddp.md, "Impossible scenes".
namespace mcplan::ddp {

/// A condition that fails, in words, and by how much.
struct Impossible {
  std::string message;
  Violation violation;
};

/// Of a contact of the goal, or of the start: it is out of the end-effector's reach. bound_stance.cpp
std::optional<Impossible> stance_out_of_reach(const Scene& scene, const Robot& robot, bool at_goal);

/// Of a contact of the start: it is beyond the end-effector's reach box by more than so many tolerances of `reach`. No
/// other plan is ruled out by that, but all of a search that begins exactly at the stance. bound_stance.cpp
std::optional<Impossible> start_beyond_reach(const Scene& scene, const Robot& robot, double tolerances);

/// Of a leg that stands at the start, or at the goal with its feet in their nominal places: it is in a solid by more
/// than so many tolerances of `clearance`. At the start all of a search that begins exactly at the stance is ruled out;
/// at the goal nothing is, since feet may stand elsewhere. bound_legs.cpp
std::optional<Impossible> leg_in_solid(const Scene& scene, const Robot& robot, bool at_goal, double tolerances);

/// Of the goal, or of the start: the trunk would be in a solid. bound_trunk.cpp
std::optional<Impossible> trunk_in_solid(const Scene& scene, const Robot& robot, bool at_goal);

/// Of a contact of the goal, or of the start: the sole would be in a solid, wherever it may stand. bound_sole.cpp
std::optional<Impossible> sole_in_solid(const Scene& scene, const Robot& robot, bool at_goal);

/// The friction cones of all surfaces together hold nothing up. bound_friction.cpp
std::optional<Impossible> slips_everywhere(const Scene& scene, const Robot& robot);

/// No step and, where flights are allowed, no jump leads from the surfaces of the start to those of the goal.
/// bound_gap.cpp
std::optional<Impossible> gap_too_wide(const Scene& scene, const Robot& robot, bool allow_flight = true);

/// Where no steps lead from the start to the goal, what flight it takes, in words; else empty. bound_gap.cpp
std::string flight_needed(const Scene& scene, const Robot& robot);

/// The first condition that fails. From a `measured` start only what holds of the goal is asked for.
std::optional<Impossible> why_impossible(const Scene& scene, const Robot& robot, bool measured,
                                         bool allow_flight = true);

/// By how much [m] an end-effector's contact at its stance may be beyond the reach box there, as the checker has it, on
/// a robot of this size (Similarity::length). bound_stance.cpp
double reach_allowed(const EndEffector& end, bool at_goal, double length);

/// Largest distance [m] of an end-effector's reach box from the CoM.
double farthest_reach(const EndEffector& end);

}  // namespace mcplan::ddp
