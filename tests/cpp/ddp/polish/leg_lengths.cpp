#include "ddp/polish/leg_lengths.hpp"

#include <doctest/doctest.h>

#include "ddp/polish/legged_walk.hpp"
#include "ddp/polish/start_slack.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;
using namespace mcplan::ddp;

/// In steps that nothing but the length of legs bounds.
struct Walk : LeggedWalk {
  explicit Walk(const mcplan::Robot& robot) : LeggedWalk(robot, 0.5, false) {}
};

}  // namespace

TEST_CASE("rows are distances from hip to ankle at instants that nothing else decides on") {
  for (const double shift : {0.0, -0.12}) {
    CAPTURE(shift);
    const Walk walk(with_legs(0.05, shift));
    const Problem& p = walk.problem;
    const polish::FixedSequence fixed(p, walk.sequence);
    const Pendulum pendulum(p.layout, p.inertia, p.options.stiffness_input, p.model);
    polish::Motion motion(fixed);
    motion.trajectory = walk.trajectory;
    REQUIRE(motion.evaluate(pendulum));
    const polish::LegLengths legs(fixed);
    int lifts = 0;
    for (int k = 0; k < fixed.steps(); ++k) {
      const int count = static_cast<int>(legs.rows(k).size());
      Eigen::ArrayXd r(count);
      legs.values(motion, k, 0, r);
      for (int j = 0; j < count; ++j) {
        const polish::LegLengths::Row& row = legs.rows(k)[j];
        const int l = fixed.phase(k).standing[row.contact].l;
        const mcplan::EndEffector& foot = p.robot.end_effectors[l];
        const Trajectory& t = walk.trajectory;
        const double part = static_cast<double>(row.instant) / (motion.instants() - 1);
        const polish::BodyPose& pose = motion.pose(k, row.instant);
        Vector3d from_com = foot.limb.hip_B;
        for (int m = 0; m < 2; ++m) {
          const Vector3d place = t.x[k].segment<3>(p.layout.end(m)) + part * t.u[k].segment<3>(p.layout.stride(m));
          from_com += shift * (p.units.length * pose.rotation.transpose() * (place - pose.com) -
                               p.robot.end_effectors[m].nominal_B);
        }
        const double yaw = t.sole_yaw[k][l];
        const Vector3d& ahead = foot.limb.ankle;
        const Vector3d ankle(std::cos(yaw) * ahead.x(), std::sin(yaw) * ahead.x(), ahead.z());
        const Vector3d hip = p.units.length * pose.com + pose.rotation * from_com;
        const double length = (hip - p.units.length * t.x[k].segment<3>(p.layout.end(l)) - ankle).norm();
        const double most = 2.0 * foot.limb.upper * std::sqrt(1.0 - 0.15 * 0.15) - p.options.reach_margin_m;
        CHECK(p.units.length * r[j] == doctest::Approx(length - most).epsilon(1e-9));
        if (row.instant + 1 == motion.instants()) ++lifts;
        CHECK((k > 0 || row.instant > 0));
      }
    }
    // The last instant of a contact counts where the foot leaves then, and at the end of the motion.
    int left = 0;
    for (int k = 1; k <= fixed.steps(); ++k)
      for (int l = 0; l < 2; ++l)
        if (walk.sequence[k - 1][l] != kFree && (k == fixed.steps() || walk.sequence[k][l] != walk.sequence[k - 1][l]))
          ++left;
    CHECK(lifts == left);
  }
}

TEST_CASE("a walk keeps its legs shorter than their links, which it would not without these rows") {
  // The reach boxes are the same for all of them; legs with a lot to spare do not decide.
  const Walk free(with_legs(0.3, -0.1));
  for (const double spare : {0.01, 0.02}) {
    CAPTURE(spare);
    const mcplan::Robot robot = with_legs(spare, -0.1);
    const Walk held(robot);
    CHECK(held.outcome == polish::Outcome::converged);
    const auto longest = [&](const Trajectory& t) {
      const polish::FixedSequence fixed(held.problem, held.sequence);
      const Pendulum pendulum(held.problem.layout, held.problem.inertia, held.problem.options.stiffness_input,
                              held.problem.model);
      polish::Motion motion(fixed);
      motion.trajectory = t;
      REQUIRE(motion.evaluate(pendulum));
      const polish::LegLengths legs(fixed);
      double most = -1.0;
      for (int k = 0; k < fixed.steps(); ++k) {
        Eigen::ArrayXd r(static_cast<int>(legs.rows(k).size()));
        legs.values(motion, k, 0, r);
        most = std::max(most, r.maxCoeff());
      }
      return most * held.problem.units.length;
    };
    CHECK(longest(free.trajectory) > 5e-3);
    CHECK(longest(held.trajectory) < 5e-4);
  }
}

TEST_CASE("what a start exceeds is the length of its legs, at the rate at which CoM and base go on, and fades out") {
  // Longer than the links allow from the beginning.
  const mcplan::Robot robot = with_legs(0.0, -0.1);
  Problem p(scenes::flat(0.5), robot, phases(10));
  p.start_slack = 1.5;
  const ContactSequence sequence = stepping_sequence(p, 0);
  const polish::FixedSequence fixed(p, sequence);
  const Pendulum pendulum(p.layout, p.inertia, p.options.stiffness_input, p.model);
  const polish::LegLengths legs(fixed);
  const Vector3d spin(0.0, 0.0, 0.4), velocity(0.2, -0.3, 0.1);
  polish::Motion motion(fixed);
  const auto after = [&](double time) {
    motion.trajectory = p.initial_guess(sequence);
    Eigen::VectorXd& x = motion.trajectory.x[0];
    x = p.start;
    x.segment<3>(p.layout.velocity()) = velocity;
    x.segment<3>(p.layout.com()) += time * velocity;
    for (int a = 0; a < p.layout.axis_count(); ++a) {
      x[p.layout.momentum(a)] = p.inertia[p.layout.axes()[a]] * spin[p.layout.axes()[a]];
      x[p.layout.angle(a)] += time * spin[p.layout.axes()[a]];
    }
    REQUIRE(motion.evaluate(pendulum));
  };
  constexpr double kStep = 1e-5;
  for (int l = 0; l < 2; ++l) {
    after(kStep);
    const double later = legs.at_start(motion, l, spin).value;
    after(-kStep);
    const double earlier = legs.at_start(motion, l, spin).value;
    after(0.0);
    const polish::LegLengths::AtStart now = legs.at_start(motion, l, spin);
    CHECK(now.rate == doctest::Approx((later - earlier) / (2.0 * kStep)).epsilon(1e-5));
    const polish::StartSlack slack(fixed, motion, legs);
    REQUIRE(slack.any());
    for (const double t : {0.0, 0.4, 1.2, 1.6})
      for (const double room : {0.0, 0.02}) {
        const double fade = std::max(0.0, 1.0 - t * t / (1.5 * 1.5));
        const double excess = std::max(now.value + room + std::max(now.rate, 0.0) * t, 0.0);
        CHECK(slack.leg(l, t, room) == doctest::Approx(excess * fade).epsilon(1e-6));
      }
  }
  for (int l = 2; l < p.layout.end_effector_count(); ++l)
    CHECK(polish::StartSlack(fixed, motion, legs).leg(l, 0.1, 0.02) == 0.0);
}
