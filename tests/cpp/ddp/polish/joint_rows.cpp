#include "ddp/polish/joint_rows.hpp"

#include <doctest/doctest.h>

#include "ddp/cost_terms.hpp"
#include "ddp/polish/interior_point.hpp"
#include "ddp/stepping_sequence.hpp"
#include "ddp/support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

/// Feet at the end of legs of two links, whose knees bear so much [N m] and turn so fast [rad/s].
mcplan::Robot with_knees(double torque, double speed) {
  mcplan::Robot robot = scenes::humanoid44();
  for (const char* name : {"right_foot", "left_foot"}) {
    mcplan::EndEffector& foot = robot.end_effectors[robot.end_effector_index(name)];
    foot.limb.hip_B = {0.0, foot.nominal_B.y(), -0.05};
    foot.limb.hip_shift = -0.1;
    foot.limb.ankle = {0.01, 0.0, 0.06};
    const double length = (foot.limb.hip_B - foot.nominal_B - foot.limb.ankle).norm() + 0.03;
    foot.limb.upper = foot.limb.lower = 0.5 * length / std::sqrt(1.0 - 0.15 * 0.15);
    foot.limb.knee_torque = torque;
    foot.limb.knee_speed = speed;
  }
  return robot;
}

/// A walk on a level floor in given steps, solved with or without its joints held.
struct Walk {
  Walk(const mcplan::Robot& robot, bool hold) : problem(scenes::flat(0.8), robot, phases(10)) {
    sequence = stepping_sequence(problem, 0);
    trajectory = problem.initial_guess(sequence);
    Tuning tuning = problem.tuning();
    tuning.hold_joints = hold;
    polish::InteriorPoint solver(problem, sequence, tuning);
    polish::Settings settings;
    settings.max_iterations = 200;
    outcome = solver.solve(trajectory, settings, nullptr);
  }

  /// The largest row [over its limit], of torques or of speeds.
  double worst(bool speeds) const {
    const polish::FixedSequence fixed(problem, sequence);
    const Pendulum pendulum(problem.layout, problem.inertia, problem.options.stiffness_input, problem.model);
    polish::Motion motion(fixed);
    motion.trajectory = trajectory;
    REQUIRE(motion.evaluate(pendulum));
    const polish::JointRows joints(fixed, pendulum, true);
    double most = -1.0;
    for (int k = 0; k < fixed.steps(); ++k) {
      Eigen::ArrayXd r(joints.count(k));
      joints.values(motion, k, 0, r);
      most = std::max(most, r.maxCoeff());
    }
    return speeds ? most * problem.units.length / problem.units.time : most;
  }

  Problem problem;
  ContactSequence sequence;
  Trajectory trajectory;
  polish::Outcome outcome;
};

}  // namespace

TEST_CASE("rows beyond their limit are those that the cost term writes") {
  const Walk walk(with_knees(60.0, 0.3), false);
  const Problem& p = walk.problem;
  const polish::FixedSequence fixed(p, walk.sequence);
  const Pendulum pendulum(p.layout, p.inertia, p.options.stiffness_input, p.model);
  polish::Motion motion(fixed);
  motion.trajectory = walk.trajectory;
  REQUIRE(motion.evaluate(pendulum));
  const polish::JointRows joints(fixed, pendulum, true);
  CHECK(polish::JointRows(fixed, pendulum, false).count(0) == 0);
  Schedule schedule;
  schedule.tuning.hold_joints = true;
  schedule.interior_weight = 1.0;
  const CostTerm& term = *cost_terms()[cost_term_index("joint_limits")];
  const Trajectory& t = walk.trajectory;
  int exceeded = 0;
  for (int k = 1; k < fixed.steps(); ++k) {  // at the very first instant the speed is not a row
    Instants instants;
    instants.of(p, pendulum, t.x[k], t.u[k]);
    StepView view{p, pendulum, schedule, k, t.x[k], &t.u[k], instants};
    Rows rows(p.layout.nz(), true);
    for (const polish::Standing& s : fixed.phase(k).standing) {
      view.look_at(s.l, s.surface, t);
      term.write(view, rows);
    }
    std::vector<double> written, found;
    for (int r = 0; r < rows.count(); ++r) written.push_back(rows.value(r));
    Eigen::ArrayXd r(joints.count(k));
    joints.values(motion, k, 0, r);
    for (const double value : r)
      if (value > 0.0) found.push_back(value);
    CAPTURE(k);
    REQUIRE(found.size() <= written.size());  // legs that are too long are rows of LegLengths here
    std::sort(written.begin(), written.end());
    for (const double value : found) {
      const auto near = std::min_element(written.begin(), written.end(),
                                         [&](double a, double b) { return std::abs(a - value) < std::abs(b - value); });
      // The angles of the base are those of a cubic here.
      CHECK(*near == doctest::Approx(value).epsilon(0.02));
    }
    exceeded += static_cast<int>(found.size());
  }
  CHECK(exceeded > 10);
}

TEST_CASE("a walk keeps to what its knees can do, which it would not without these rows") {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const double strong = Walk(with_knees(kInf, 1e3), false).worst(true);
  CHECK(strong < 0.0);
  for (const bool speeds : {true, false}) {
    CAPTURE(speeds);
    const mcplan::Robot robot = speeds ? with_knees(kInf, 0.5) : with_knees(55.0, kInf);
    const Walk free(robot, false), held(robot, true);
    CHECK(held.outcome == polish::Outcome::converged);
    CHECK(free.worst(speeds) > 5e-3);
    CHECK(held.worst(speeds) < 1e-3);
  }
}
