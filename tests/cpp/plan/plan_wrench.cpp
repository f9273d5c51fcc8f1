#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <random>

#include "mcplan/base/error.hpp"
#include "mcplan/plan/plan.hpp"
#include "plan/point_fixtures.hpp"
#include "plan/wrench_fixtures.hpp"

namespace {

using namespace fixtures;
using mcplan::Plan;
using mcplan::PlanState;

/// A phase with three contacts and moments drawn from a seed, whose stiffnesses add up to `stiffness`.
Plan drawn(unsigned seed, double stiffness) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const auto vector = [&](double scale) { return Vector3d(scale * u(random), scale * u(random), scale * u(random)); };
  Plan plan = flight();
  plan.phases[0].law = mcplan::laws::Wrench();
  mcplan::Knot& from = plan.knots[0];
  from.com_W += vector(0.2);
  from.com_velocity_W = vector(1.0);
  from.angular_momentum_W = vector(3.0);
  from.base_rpy = vector(0.3);
  const double share[] = {0.5, 0.2, 0.3};
  for (int l = 0; l < 3; ++l) {
    mcplan::Contact& contact = plan.phases[0].contacts[l];
    contact.surface = ground;
    contact.stiffness = stiffness * share[l];
    contact.center_of_pressure_W = from.end_effectors_W[l] + vector(0.1);
    contact.anchor_W = contact.center_of_pressure_W + vector(0.2);
    contact.moment_W = vector(5.0);
  }
  plan.knots[1] = from;
  return plan;
}

}  // namespace

TEST_CASE("CoM, velocity and angular momentum are what RK4 integrates from the forces, stiff, soft, none or negative") {
  for (double stiffness : {30.0, 14.0, 1.0, 1e-3, 1e-8, 1e-13, 0.0, -1e-8, -0.5, -14.0})
    for (unsigned seed = 1; seed <= 4; ++seed)
      for (double part : {0.37, 1.0}) {
        CAPTURE(stiffness);
        CAPTURE(seed);
        const Plan plan = drawn(seed, stiffness);
        const double t = part * plan.phases[0].duration;
        const PlanState state = plan.at_phase(0, t);
        const Body truth = integrate_wrenches(plan, 0, t);
        CHECK((state.com_W - truth.com).norm() < 1e-10);
        CHECK((state.com_velocity_W - truth.velocity).norm() < 1e-10);
        CHECK((state.angular_momentum_W - truth.momentum).norm() < 1e-10);
        // The rates are those of the momentum in the orientation that is stated.
        const Matrix3d r = mcplan::rotation_from_rpy(state.base_rpy);
        const Vector3d omega = r * (r.transpose() * state.angular_momentum_W).cwiseQuotient(plan.robot.inertia);
        CHECK((turning_axes(state.base_rpy) * state.base_rpy_rate - omega).norm() < 1e-12);
      }
}

TEST_CASE("the orientation of the base follows a fine integration of the walk to a hundredth of a degree") {
  const Plan plan = wrench_walk();
  for (int k = 0; k < 12; ++k)
    for (double part : {0.5, 1.0}) {
      const double t = part * plan.phases[k].duration;
      const Body truth = integrate_wrenches(plan, k, t);
      CHECK(angle_between(mcplan::rotation_from_rpy(plan.at_phase(k, t).base_rpy), truth.turned) < 2e-4);
    }
}

TEST_CASE("contact forces and moments at an instant are the rates of momentum, of contacts that slip as well") {
  Plan plan = drawn(5, 14.0);
  plan.knots[0].end_effector_velocities_W[1] = {0.3, -0.2, 0.1};
  plan.knots[1].end_effectors_W[2] += Vector3d(0.02, 0.01, 0.0);
  const double h = 1e-5;
  for (double t : {0.05, 0.2, 0.35}) {
    const PlanState before = plan.at_phase(0, t - h), at = plan.at_phase(0, t), after = plan.at_phase(0, t + h);
    Vector3d force(0, 0, -plan.robot.mass * kGravity), moment = Vector3d::Zero();
    for (const auto& end : at.end_effectors) {
      force += end.force_W;
      moment += end.moment_W + (end.position_W - at.com_W).cross(end.force_W);
    }
    CHECK((force - plan.robot.mass * at.com_acceleration_W).norm() < 1e-9);
    CHECK((plan.robot.mass * (after.com_velocity_W - before.com_velocity_W) / (2 * h) - force).norm() < 1e-5);
    CHECK(((after.angular_momentum_W - before.angular_momentum_W) / (2 * h) - moment).norm() < 1e-5);
  }
}

TEST_CASE("a contact says where its force acts, and a free end-effector where it is") {
  const Plan plan = wrench_walk();
  const PlanState state = plan.at_phase(3, 0.17);
  CHECK(state.end_effectors[right_foot].center_of_pressure_W ==
        plan.phases[3].contacts[right_foot].center_of_pressure_W);
  CHECK(state.end_effectors[left_foot].center_of_pressure_W == state.end_effectors[left_foot].position_W);
}

TEST_CASE("in flight the momentum stays, and a body that tumbles keeps its energy") {
  const Vector3d inertia(1.0, 3.0, 2.0), momentum(0.6, 0.9, 0.4);
  const Plan plan = spinning_flight(momentum, inertia);
  const auto energy = [](const PlanState& state) {
    return 0.5 * state.angular_momentum_W.dot(turning_axes(state.base_rpy) * state.base_rpy_rate);
  };
  const double before = energy(plan.at(0.0));
  for (double t : {0.1, 0.2, 0.3, 0.4}) {
    CHECK(plan.at(t).angular_momentum_W == momentum);
    CHECK(energy(plan.at(t)) == doctest::Approx(before).epsilon(1e-4));
  }
  CHECK(plan.at(0.4).base_rpy.norm() > 0.2);
}

TEST_CASE("without a line offset and moments contact wrenches are the pendulum") {
  Plan wrenches = walk();
  for (auto& phase : wrenches.phases)
    for (auto& contact : phase.contacts) contact.moment_W.setZero();
  const Plan pendulum = wrenches;
  give_wrenches(wrenches);
  for (double t = 0.0; t < 4.8; t += 0.11) {
    CHECK(wrenches.at(t).com_W == pendulum.at(t).com_W);
    CHECK(wrenches.at(t).com_velocity_W == pendulum.at(t).com_velocity_W);
    CHECK(wrenches.at(t).angular_momentum_W.norm() < 1e-12);
  }
}

TEST_CASE("a sole heads where its knots say, at rest at both ends, and without headings where the base does") {
  Plan plan = wrench_walk();
  for (int k = 4; k <= 12; ++k) plan.knots[k].end_effector_yaw[left_foot] = 0.3;
  const auto yaw = [&](double t) { return plan.at_phase(3, t).end_effectors[left_foot].yaw; };
  CHECK(yaw(0.0) == 0.0);
  CHECK(yaw(0.2) == doctest::Approx(0.15));
  CHECK(yaw(0.4) == doctest::Approx(0.3));
  CHECK(std::abs(yaw(0.004) - yaw(0.0)) < 1e-5);
  CHECK(plan.at_phase(5, 0.1).end_effectors[left_foot].yaw == 0.3);
  for (auto& knot : plan.knots) knot.end_effector_yaw.clear();
  const PlanState state = plan.at(0.4);
  CHECK(state.base_rpy.z() > 0.03);
  for (const auto& end : state.end_effectors) CHECK(end.yaw == state.base_rpy.z());
}

TEST_CASE("forces at points have no moment along the surface about their centre of pressure") {
  const Plan plan = step_on_corners();
  for (double t : {0.0, 0.07, 0.31, 0.62})
    for (const auto& end : plan.at(t).end_effectors) {
      if (end.points_W.empty()) {
        CHECK(end.center_of_pressure_W == end.position_W);
        continue;
      }
      Vector3d moment = Vector3d::Zero();
      for (std::size_t i = 0; i < end.points_W.size(); ++i)
        moment += (end.points_W[i] - end.center_of_pressure_W).cross(end.point_forces_W[i]);
      CHECK(moment.head<2>().norm() < 1e-10);
      CHECK((end.center_of_pressure_W - end.position_W).norm() > 1e-4);
    }
}

TEST_CASE("points that do not press have no centre of pressure but the end-effector's place") {
  Plan plan = step_on_corners();
  for (auto& force : plan.phases[0].contacts[left_foot].point_forces_W) force.setZero();
  CHECK(plan.at(0.1).end_effectors[left_foot].center_of_pressure_W == plan.knots[0].end_effectors_W[left_foot]);
}
