#pragma once

#include <optional>
#include <vector>

#include "ddp/replan/rest.hpp"
#include "mcplan/ddp/replan.hpp"
#include "mcplan/plan/plan.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

/// What a replan is given, as the planner takes it.
namespace mcplan::ddp {

/// Less than this is nothing left of a plan [s]. Chosen, far below a controller's period.
constexpr double kEnded_s = 1e-6;
/// A heading from which a command leads on [rad], and how far it leads [rad]: a goal's is at most one turn. Chosen.
constexpr double kHeadingMax = 1.1 * 3.14159265358979323846, kHeadingAhead = 0.85 * 3.14159265358979323846;

/// Throws InvalidPlan where the contacts are not one surface of the plan's scene, or -1, for each end-effector.
void require_contacts(const std::vector<int>& contacts, const Plan& previous);

/// The measured state with what it leaves out, by the contacts that are given or else planned, as indices into the
/// scene; what stands is put onto its plane, since a contact knows more than a measurement of its place. Throws
/// InvalidPlan where that is far away.
Measured completed(const Measured& measured, const Plan& previous, double t, const Scene& scene, const Robot& robot);

/// The rest and the measured state by as many whole turns further as it takes to count them as `yaw`, a measured
/// heading, does; one far from 0 is taken as the same within half a turn, since a goal's is bounded.
void count_turns_as(double yaw, Rest& rest, Measured& measured);

/// The scene with its goal's heading counted as the plan counts turns, by which the base turns least from the plan's
/// end; none where it is.
std::optional<Scene> with_goal_counted(const Scene& scene, const Plan& previous);

/// The rest on another scene than the plan's, by the names of surfaces. Throws InvalidScene where one is missing.
void rename(Rest& rest, const Scene& scene);

/// Surfaces that matter, by index: those of the rest, those measured, and those near the way to the goal.
std::vector<int> surfaces_of(const Scene& scene, const Robot& robot, const Measured& measured, const Rest& rest);

}  // namespace mcplan::ddp
