#pragma once

#include <cmath>

#include "ddp/polish/interior_point.hpp"
#include "ddp/stepping_sequence.hpp"
#include "ddp/support.hpp"

namespace support {

/// Feet at the end of legs of two links of one length, of which the CoM's height uses all but so much [m].
inline mcplan::Robot with_legs(double spare, double shift) {
  mcplan::Robot robot = scenes::humanoid44();
  for (const char* name : {"right_foot", "left_foot"}) {
    mcplan::EndEffector& foot = robot.end_effectors[robot.end_effector_index(name)];
    foot.limb.hip_B = {0.0, foot.nominal_B.y(), -0.05};
    foot.limb.hip_shift = shift;
    foot.limb.ankle = {0.01, 0.0, 0.06};
    const double length = (foot.limb.hip_B - foot.nominal_B - foot.limb.ankle).norm() + spare;
    foot.limb.upper = foot.limb.lower = 0.5 * length / std::sqrt(1.0 - 0.15 * 0.15);
  }
  return robot;
}

/// A walk of so many metres on a level floor in given steps, solved with or without its joints held.
struct LeggedWalk {
  LeggedWalk(const mcplan::Robot& robot, double length, bool hold_joints)
      : problem(scenes::flat(length), robot, phases(10)) {
    sequence = ddp::stepping_sequence(problem, 0);
    trajectory = problem.initial_guess(sequence);
    ddp::Tuning tuning = problem.tuning();
    tuning.hold_joints = hold_joints;
    ddp::polish::InteriorPoint solver(problem, sequence, tuning);
    ddp::polish::Settings settings;
    settings.max_iterations = 200;
    outcome = solver.solve(trajectory, settings, nullptr);
  }
  ddp::Problem problem;
  ddp::ContactSequence sequence;
  ddp::Trajectory trajectory;
  ddp::polish::Outcome outcome;
};

}  // namespace support
