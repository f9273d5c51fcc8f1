#include "mcplan/planar/checker.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <limits>
#include <set>

#include "plan/name_sets.hpp"
#include "planar/robots.hpp"

namespace {

using mcplan::CheckResult;
using mcplan::PlanarPlan;
using Names = std::set<std::string>;
using P = PlanarPlan;

CheckResult checked(const std::function<void(P&)>& mutate, bool self_collision = true) {
  PlanarPlan plan = planar::standing_plan();
  mutate(plan);
  return mcplan::check(plan, {}, self_collision);
}

/// Names of what a change to the valid plan violates.
Names broken(const std::function<void(P&)>& mutate) {
  Names names;
  for (const auto& violation : checked(mutate).violations()) names.insert(violation.name);
  return names;
}

const mcplan::Violation& find(const CheckResult& result, const std::string& name) {
  for (const auto& violation : result.constraints)
    if (violation.name == name) return violation;
  throw std::out_of_range(name);
}

/// Forces of the standing plan, given; those of one interval changed.
void give_forces(P& plan, int interval, const Eigen::Matrix<double, 8, 1>& change) {
  const double weight = plan.task.robot.mass() * plan.task.robot.gravity;
  Eigen::MatrixXd polynomial = Eigen::MatrixXd::Zero(4, 8);
  for (int v = 0; v < 4; ++v) polynomial(0, 2 * v + 1) = weight / 4.0;
  plan.force_law = mcplan::planar_laws::Polynomial();
  plan.force_polynomials.assign(plan.task.interval_count(), polynomial);
  plan.force_polynomials[interval].row(0) += change.transpose();
}

Eigen::Matrix<double, 8, 1> forces(std::initializer_list<double> values) {
  Eigen::Matrix<double, 8, 1> out;
  std::copy(values.begin(), values.end(), out.data());
  return out;
}

}  // namespace

TEST_CASE("a plan that stands still is accepted; every constraint is there, measured") {
  const CheckResult result = checked([](P&) {});
  CHECK(result.to_string() == "ok");
  Names names;
  for (const auto& violation : result.constraints) names.insert(violation.name);
  CHECK(names == Names{"finite", "phase_duration", "position", "velocity", "torque", "continuity", "rest", "drift",
                       "drift_angle", "balance", "moment", "friction", "pull", "clearance", "collision", "pose"});
  CHECK(checked([](P& p) { give_forces(p, 0, forces({0, 0, 0, 0, 0, 0, 0, 0})); }).to_string() == "ok");
  // A vertical arm, its lower end 0.2 m over the leg's upper one; radii 0.03 and 0.05.
  CHECK(find(result, "collision").value == doctest::Approx(0.08 - 0.2));
  CHECK(find(result, "collision").end_effector == "left_leg and arm");
  CHECK(find(result, "pull").value == doctest::Approx(-0.25));
  CHECK(find(result, "clearance").value == doctest::Approx(0.5 - planar::hip_height() - 0.2));  // at mid-swing
  CHECK(find(result, "position").value == doctest::Approx(-0.5));
  CHECK(find(result, "velocity").value == -1.0);
}

TEST_CASE("numbers that are none and phases that last no time end the check") {
  const CheckResult result = checked([](P& p) { p.control_points(0, 3) = NAN; });
  CHECK(result.constraints.size() == 1);
  CHECK(result.worst().name == "finite");
  CHECK(broken([](P& p) { p.weights[1][0] = HUGE_VAL; }) == Names{"finite"});
  CHECK(broken([](P& p) { p.durations[1] = NAN; }) == Names{"finite"});
  for (double none : {0.0, -0.3, 1e-7}) {
    const CheckResult short_one = checked([none](P& p) { p.durations[1] = none; });
    CHECK(short_one.constraints.size() == 2);
    CHECK(short_one.worst().name == "phase_duration");
    CHECK(short_one.worst().phase == 1);
  }
}

TEST_CASE("each limit of a joint is named, with the joint") {
  const CheckResult position = checked([](P& p) { p.task.robot.bodies[planar::arm].position_max = -0.1; });
  REQUIRE(position.violations().size() == 1);
  CHECK(position.worst().name == "position");
  CHECK(position.worst().end_effector == "arm");
  CHECK(position.worst().value == doctest::Approx(0.1 / 1.4));

  const auto wave = [](P& p) { p.control_points.row(4).segment<3>(6).setConstant(0.02); };
  CHECK(broken(wave) == Names{});
  const CheckResult velocity = checked([&wave](P& p) {
    wave(p);
    p.task.robot.bodies[planar::arm].velocity_max = 0.05;
  });
  CHECK(velocity.worst().name == "velocity");
  CHECK(velocity.worst().end_effector == "arm");
  CHECK(velocity.violations().size() == 1);

  CHECK(velocity.kept_until_s > 0.0);
  CHECK(velocity.kept_until_s < velocity.worst().time_s);
  CHECK(velocity.checked_until_s > velocity.worst().time_s);
  CHECK(position.kept_until_s == 0.0);
  CHECK(checked(wave).kept_until_s == checked(wave).checked_until_s);

  const CheckResult torque = checked([](P& p) { p.task.robot.bodies[planar::right_leg].torque_max = 1.0; });
  CHECK(torque.worst().name == "torque");
  CHECK(torque.worst().end_effector == "right_leg");
  CHECK(torque.violations().size() == 1);
}

TEST_CASE("limits are relative: 1e-4 of them is tolerated, 2e-4 is not") {
  const auto stands = [](double beyond) {
    return checked([beyond](P& p) {
             p.task.robot.bodies[planar::arm].position_min = -1.0 - beyond;
             p.task.robot.bodies[planar::arm].position_max = -beyond;
           })
        .ok();
  };
  CHECK(stands(0.9e-4));
  CHECK_FALSE(stands(1.1e-4));
}

TEST_CASE("a spline that overflows is not continuous") {
  const Names names = broken([](P& p) { p.control_points(4, 7) = std::numeric_limits<double>::max(); });
  CHECK(names.count("continuity") == 1);
  CHECK(names.count("position") == 1);
}

TEST_CASE("a motion that does not begin or end at rest is named, with the end") {
  const CheckResult begin = checked([](P& p) { p.control_points(4, 0) = 1e-3; });
  CHECK(begin.violations().size() == 1);
  CHECK(begin.worst().name == "rest");
  CHECK(begin.worst().end_effector == "arm");
  CHECK(begin.worst().phase == 0);
  const CheckResult end = checked([](P& p) { p.control_points(4, 14) = 1e-3; });
  CHECK(end.worst().name == "rest");
  CHECK(end.worst().phase == 2);
  CHECK(end.worst().time_s == doctest::Approx(1.2));
}

TEST_CASE("contacts that are not where they should be are named") {
  // The left ankle turned: both soles are off by half of it, and both feet move by a little.
  const CheckResult turned = checked([](P& p) { p.control_points.row(1).setConstant(0.011); });
  CHECK(find(turned, "drift_angle").value == doctest::Approx(0.0055).epsilon(1e-6));
  CHECK(find(turned, "drift_angle").value > find(turned, "drift_angle").tolerance);
  // The left hip turned, its ankle back: feet apart by 2 mm, soles level.
  const double angle = 4e-3 / planar::kLeg;
  const CheckResult apart = checked([angle](P& p) {
    p.control_points.row(0).setConstant(-angle);
    p.control_points.row(1).setConstant(angle);
  });
  CHECK(apart.violations().size() == 1);
  CHECK(apart.worst().name == "drift");
  CHECK(apart.worst().value == doctest::Approx(2e-3).epsilon(1e-3));
  CHECK(mcplan::largest_drift(planar::standing_plan()).position_m < 1e-12);
}

TEST_CASE("forces that do not carry the robot are named") {
  const CheckResult force = checked([](P& p) { give_forces(p, 5, forces({0, 1e-6, 0, 0, 0, 0, 0, 0})); });
  CHECK(force.violations().size() == 1);
  CHECK(force.worst().name == "balance");
  CHECK(force.worst().phase == 1);
  CHECK(force.worst().value == doctest::Approx(1e-6).epsilon(1e-3));
  // From the left foot to the right one: the sum stays.
  const CheckResult moment = checked([](P& p) { give_forces(p, 5, forces({0, -5, 0, 0, 0, 0, 0, 5})); });
  CHECK(moment.violations().size() == 1);
  CHECK(moment.worst().name == "moment");
  CHECK(moment.worst().value == doctest::Approx(5.0 * 2.0 * (planar::foot_x() + planar::kHalfSole)));
}

TEST_CASE("point forces out of their cones are named, with the end-effector") {
  // The right foot's points pull against each other.
  const CheckResult friction = checked([](P& p) { give_forces(p, 5, forces({0, 0, 0, 0, 80, 0, -80, 0})); });
  CHECK(friction.violations().size() == 1);
  CHECK(friction.worst().name == "friction");
  CHECK(friction.worst().end_effector == "right_foot");
  const double weight = 34.0 * 9.81;
  CHECK(friction.worst().value == doctest::Approx((80.0 - 0.8 * weight / 4.0) / weight));
  // All weight on the inner points and 30 N more, which the outer ones pull back; the moment about the middle stays.
  const double pull = weight / 4.0 + 30.0;
  const CheckResult pulls = checked([pull](P& p) {
    give_forces(p, 5, forces({0, -pull, 0, pull, 0, pull, 0, -pull}));
  });
  CHECK(find(pulls, "pull").value == doctest::Approx(30.0 / weight));
  CHECK(pulls.violations().size() == 2);  // no friction cone holds a point that pulls
}

TEST_CASE("a swinging end-effector too low in the middle is named") {
  const double height = planar::hip_height() + 0.2;
  const CheckResult low = checked([height](P& p) { p.task.phases[2].clearances[0].middle_height = height + 0.02; });
  CHECK(low.violations().size() == 1);
  CHECK(low.worst().name == "clearance");
  CHECK(low.worst().end_effector == "hand and ground");
  CHECK(low.worst().value == doctest::Approx(0.02));
  CHECK(low.worst().time_s == doctest::Approx(0.7 + 0.25));
}

TEST_CASE("capsules that touch are named where they are asked for") {
  const auto thick = [](P& p) { p.task.robot.bodies[planar::arm].capsules[0].radius = 0.16; };
  const CheckResult result = checked(thick);
  CHECK(result.violations().size() == 1);
  CHECK(result.worst().name == "collision");
  CHECK(result.worst().value == doctest::Approx(0.01));
  CHECK(checked(thick, false).ok());
  // Segments that cross are at no distance, however far their ends are from each other.
  const CheckResult crossing = checked([](P& p) {
    p.task.robot.bodies[planar::arm].capsules[0] = {{-0.5, -0.6}, {0.5, -0.6}, 0.03};
  });
  CHECK(crossing.worst().value == doctest::Approx(0.08));
}

TEST_CASE("a pose that is missed is named, with the body and the instant") {
  const CheckResult result = checked([](P& p) { p.task.phases[1].poses[0].min.y() = planar::hip_height() + 5e-3; });
  CHECK(result.violations().size() == 1);
  CHECK(result.worst().name == "pose");
  CHECK(result.worst().end_effector == "trunk");
  CHECK(result.worst().phase == 1);
  CHECK(result.worst().time_s == doctest::Approx(0.3 + 0.3 * 0.4));
  CHECK(result.worst().value == doctest::Approx(5e-3));
}

TEST_CASE("malformed plans, tasks, robots and options are exceptions") {
  CHECK_THROWS_AS(checked([](P& p) { p.durations.pop_back(); }), mcplan::InvalidPlan);
  CHECK_THROWS_AS(checked([](P& p) { p.weights[0][0] = 0.0; }), mcplan::InvalidPlan);
  CHECK_THROWS_AS(checked([](P& p) { p.task.phases[0].contacts[0].position_W.y() = 0.1; }), mcplan::InvalidPlanarTask);
  CHECK_THROWS_AS(checked([](P& p) { p.task.robot.bodies[1].mass = 0.0; }), mcplan::InvalidRobot);
  mcplan::PlanarTolerances tolerances;
  for (double bad : {0.0, -1.0, std::nan(""), 1e-9}) {
    tolerances.sample_s = bad;
    CHECK_THROWS_AS(mcplan::check(planar::standing_plan(), tolerances), mcplan::InvalidOptions);
    CHECK_THROWS_AS(mcplan::largest_drift(planar::standing_plan(), bad), mcplan::InvalidOptions);
  }
}
