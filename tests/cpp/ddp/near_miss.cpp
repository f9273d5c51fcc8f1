#include "ddp/near_miss.hpp"

#include <doctest/doctest.h>

#include "ddp/constants.hpp"
#include "ddp/moment_limits.hpp"
#include "support.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

ddp::Problem walk() { return {scenes::flat(), scenes::humanoid44(), phases(6)}; }

/// The problem after a plan that is beyond one limit by so much.
ddp::Problem after(const std::string& name, double value, ddp::Tuning* tuning = nullptr) {
  ddp::Problem problem = walk();
  ddp::Tuning own = problem.tuning();
  ddp::tighten(problem, tuning ? *tuning : own, {{name, 2, "left_foot", 0.5, value, 0.001, "m", ""}});
  return problem;
}

}  // namespace

TEST_CASE("a reach box that was left by 4 mm is planned 4 mm smaller on all sides, and one too thin keeps its middle") {
  const ddp::Problem usual = walk(), tight = after("reach", 0.004), closed = after("reach", 1.0);
  for (std::size_t l = 0; l < usual.limits.size(); ++l) {
    const ddp::EndLimits &before = usual.limits[l], &now = tight.limits[l], &none = closed.limits[l];
    CHECK(((now.reach_min - before.reach_min) * usual.units.length).isApprox(Vector3d::Constant(0.004), 1e-9));
    CHECK(((before.reach_max - now.reach_max) * usual.units.length).isApprox(Vector3d::Constant(0.004), 1e-9));
    CHECK(none.reach_min.isApprox(none.reach_max));
    CHECK(none.reach_min.isApprox(0.5 * (before.reach_min + before.reach_max)));
  }
}

TEST_CASE("legs are planned shorter, too, but never than in the nominal stance") {
  mcplan::Robot robot = scenes::humanoid44();
  for (int l : {0, 1}) {
    mcplan::EndEffector& foot = robot.end_effectors[l];
    foot.limb.hip_B = {0.0, foot.nominal_B.y(), -0.05};
    foot.limb.upper = foot.limb.lower = 0.36;
  }
  const ddp::Problem usual(scenes::flat(), robot, phases(6));
  const auto shorter_m = [&](double by) {
    ddp::Problem problem = usual;
    ddp::Tuning tuning = problem.tuning();
    ddp::tighten(problem, tuning, {{"reach", 2, "left_foot", 0.5, by, 0.001, "m", ""}});
    return (usual.limits[0].leg_max - problem.limits[0].leg_max) * usual.units.length;
  };
  const double spare_m = usual.limits[0].leg_max * usual.units.length - 0.65;
  REQUIRE(spare_m > 0.01);
  CHECK(shorter_m(0.004) == doctest::Approx(0.004));
  CHECK(shorter_m(1.0) == doctest::Approx(spare_m));
}

TEST_CASE("swings that caught an edge by 6 mm are held out of solids, with 6 mm more room") {
  const ddp::Problem usual = walk();
  ddp::Tuning tuning = usual.tuning();
  CHECK(!tuning.clear_swings);
  const ddp::Problem tight = after("clearance", 0.006, &tuning);
  CHECK(tuning.clear_swings);
  CHECK((tight.swing_room - usual.swing_room) * usual.units.length == doctest::Approx(0.006));
}

TEST_CASE("soles that are deep in a solid have come past its side: footholds go further inside, swings stay") {
  const ddp::Problem usual = walk();
  ddp::Tuning tuning = usual.tuning();
  const ddp::Problem tight = after("clearance", 0.045, &tuning);
  CHECK(tuning.clear_swings);
  CHECK(tight.swing_room == usual.swing_room);
  CHECK(tuning.extra_margin * usual.units.length ==
        doctest::Approx(ddp::kExtraMargin_m * usual.similarity.length).epsilon(1e-9));
  ddp::Tuning shallow = usual.tuning();
  after("clearance", 0.015, &shallow);
  CHECK(shallow.extra_margin == usual.tuning().extra_margin);
}

TEST_CASE("a goal that was missed weighs more, and moments keep below what exact contacts cut them to") {
  const ddp::Problem usual = walk(), tight = after("goal", 0.012);
  CHECK(tight.options.weights.rotation_end > usual.options.weights.rotation_end);
  CHECK(tight.options.weights.velocity_end > usual.options.weights.velocity_end);
  CHECK(ddp::torsion_arm(tight, 0, 0) == doctest::Approx(ddp::kTorsionSpare * ddp::torsion_arm(usual, 0, 0)));
}

TEST_CASE("friction and pressure go further inside, friction never below its half") {
  const ddp::Problem usual = walk();
  CHECK(after("friction", 0.02).friction[0] == doctest::Approx(usual.friction[0] - 0.02));
  CHECK(after("friction", 5.0).friction[0] == doctest::Approx(0.5 * usual.friction[0]));
  const ddp::Problem tight = after("center_of_pressure", 0.003);
  CHECK((tight.pressure_margin - usual.pressure_margin) * usual.units.length == doctest::Approx(0.003));
  CHECK((usual.limits[0].pressure_half - tight.limits[0].pressure_half)
            .isApprox(Eigen::Vector2d::Constant(0.003 / usual.units.length), 1e-9));
}

TEST_CASE("joints that were asked for too much are planned weaker or slower by as much, a fifth at most") {
  mcplan::Robot robot = scenes::humanoid44();
  for (int l : {0, 1}) {
    mcplan::LimbLimits& limb = robot.end_effectors[l].limb;
    limb.hip_B = robot.end_effectors[l].nominal_B + Vector3d(0.0, 0.0, 0.6);
    limb.upper = limb.lower = 0.35;
    limb.knee_torque = 200.0;
    limb.knee_speed = 10.0;
    limb.ankle_torque = {50.0, 60.0};
  }
  const ddp::Problem usual(scenes::flat(), robot, phases(6));
  const auto limb_after = [&](const std::string& name, double value) {
    ddp::Problem problem = usual;
    ddp::Tuning tuning = usual.tuning();
    ddp::tighten(problem, tuning, {{name, 2, "left_foot", 0.5, value, 0.02, "-", ""}});
    CHECK(tuning.hold_joints);
    return problem.limits[1].limb;
  };
  const mcplan::LimbLimits before = usual.limits[1].limb;
  const mcplan::LimbLimits weaker = limb_after("joint_torque", 0.05), slower = limb_after("joint_speed", 0.03);
  CHECK(weaker.knee_torque == doctest::Approx(0.95 * before.knee_torque));
  CHECK(weaker.ankle_torque.isApprox(0.95 * before.ankle_torque));
  CHECK(weaker.hip_torque == before.hip_torque);  // infinite
  CHECK(weaker.knee_speed == before.knee_speed);
  CHECK(slower.knee_speed == doctest::Approx(0.97 * before.knee_speed));
  CHECK(slower.knee_torque == before.knee_torque);
  CHECK(limb_after("joint_torque", 3.0).knee_torque == doctest::Approx(0.8 * before.knee_torque));
}

TEST_CASE("faces that cut a reach box give way with it, no further than to the nominal place") {
  const ddp::Problem usual(scenes::flat(), scenes::humanoid44_cut(), phases(6));
  for (const double by : {0.004, 1.0}) {
    ddp::Problem tight = usual;
    ddp::Tuning tuning = usual.tuning();
    ddp::tighten(tight, tuning, {{"reach", 2, "left_foot", 0.5, by, 0.001, "m", ""}});
    for (int i = 0; i < 2; ++i) {
      const ddp::EndLimits &before = usual.limits[0], &now = tight.limits[0];
      const double nominal = before.cut_A.row(i).dot(before.nominal);
      CHECK(now.cut_b[i] == doctest::Approx(by < 1.0 ? before.cut_b[i] - by / usual.units.length : nominal));
    }
  }
}

TEST_CASE("joints that were asked for too much are held, and what the search has no limit for stays") {
  ddp::Tuning tuning = walk().tuning();
  after("joint_torque", 0.05, &tuning);
  CHECK(tuning.hold_joints);
  const ddp::Problem usual = walk(), other = after("path_continuity", 0.005);
  CHECK(other.limits[0].reach_min == usual.limits[0].reach_min);
  CHECK(other.friction == usual.friction);
  CHECK(other.swing_room == usual.swing_room);
}

TEST_CASE("what a contact misses of its reach between knots is kept further inside there, all else on all sides") {
  mcplan::Plan plan;
  plan.robot = scenes::humanoid44();
  const int foot = plan.robot.end_effector_index("left_foot");
  plan.phases.resize(4);
  for (mcplan::Phase& phase : plan.phases) {
    phase.duration = 0.5;
    phase.contacts.resize(plan.robot.end_effectors.size());
    for (mcplan::Contact& contact : phase.contacts) contact.surface = 0;
  }
  plan.phases[3].contacts[foot].surface = -1;
  const ddp::Problem usual = walk();
  const auto after_miss = [&](int phase, double time_s) {
    ddp::Problem problem = walk();
    ddp::Tuning tuning = problem.tuning();
    ddp::tighten_between_knots(problem, tuning, {{"reach", phase, "left_foot", time_s, 0.004, 0.001, "m", ""}}, plan);
    return problem;
  };
  const ddp::Problem between = after_miss(2, 1.25);
  CHECK(between.reach_room * between.units.length == doctest::Approx(0.006));
  CHECK(between.limits[0].reach_min.isApprox(usual.limits[0].reach_min));
  // At a knot, and of a foot in the air, it is the box that gives way.
  for (const ddp::Problem& problem : {after_miss(2, 1.0), after_miss(2, 1.5), after_miss(3, 1.75)}) {
    CHECK(problem.reach_room == 0.0);
    CHECK(((problem.limits[0].reach_min - usual.limits[0].reach_min) * usual.units.length)
              .isApprox(Vector3d::Constant(0.004), 1e-9));
  }
}

TEST_CASE("a near miss may cost a little more once it is mended, and a walk in many phases what walks do") {
  CHECK(mcplan::ddp::dearest_mended(0.4, 18) == doctest::Approx(0.5));
  CHECK(mcplan::ddp::dearest_mended(0.4, 40) == doctest::Approx(0.5));
  CHECK(mcplan::ddp::dearest_mended(0.4, 60) == doctest::Approx(1.2));
  CHECK(mcplan::ddp::dearest_mended(4.0, 60) == doctest::Approx(5.0));
}
