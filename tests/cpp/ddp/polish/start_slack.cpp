#include "ddp/polish/start_slack.hpp"

#include <doctest/doctest.h>

#include "ddp/polish/interior_point.hpp"
#include "ddp/stepping_sequence.hpp"
#include "ddp/support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

/// Standing with the CoM moved and pushed sideways.
struct Moved {
  explicit Moved(double by, double velocity, double horizon)
      : problem(scenes::flat(0.0), scenes::humanoid44(), phases(8)) {
    mcplan::Knot knot;
    const mcplan::ResolvedStance stance =
        mcplan::resolve_stance(problem.scene, problem.robot, problem.scene.start, "start");
    knot.com_W = stance.com_W + Eigen::Vector3d(0.0, by, 0.0);
    knot.com_velocity_W = {0.0, velocity, 0.0};
    knot.end_effectors_W = stance.end_effectors_W;
    problem.set_start(knot, problem.start_contacts);
    problem.start_slack = horizon;
  }
  Problem problem;
};

}  // namespace

TEST_CASE("the slack of a start is what its state violates as it moves on straight, and fades out") {
  const double horizon = 1.5;
  for (const double velocity : {-0.2, 0.0, 0.3}) {
    CAPTURE(velocity);
    const Moved moved(0.08, velocity, horizon);
    const Problem& p = moved.problem;
    const polish::FixedSequence fixed(p, ContactSequence(p.steps + 1, p.start_contacts));
    const Pendulum pendulum(p.layout, p.inertia, p.options.stiffness_input, p.model);
    polish::Motion motion(fixed);
    motion.trajectory = p.initial_guess(fixed.contacts());
    motion.trajectory.x[0] = p.start;
    REQUIRE(motion.evaluate(pendulum));
    const polish::StartSlack slack(fixed, motion, polish::LegLengths(fixed));
    REQUIRE(slack.any());
    for (int l = 0; l < 2; ++l)
      for (const double t : {0.0, 0.3, 0.9, 1.4, 1.6}) {
        CAPTURE(t);
        // The CoM goes on to its left, and with it every foot to the right of it, if outward.
        const double place = p.start[p.layout.end(l) + 1] - p.start[p.layout.com() + 1];
        const double v = p.start[p.layout.velocity() + 1];
        const double fade = std::max(0.0, 1.0 - t * t / (horizon * horizon));
        const double below = p.limits[l].reach_min.y() - place + std::max(v, 0.0) * t;
        const double above = place - p.limits[l].reach_max.y() + std::max(-v, 0.0) * t;
        for (const double room : {0.0, 0.02}) {
          CHECK(slack.reach(l, 3, t, room) == doctest::Approx(std::max(below + room, 0.0) * fade));
          CHECK(slack.reach(l, 2, t, room) == doctest::Approx(std::max(above + room, 0.0) * fade));
        }
      }
  }
}

TEST_CASE("without slack, or within all limits, rows stay as they are") {
  for (const bool inside : {true, false}) {
    const Moved moved(inside ? 0.0 : 0.08, 0.0, inside ? 1.0 : 0.0);
    const Problem& p = moved.problem;
    const polish::FixedSequence fixed(p, ContactSequence(p.steps + 1, p.start_contacts));
    const Pendulum pendulum(p.layout, p.inertia, p.options.stiffness_input, p.model);
    polish::Motion motion(fixed);
    motion.trajectory = p.initial_guess(fixed.contacts());
    motion.trajectory.x[0] = p.start;
    REQUIRE(motion.evaluate(pendulum));
    CHECK_FALSE(polish::StartSlack(fixed, motion, polish::LegLengths(fixed)).any());
  }
}

TEST_CASE("from a start out of reach the interior point comes back inside within the slack") {
  const double horizon = 3.0;
  const Moved moved(0.06, 0.0, horizon);
  const Problem& p = moved.problem;
  const ContactSequence sequence = stepping_sequence(p, 0);
  REQUIRE(!sequence.empty());
  polish::InteriorPoint solver(p, sequence, p.tuning());
  Trajectory trajectory = p.initial_guess(sequence);
  trajectory.x[0] = p.start;
  solver.solve(trajectory, {});
  CHECK(solver.defect() < 1e-4);
  const double margin = p.options.reach_margin_m / p.units.length;  // by which the box is planned smaller
  double time = 0.0;
  for (int k = 1; k <= p.steps; ++k) {
    time += trajectory.u[k - 1][p.layout.duration()];
    if (time < horizon) continue;
    for (int l = 0; l < 2; ++l) {
      const double place = trajectory.x[k][p.layout.end(l) + 1] - trajectory.x[k][p.layout.com() + 1];
      CHECK(place > p.limits[l].reach_min.y() - margin);
      CHECK(place < p.limits[l].reach_max.y() + margin);
    }
  }
}
