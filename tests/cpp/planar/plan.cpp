#include "mcplan/planar/plan.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <limits>
#include <random>
#include <string>

#include "in_threads.hpp"
#include "mcplan/planar/checker.hpp"
#include "planar/robots.hpp"

namespace {

using Eigen::Vector3d;
using mcplan::PlanarPlan;
using mcplan::PlanarState;

/// At rest at both ends, something else in between; the right foot free in the second phase. Contacts drift, which no
/// formula minds.
PlanarPlan moving_plan() {
  PlanarPlan plan = planar::standing_plan();
  plan.task.phases[1].contacts.pop_back();
  plan.weights = {Eigen::Vector4d(1.0, 2.0, 0.5, 3.0), Eigen::Vector2d(1.0, 2.0), Eigen::Vector4d(1.0, 0.2, 1.0, 4.0)};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> draw(-0.2, 0.2);
  for (Eigen::Index j = 0; j < plan.control_points.rows(); ++j) {
    for (Eigen::Index i = 2; i + 2 < plan.control_points.cols(); ++i) plan.control_points(j, i) = draw(random);
    plan.control_points.row(j).head<2>().setConstant(plan.control_points(j, 2));
    plan.control_points.row(j).tail<2>().setConstant(plan.control_points(j, plan.control_points.cols() - 3));
  }
  return plan;
}

/// A base of its own that moves about.
PlanarPlan parameterised_plan() {
  PlanarPlan plan = moving_plan();
  std::mt19937 random(6);
  std::uniform_real_distribution<double> draw(-0.1, 0.1);
  plan.base_control_points.resize(3, plan.control_points.cols());
  for (double& c : plan.base_control_points.reshaped()) c = draw(random);
  return plan;
}

/// The same state from forces that are given: cubic fits of nothing, the least-norm forces of one instant.
PlanarPlan with_polynomials(PlanarPlan plan, int phase, double since_start) {
  const PlanarState state = plan.at_phase(phase, since_start);
  for (int i = 0; i < plan.task.interval_count(); ++i) {
    const auto points = plan.weights[plan.task.phase_of(i)].size();
    Eigen::MatrixXd polynomial = Eigen::MatrixXd::Zero(4, 2 * points);
    if (plan.task.phase_of(i) == phase)
      for (Eigen::Index v = 0; v < points; ++v)
        polynomial.row(0).segment<2>(2 * v) << state.forces[v].tangential, state.forces[v].normal;
    plan.force_polynomials.push_back(polynomial);
  }
  plan.force_law = mcplan::planar_laws::Polynomial();
  plan.weights.clear();
  return plan;
}

std::string field(const std::function<void(PlanarPlan&)>& mutate, PlanarPlan plan = planar::standing_plan()) {
  mutate(plan);
  try {
    plan.validate();
  } catch (const mcplan::InvalidPlan& error) {
    return error.field();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a symmetric robot at rest carries a quarter of its weight at each of four points") {
  const PlanarPlan plan = planar::standing_plan();
  const PlanarState state = plan.at(0.5);
  const double weight = plan.task.robot.mass() * plan.task.robot.gravity;
  REQUIRE(state.forces.size() == 4);
  for (const auto& force : state.forces) {
    CHECK(force.normal == doctest::Approx(weight / 4.0).epsilon(1e-12));
    CHECK(std::abs(force.tangential) < 1e-10);
    CHECK((force.force_W - Eigen::Vector2d(force.tangential, force.normal)).norm() < 1e-12);
  }
  CHECK(state.base_residual.norm() < 1e-10);
  CHECK((state.configuration.base - Vector3d(0.0, planar::hip_height(), 0.0)).norm() < 1e-14);
  for (const Vector3d& error : state.contact_error) CHECK(error.norm() < 1e-14);
  CHECK(state.angular_momentum == 0.0);
}

TEST_CASE("velocities and accelerations are those of the positions, the base's too") {
  for (const PlanarPlan& plan : {moving_plan(), parameterised_plan()}) {
    const double h = 1e-5;
    for (int phase : {0, 1, 2})
      for (double ratio : {0.1, 0.4, 0.7}) {
        const double t = ratio * plan.durations[phase];
        const auto x = [&](double when) { return plan.at_phase(phase, when).configuration; };
        const auto before = x(t - h), now = x(t), after = x(t + h);
        CHECK((now.velocity - (after.q - before.q) / (2.0 * h)).norm() < 1e-7);
        CHECK((now.acceleration - (after.velocity - before.velocity) / (2.0 * h)).norm() < 1e-5);
        CHECK((now.base_velocity - (after.base - before.base) / (2.0 * h)).norm() < 1e-7);
        CHECK((now.base_acceleration - (after.base_velocity - before.base_velocity) / (2.0 * h)).norm() < 1e-5);
      }
  }
}

TEST_CASE("errors of the contacts sum to zero where the base is computed") {
  const PlanarPlan plan = moving_plan();
  for (double t : {0.05, 0.2, 0.8, 1.1}) {
    Vector3d sum = Vector3d::Zero();
    double largest = 0.0;
    for (const Vector3d& error : plan.at(t).contact_error) {
      sum += error;
      largest = std::max(largest, error.norm());
    }
    CHECK(sum.norm() < 1e-14);
    CHECK(largest > 1e-3);
  }
  CHECK(plan.at(0.5).contact_error[0].norm() < 1e-14);  // one contact alone has none
}

TEST_CASE("least-norm forces change the momentum as the motion does") {
  const PlanarPlan plan = moving_plan();
  const double mass = plan.task.robot.mass(), h = 1e-5;
  for (int phase : {0, 1, 2}) {
    const double t = 0.4 * plan.durations[phase];
    const PlanarState now = plan.at_phase(phase, t), before = plan.at_phase(phase, t - h),
                      after = plan.at_phase(phase, t + h);
    Eigen::Vector2d sum(0.0, -mass * plan.task.robot.gravity);
    for (const auto& force : now.forces) sum += force.force_W;
    CHECK((sum - mass * (after.com_velocity_W - before.com_velocity_W) / (2.0 * h)).norm() < 1e-4);
    CHECK((now.com_velocity_W - (after.com_W - before.com_W) / (2.0 * h)).norm() < 1e-8);
    CHECK(now.base_residual.head<2>().norm() < 1e-9);
    if (phase != 1) continue;  // its one contact does not drift: forces act where they were meant to
    double moment = 0.0;
    for (const auto& force : now.forces) {
      const Eigen::Vector2d arm_W = force.position_W - now.com_W;
      moment += arm_W.x() * force.force_W.y() - arm_W.y() * force.force_W.x();
    }
    CHECK(moment == doctest::Approx((after.angular_momentum - before.angular_momentum) / (2.0 * h)).epsilon(1e-5));
    CHECK(std::abs(now.base_residual[2]) < 1e-9);
  }
}

TEST_CASE("forces that are given have the same effect as those of the least norm") {
  const PlanarPlan plan = moving_plan();
  for (int phase : {0, 1, 2}) {
    const double t = 0.6 * plan.durations[phase];
    const PlanarState wanted = plan.at_phase(phase, t), state = with_polynomials(plan, phase, t).at_phase(phase, t);
    CHECK((state.torque - wanted.torque).norm() < 1e-10);
    CHECK((state.base_residual - wanted.base_residual).norm() < 1e-10);
  }
}

TEST_CASE("the coefficients of given forces are powers of s, tangential before normal") {
  PlanarPlan plan = with_polynomials(planar::standing_plan(), 0, 0.0);
  plan.force_polynomials[1].col(4) << 1.0, 2.0, 3.0, 4.0;  // tangential force of the third point
  const double length = plan.durations[0] / 4;
  const PlanarState state = plan.at_phase(0, 1.75 * length);  // s = 0.5
  CHECK(state.forces[2].tangential == doctest::Approx(1.0 + 2.0 * 0.5 + 3.0 * 0.25 + 4.0 * 0.125));
  CHECK(state.forces[2].contact == 1);
  CHECK(state.forces[2].end_effector == planar::right_foot);
  CHECK(state.forces[2].point == 0);
}

TEST_CASE("a plan whose task was edited to have no or billions of intervals says so, and takes no memory for them") {
  PlanarPlan plan = moving_plan();
  for (int intervals : {0, -1, 1001, std::numeric_limits<int>::max()}) {
    plan.task.phases[1].intervals = intervals;
    CHECK_THROWS_WITH_AS(plan.interval_lengths(),
                         ("phases[1].intervals: must lie in [1, 1000], got " + std::to_string(intervals)).c_str(),
                         mcplan::InvalidPlanarTask);
    CHECK_THROWS_AS(plan.at(0.1), mcplan::InvalidPlanarTask);
  }
}

TEST_CASE("at() and at_phase() agree, and say which side of a boundary is meant") {
  const PlanarPlan plan = moving_plan();
  CHECK(plan.duration() == doctest::Approx(1.2));
  CHECK(plan.knot_times() == std::vector<double>{0.0, 0.3, 0.3 + 0.4, 0.3 + 0.4 + 0.5});
  CHECK(plan.interval_lengths().size() == 12);
  const double boundary = plan.knot_times()[1];
  CHECK(plan.at(boundary).phase == 1);
  CHECK(plan.at(boundary).forces.size() == 2);
  CHECK(plan.at_phase(0, plan.durations[0]).forces.size() == 4);
  CHECK(plan.at_phase(1, 0.1).time == doctest::Approx(0.4));
  CHECK((plan.at(0.4).torque - plan.at_phase(1, 0.4 - boundary).torque).norm() < 1e-12);
  CHECK(plan.at(plan.duration()).phase == 2);
  for (double t : {-1e-3, plan.duration() + 1e-3, std::nan("")}) CHECK_THROWS_AS(plan.at(t), mcplan::InvalidInput);
  CHECK_THROWS_AS(plan.at_phase(3, 0.0), mcplan::InvalidInput);
  CHECK_THROWS_AS(plan.at_phase(-1, 0.0), mcplan::InvalidInput);
  CHECK_THROWS_AS(plan.at_phase(0, 0.31), mcplan::InvalidInput);
}

TEST_CASE("a phase of a whole-body plan that lasts next to nothing can be asked for") {
  PlanarPlan plan = moving_plan();
  plan.durations[1] = 5e-324;
  for (double t : {0.0, 5e-324, 1e-9}) CHECK(plan.at_phase(1, t).phase == 1);
}

TEST_CASE("a least-norm gain needs two points apart") {
  mcplan::PlanarTask task = planar::standing();
  task.robot.end_effectors[0].points = {0.0};
  task.phases[1].contacts.pop_back();
  CHECK_THROWS_AS(least_norm_gain(task, 1, Eigen::VectorXd::Ones(1)), mcplan::InvalidPlan);
  CHECK_THROWS_AS(least_norm_gain(task, 0, Eigen::VectorXd::Ones(4)), mcplan::InvalidPlan);  // three points
  CHECK(least_norm_gain(task, 0, Eigen::VectorXd::Ones(3)).rows() == 6);
}

TEST_CASE("the field of a planar plan that does not fit is named") {
  using P = PlanarPlan;
  CHECK(field([](P&) {}) == "accepted");
  CHECK(field([](P&) {}, parameterised_plan()) == "accepted");
  CHECK(field([](P& p) { p.durations.pop_back(); }) == "durations");
  for (double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    CHECK(field([bad](P& p) { p.durations[1] = bad; }) == "durations[1]");
    CHECK(field([bad](P& p) { p.weights[2][3] = bad; }) == "weights[2][3]");
  }
  CHECK(field([](P& p) { p.control_points.conservativeResize(5, 14); }) == "control_points");
  CHECK(field([](P& p) { p.control_points.conservativeResize(4, 15); }) == "control_points");
  CHECK(field([](P& p) { p.control_points(2, 3) = NAN; }) == "control_points");
  CHECK(field([](P& p) { p.base_control_points.setZero(3, 14); }) == "base_control_points");
  CHECK(field([](P& p) { p.base_control_points.setConstant(3, 15, NAN); }) == "base_control_points");
  CHECK(field([](P& p) { p.weights.pop_back(); }) == "weights");
  CHECK(field([](P& p) { p.weights[1] = Eigen::Vector3d::Ones(); }) == "weights[1]");
  const PlanarPlan given = with_polynomials(planar::standing_plan(), 0, 0.0);
  CHECK(field([](P&) {}, given) == "accepted");
  CHECK(field([](P& p) { p.force_polynomials.pop_back(); }, given) == "force_polynomials");
  CHECK(field([](P& p) { p.force_polynomials[3].setZero(4, 7); }, given) == "force_polynomials[3]");
  CHECK(field([](P& p) { p.force_polynomials[3](0, 0) = NAN; }, given) == "force_polynomials[3]");
}

TEST_CASE("a task whose indices lead nowhere is refused before anything is evaluated") {
  PlanarPlan plan = planar::standing_plan();
  plan.task.phases[0].contacts[0].end_effector = 9;
  CHECK_THROWS_AS(plan.at(0.1), mcplan::InvalidPlanarTask);
  plan = planar::standing_plan();
  plan.task.robot.bodies[3].parent = 9;
  CHECK_THROWS_AS(plan.at(0.1), mcplan::InvalidRobot);
  CHECK_THROWS_AS(PlanarPlan().at(0.0), mcplan::InvalidPlan);
}

TEST_CASE("several threads may ask one planar plan: each gets what one alone gets") {
  for (const PlanarPlan& plan : {moving_plan(), parameterised_plan()}) {
    const auto asked = [&](int) {
      std::vector<double> out;
      for (int i = 0; i <= 100; ++i) {
        const PlanarState state = plan.at(plan.duration() * i / 100);
        out.insert(out.end(), {state.com_W.x(), state.com_W.y(), state.angular_momentum});
        for (const auto& force : state.forces) out.insert(out.end(), {force.tangential, force.normal});
      }
      for (const auto& c : check(plan).constraints) out.push_back(c.value);
      return out;
    };
    const std::vector<double> alone = asked(0);
    for (const std::vector<double>& beside_others : in_threads(4, asked)) CHECK(beside_others == alone);
  }
}
