#include "mcplan/plan/plan.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <random>

#include "in_threads.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/base/rotation.hpp"
#include "mcplan/plan/checker.hpp"
#include "plan/point_fixtures.hpp"

namespace {

using Eigen::Vector3d;
using namespace fixtures;
using mcplan::Plan;
using mcplan::PlanState;

struct Motion {
  Vector3d com, velocity;
};

/// sum_l mu_l (p - s_l) - g, integrated in 2000 steps of RK4.
Motion integrate(const Plan& plan, int phase, double until) {
  const auto acceleration = [&](const Vector3d& p) {
    Vector3d a(0, 0, -plan.scene.gravity);
    for (const auto& contact : plan.phases[phase].contacts) a += contact.stiffness * (p - contact.anchor_W);
    return a;
  };
  Motion m{plan.knots[phase].com_W, plan.knots[phase].com_velocity_W};
  const int steps = 2000;
  const double h = until / steps;
  for (int i = 0; i < steps; ++i) {
    const Vector3d v1 = m.velocity, a1 = acceleration(m.com);
    const Vector3d v2 = v1 + h / 2 * a1, a2 = acceleration(m.com + h / 2 * v1);
    const Vector3d v3 = v1 + h / 2 * a2, a3 = acceleration(m.com + h / 2 * v2);
    const Vector3d v4 = v1 + h * a3, a4 = acceleration(m.com + h * v3);
    m.com += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    m.velocity += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return m;
}

/// Central difference of an end-effector's path against the velocity that the plan states, largest over a phase.
double velocity_error(const Plan& plan, int phase, int end, int samples = 97) {
  const double h = 1e-6, duration = plan.phases[phase].duration;
  double worst = 0.0;
  for (int i = 1; i < samples; ++i) {
    const double t = duration * i / samples;
    const auto position = [&](double tau) { return plan.at_phase(phase, tau).end_effectors[end].position_W; };
    const Vector3d difference = (position(t + h) - position(t - h)) / (2 * h);
    worst = std::max(worst, (difference - plan.at_phase(phase, t).end_effectors[end].velocity_W).norm());
  }
  return worst;
}

/// Two phases in which the right hand is free, with a moving and turning base, knots drawn from a seed.
Plan tumbling(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const auto vector = [&](double scale) { return Vector3d(scale * u(random), scale * u(random), scale * u(random)); };
  Plan plan = walk();
  plan.phases.resize(2);
  plan.knots.resize(3);
  plan.swings = {{right_hand, 0, 2, 0.3, Vector3d::UnitZ(), Vector3d::UnitY()}};
  plan.phases[0].duration = 0.3;
  plan.phases[1].duration = 0.5;
  for (auto& knot : plan.knots) {
    knot.com_velocity_W = vector(1.0);
    knot.base_rpy = vector(0.3);
    knot.base_rpy_rate = vector(0.5);
    knot.end_effector_velocities_W[right_hand] = vector(0.5);
  }
  return plan;
}

}  // namespace

TEST_CASE("the closed form is what RK4 integrates") {
  const Plan plan = walk();
  for (int k = 0; k < 12; ++k)
    for (double part : {0.3, 1.0}) {
      const double tau = part * plan.phases[k].duration;
      const PlanState state = plan.at_phase(k, tau);
      const Motion truth = integrate(plan, k, tau);
      CHECK((state.com_W - truth.com).norm() < 1e-12);
      CHECK((state.com_velocity_W - truth.velocity).norm() < 1e-11);
    }
}

TEST_CASE("forces, gravity and acceleration balance at every instant") {
  const Plan plan = walk();
  for (double t = 0.0; t < plan.duration(); t += 0.013) {
    const PlanState state = plan.at(t);
    Vector3d force(0, 0, -plan.robot.mass * plan.scene.gravity);
    for (const auto& end : state.end_effectors) force += end.force_W;
    CHECK((force - plan.robot.mass * state.com_acceleration_W).norm() < 1e-9);
  }
}

TEST_CASE("flight is a parabola") {
  const Plan plan = flight();
  const auto& from = plan.knots[0];
  for (double t : {0.0, 0.1, 0.25, 0.4}) {
    const PlanState state = plan.at(t);
    const Vector3d g(0, 0, -kGravity);
    CHECK((state.com_W - (from.com_W + t * from.com_velocity_W + 0.5 * t * t * g)).norm() < 1e-15);
    CHECK((state.com_velocity_W - (from.com_velocity_W + t * g)).norm() < 1e-14);
    CHECK(state.com_acceleration_W == g);
    for (const auto& end : state.end_effectors) CHECK(end.force_W == Vector3d::Zero());
  }
}

TEST_CASE("a phase of vanishing stiffness continues flight") {
  Plan soft = flight();
  soft.phases[0].contacts[left_foot] = {ground, 1e-13, {0, 0.1, 0}, Vector3d::Zero(), {}, {}};
  CHECK((soft.at(0.4).com_W - flight().at(0.4).com_W).norm() < 1e-13);
}

TEST_CASE("a moment is about where the end-effector is, whatever its anchor") {
  Plan plan = walk();
  mcplan::Contact& contact = plan.phases[0].contacts[left_foot];
  contact.anchor_W += Vector3d(0.02, 0.01, 0.0);
  plan.knots[1].end_effectors_W[left_foot] += Vector3d(0.0, 0.001, 0.0);
  const auto end = plan.at_phase(0, 0.3).end_effectors[left_foot];
  CHECK((end.moment_W - contact.moment_W - (contact.anchor_W - end.position_W).cross(end.force_W)).norm() < 1e-12);
}

TEST_CASE("moments turn the base, and the angular momentum with it") {
  const Plan plan = walk();
  // 0.5 N m about z for 0.4 s on 3 kg m^2.
  const PlanState state = plan.at_phase(0, 0.4);
  CHECK(state.base_rpy_rate.z() == doctest::Approx(0.5 * 0.4 / 3.0));
  CHECK(state.base_rpy.z() == doctest::Approx(0.5 * 0.5 * 0.16 / 3.0));
  CHECK(state.angular_momentum_W.z() == doctest::Approx(0.5 * 0.4));
  CHECK(state.base_quat_wxyz.isApprox(mcplan::quat_wxyz_from_rpy(state.base_rpy), 1e-15));
}

TEST_CASE("stated velocities are derivatives of the paths") {
  const Plan plan = walk();
  for (int k = 0; k < 12; ++k)
    for (int l = 0; l < 4; ++l) CHECK(velocity_error(plan, k, l) < 1e-8);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Plan free_of_the_box = tumbling(seed);
    auto& hand = free_of_the_box.robot.end_effectors[right_hand];
    hand.reach_min_B.setConstant(-9);
    hand.reach_max_B.setConstant(9);
    CAPTURE(seed);
    CHECK(velocity_error(free_of_the_box, 0, right_hand) < 1e-8);
    CHECK(velocity_error(free_of_the_box, 1, right_hand) < 1e-8);
  }
}

TEST_CASE("stated velocities are derivatives also where the reach box holds the path") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Plan plan = tumbling(seed);
    auto& hand = plan.robot.end_effectors[right_hand];
    // No room at all: the hand is fixed in the base wherever the knots leave it so.
    for (auto& knot : plan.knots)
      knot.end_effectors_W[right_hand] = knot.com_W + mcplan::rotation_from_rpy(knot.base_rpy) * hand.nominal_B;
    hand.reach_min_B = hand.nominal_B - Vector3d::Constant(1e-9);
    hand.reach_max_B = hand.nominal_B + Vector3d::Constant(1e-9);
    CAPTURE(seed);
    CHECK(velocity_error(plan, 0, right_hand) < 1e-6);
    for (double tau : {0.1, 0.2}) {
      const PlanState state = plan.at_phase(0, tau);
      const Vector3d relative = mcplan::rotation_from_rpy(state.base_rpy).transpose() *
                                (state.end_effectors[right_hand].position_W - state.com_W);
      CHECK((relative - hand.nominal_B).norm() < 1e-8);
    }
  }
}

TEST_CASE("a swing stays in the reach box between its knots") {
  Plan plan = walk();
  plan.swings[0].height = 0.3;  // the box ends 0.15 m above the nominal foot
  const auto& foot = plan.robot.end_effectors[left_foot];
  double highest = -1.0;
  for (double tau = 0.0; tau <= 0.4; tau += 0.004) {
    const PlanState state = plan.at_phase(3, tau);
    highest = std::max(highest, state.end_effectors[left_foot].position_W.z() - state.com_W.z());
  }
  CHECK(highest == doctest::Approx(foot.reach_max_B.z()).epsilon(1e-12));
}

TEST_CASE("where a swing comes to the side of the reach box and leaves it, its velocity goes on") {
  Plan plan = walk();
  plan.swings[0].height = 0.3;
  plan.knots[3].com_velocity_W.x() = 0.5;
  const auto behind = [&](const Vector3d& position, const Vector3d& com, const Vector3d& rpy) {
    return (mcplan::rotation_from_rpy(rpy).transpose() * (position - com)).x();
  };
  const auto& lift_off = plan.knots[3];
  const double side = behind(lift_off.end_effectors_W[left_foot], lift_off.com_W, lift_off.base_rpy) - 0.003;
  plan.robot.end_effectors[left_foot].reach_min_B.x() = side;  // that close, and the CoM moves on
  const double h = 1e-5;
  double fastest = 0.0, hardest = 0.0, nearest = 1.0;
  PlanState last = plan.at_phase(3, 0.0);
  CHECK(last.end_effectors[left_foot].position_W == plan.knots[3].end_effectors_W[left_foot]);
  CHECK(last.end_effectors[left_foot].velocity_W.norm() < 1e-15);
  for (int i = 1; i < 40000; ++i) {
    const PlanState state = plan.at_phase(3, i * h);
    const auto &before = last.end_effectors[left_foot], &now = state.end_effectors[left_foot];
    fastest = std::max(fastest, now.velocity_W.norm());
    hardest = std::max(hardest, (now.velocity_W - before.velocity_W).norm() / h);
    nearest = std::min(nearest, behind(now.position_W, state.com_W, state.base_rpy) - side);
    last = state;
  }
  CHECK(std::abs(nearest) < 1e-12);
  CHECK(fastest > 1.0);
  CHECK(hardest < 500.0);  // a jump of 0.5 m/s would be 50 000 m/s^2
  CHECK(velocity_error(plan, 3, left_foot, 997) < 1e-6);
}

TEST_CASE("paths and their velocities are continuous over the knots") {
  const Plan plan = walk();
  for (int k = 0; k + 1 < 12; ++k) {
    const PlanState left = plan.at_phase(k, plan.phases[k].duration), right = plan.at_phase(k + 1, 0.0);
    for (int l = 0; l < 4; ++l) {
      CHECK((left.end_effectors[l].position_W - right.end_effectors[l].position_W).norm() < 1e-14);
      CHECK((left.end_effectors[l].velocity_W - right.end_effectors[l].velocity_W).norm() < 1e-13);
    }
  }
  Plan over_two_phases = tumbling(7);
  over_two_phases.robot.end_effectors[right_hand].reach_min_B.setConstant(-9);
  over_two_phases.robot.end_effectors[right_hand].reach_max_B.setConstant(9);
  over_two_phases.knots[1].com_W = over_two_phases.at_phase(0, 0.3).com_W;
  const auto left = over_two_phases.at_phase(0, 0.3).end_effectors[right_hand];
  const auto right = over_two_phases.at_phase(1, 0.0).end_effectors[right_hand];
  CHECK((left.position_W - right.position_W).norm() < 1e-14);
  CHECK((left.velocity_W - right.velocity_W).norm() < 1e-13);
}

TEST_CASE("a swing is lifted along the normals") {
  Plan plan = walk();
  const Vector3d lift = Vector3d(0.3, 0.0, 1.0).normalized(), land = Vector3d(0.0, -0.4, 1.0).normalized();
  plan.swings[0].lift_normal_W = lift;
  plan.swings[0].land_normal_W = land;
  plan.swings[0].height = 0.05;
  Plan flat = plan;
  flat.swings[0].height = 0.0;
  const auto direction = [&](double tau) {
    return Vector3d(plan.at_phase(3, tau).end_effectors[left_foot].position_W -
                    flat.at_phase(3, tau).end_effectors[left_foot].position_W)
        .normalized();
  };
  CHECK(direction(4e-4).dot(lift) > 0.9999);
  CHECK(direction(0.4 - 4e-4).dot(land) > 0.9999);
  CHECK(plan.at_phase(3, 0.0).end_effectors[left_foot].velocity_W.norm() < 1e-15);
}

TEST_CASE("a swing between facing walls has no clearance half way and stays finite") {
  Plan plan = walk();
  plan.swings[0].lift_normal_W = Vector3d::UnitY();
  plan.swings[0].land_normal_W = -Vector3d::UnitY();
  for (double tau : {0.1, 0.2, 0.3}) {
    const auto end = plan.at_phase(3, tau).end_effectors[left_foot];
    CHECK(end.position_W.allFinite());
    CHECK(end.velocity_W.allFinite());
  }
}

TEST_CASE("at() is defined on the whole of [0, T] and nowhere else") {
  const Plan plan = walk();
  CHECK(plan.duration() == doctest::Approx(4.8));
  CHECK(plan.at(0.0).phase == 0);
  CHECK(plan.at(0.4).phase == 1);  // at a knot the phase that begins there
  CHECK(plan.at(plan.duration()).phase == 11);
  CHECK((plan.at(plan.duration()).com_W - plan.knots[12].com_W).norm() < 1e-12);
  CHECK(plan.at(1.3).time == doctest::Approx(1.3));
  CHECK(plan.at_phase(3, 0.1).time == doctest::Approx(1.3));
  for (double t : {-1e-3, 4.801, std::nan("")}) CHECK_THROWS_AS(plan.at(t), mcplan::InvalidInput);
  for (int k : {-1, 12}) CHECK_THROWS_AS(plan.at_phase(k, 0.0), mcplan::InvalidInput);
  CHECK_THROWS_AS(Plan().at(0.0), mcplan::InvalidInput);
}

TEST_CASE("a time just inside the last phase does not fall off its end") {
  const Plan plan = walk();
  CHECK(plan.at(plan.duration() + 1e-10).com_W.allFinite());
  CHECK(plan.knot_times().size() == 13);
  CHECK(plan.knot_times().back() == plan.duration());
}

TEST_CASE("the contact sequence is read row by row") {
  const auto sequence = walk().contact_sequence();
  REQUIRE(sequence.size() == 12);
  CHECK(sequence[0] == std::vector<int>{ground, ground, -1, -1});
  CHECK(sequence[1] == std::vector<int>{ground, ground, rail, -1});
  CHECK(sequence[3] == std::vector<int>{-1, ground, -1, -1});
}

TEST_CASE("under forces at points CoM and momentum run from knot to knot") {
  const Plan plan = step_on_corners();
  for (int k = 0; k < 3; ++k) {
    const PlanState begin = plan.at_phase(k, 0.0), end = plan.at_phase(k, plan.phases[k].duration);
    CHECK((begin.com_W - plan.knots[k].com_W).norm() < 1e-15);
    CHECK((end.com_W - plan.knots[k + 1].com_W).norm() < 1e-13);
    CHECK((end.com_velocity_W - plan.knots[k + 1].com_velocity_W).norm() < 1e-13);
    CHECK((end.angular_momentum_W - plan.knots[k + 1].angular_momentum_W).norm() < 1e-12);
    CHECK((end.base_rpy - plan.knots[k + 1].base_rpy).norm() < 1e-15);
    CHECK((end.base_rpy_rate - plan.knots[k + 1].base_rpy_rate).norm() < 1e-14);
  }
}

TEST_CASE("under forces at points every rate is the derivative of what it belongs to") {
  const Plan plan = step_on_corners();
  const double h = 1e-5;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 50; ++i) {
      const double t = plan.phases[k].duration * (i + 0.5) / 50;
      const PlanState before = plan.at_phase(k, t - h), at = plan.at_phase(k, t), after = plan.at_phase(k, t + h);
      CHECK(((after.com_W - before.com_W) / (2 * h) - at.com_velocity_W).norm() < 1e-7);
      CHECK(((after.base_rpy - before.base_rpy) / (2 * h) - at.base_rpy_rate).norm() < 1e-7);
      Vector3d moment = Vector3d::Zero();  // of the contacts about the CoM: what the angular momentum gains
      for (const auto& end : at.end_effectors) moment += end.moment_W + (end.position_W - at.com_W).cross(end.force_W);
      CHECK(((after.angular_momentum_W - before.angular_momentum_W) / (2 * h) - moment).norm() < 1e-3);
    }
}

TEST_CASE("a contact's force and moment are those of the forces at its points") {
  const Plan plan = step_on_corners();
  for (double t : {0.0, 0.07, 0.31, 0.62}) {
    const PlanState state = plan.at(t);
    Vector3d sum(0, 0, -plan.robot.mass * kGravity);
    for (const auto& end : state.end_effectors) {
      Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
      REQUIRE(end.points_W.size() == (end.surface < 0 ? 0 : 4));
      REQUIRE(end.point_forces_W.size() == end.points_W.size());
      for (std::size_t i = 0; i < end.points_W.size(); ++i) {
        force += end.point_forces_W[i];
        moment += (end.points_W[i] - end.position_W).cross(end.point_forces_W[i]);
      }
      CHECK((end.force_W - force).norm() < 1e-11);
      CHECK((end.moment_W - moment).norm() < 1e-11);
      sum += force;
    }
    CHECK((sum - plan.robot.mass * state.com_acceleration_W).norm() < 1e-9);
  }
}

TEST_CASE("at() rejects forces that do not fit their points instead of reading beyond them") {
  Plan plan = step_on_corners();
  plan.phases[0].intervals = 9;
  CHECK_THROWS_AS(plan.at(0.0), mcplan::InvalidPlan);
  plan.phases[0].intervals = 0;
  CHECK_THROWS_AS(plan.at(0.0), mcplan::InvalidPlan);
}

TEST_CASE("a walk without points says so, and free flight keeps what it spins") {
  for (const auto& end : walk().at(0.1).end_effectors) CHECK(end.points_W.empty());
  Plan thrown = flight();
  thrown.phases[0].law = mcplan::laws::Linear();
  thrown.phases[0].intervals = 3;
  thrown.knots[0].angular_momentum_W = {0.3, -0.2, 0.1};
  for (double t : {0.0, 0.13, 0.4}) {
    CHECK((thrown.at(t).com_W - flight().at(t).com_W).norm() < 1e-14);
    CHECK((thrown.at(t).angular_momentum_W - thrown.knots[0].angular_momentum_W).norm() < 1e-13);
  }
}

TEST_CASE("several threads may ask one plan: each gets what one alone gets") {
  for (const Plan& plan : {walk(), step_on_corners(), tumbling(7)}) {
    const auto asked = [&](int) {
      std::vector<double> out;
      const auto add = [&](const Vector3d& v) { out.insert(out.end(), v.data(), v.data() + 3); };
      for (int i = 0; i <= 200; ++i) {
        const PlanState state = plan.at(plan.duration() * i / 200);
        for (const Vector3d& v : {state.com_W, state.com_velocity_W, state.base_rpy, state.angular_momentum_W}) add(v);
        for (const auto& end : state.end_effectors) {
          add(end.position_W);
          add(end.force_W);
        }
      }
      for (const auto& c : check(plan, plan.scene, plan.robot).constraints) out.push_back(c.value);
      return out;
    };
    const std::vector<double> alone = asked(0);
    for (const std::vector<double>& beside_others : in_threads(4, asked)) CHECK(beside_others == alone);
  }
}
