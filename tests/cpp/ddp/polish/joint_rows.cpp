#include "ddp/polish/joint_rows.hpp"

#include <doctest/doctest.h>

#include "ddp/cost_terms.hpp"
#include "ddp/polish/legged_walk.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

/// Legs with knees that bear so much [N m] and turn so fast [rad/s].
mcplan::Robot with_knees(double torque, double speed) {
  mcplan::Robot robot = with_legs(0.03, -0.1);
  for (mcplan::EndEffector& end : robot.end_effectors) {
    if (!end.limb.given()) continue;
    end.limb.knee_torque = torque;
    end.limb.knee_speed = speed;
  }
  return robot;
}

struct Walk : LeggedWalk {
  Walk(const mcplan::Robot& robot, bool hold) : LeggedWalk(robot, 0.8, hold) {}

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
    for (int r = 0; r < rows.count(); ++r)
      if (rows.value(r) > 1e-3) written.push_back(rows.value(r));
    Eigen::ArrayXd r(joints.count(k));
    joints.values(motion, k, 0, r);
    for (const double value : r)
      if (value > 1e-3) found.push_back(value);
    CAPTURE(k);
    REQUIRE(found.size() == written.size());  // no leg is too long, of which there is no row here
    std::sort(found.begin(), found.end());
    std::sort(written.begin(), written.end());
    // The angles of the base are those of a cubic here.
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == doctest::Approx(written[i]).epsilon(0.02));
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
