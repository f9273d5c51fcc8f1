#pragma once

#include <optional>
#include <vector>

#include "mcplan/plan/plan.hpp"
#include "phase_instant.hpp"
#include "swing_path.hpp"

/// What every instant of a phase shares. Plan::at_phase() looks for it along the whole plan at each call; who asks for
/// many instants of a phase looks once.
namespace mcplan {

struct PhaseFrame {
  int phase = 0;
  double start_s = 0.0;
  std::vector<ActiveSwing> swings;   ///< in the plan's order
  std::optional<WrenchSums> shared;  ///< of phases of contact wrenches; without, each instant makes its own
};

/// The phase must be one of the plan's, whose sizes and indices fit together.
PhaseFrame phase_frame(const Plan& plan, int phase);

/// What Plan::at_phase() says, to the last bit.
PlanState state_in_phase(const Plan& plan, const PhaseFrame& frame, double since_start);

/// The same into a state that is used again and again, which saves its lists; r_WB is the base's orientation.
void set_state(const Plan& plan, const PhaseFrame& frame, double since_start, PlanState& state, Eigen::Matrix3d& r_WB);

/// An end-effector on its way: instants of phases in which it is free.
struct PathInstant {
  double since_lift_s = 0.0;
  PlanState state;  ///< without its swing
  ActiveSwing swing;
  double since_start_s = 0.0;  ///< of the phase
};

/// Instants of a plan's phases that the path of an end-effector has at most, shared out evenly, but not fewer than
/// kPathInstantsMin in a phase: all of a stretch are held at once, and iterates may have phases of hours.
constexpr double kPathInstantsMax = 2e4, kPathInstantsMin = 200;

/// The instants of a stretch, every sample_s [s] of each phase, less often in very long ones, of a plan whose sizes and
/// indices fit together. The swing must be the plan's for these phases; what its height makes of the path is asked for
/// later.
std::vector<PathInstant> path_of(const Plan& plan, const Swing& swing, double sample_s);

/// The end-effector at that instant, lifted by the height that the swing has now, on the straightened path.
EndEffectorState lifted(const PathInstant& instant);

}  // namespace mcplan
