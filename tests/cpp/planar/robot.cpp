#include "mcplan/planar/robot.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <random>

#include "mcplan/base/error.hpp"
#include "planar/robots.hpp"

namespace {

using Eigen::Vector2d;
using mcplan::PlanarConfiguration;
using mcplan::PlanarRobot;

std::string field(const std::function<void(PlanarRobot&)>& mutate) {
  PlanarRobot robot = planar::stander();
  mutate(robot);
  try {
    robot.validate();
  } catch (const mcplan::InvalidRobot& error) {
    return error.field();
  }
  return "accepted";
}

/// Smooth motion of everything, with its exact derivatives: x(t) = a + b sin(w t).
struct Swinging {
  explicit Swinging(const PlanarRobot& robot) : n(3 + robot.joint_count()), a(n), b(n), w(n) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> draw(-1.0, 1.0);
    for (int i = 0; i < n; ++i) {
      a[i] = draw(random);
      b[i] = draw(random);
      w[i] = 2.0 + draw(random);
    }
  }

  PlanarConfiguration at(double t) const {
    const Eigen::ArrayXd phase = t * w.array();
    const Eigen::VectorXd x = a.array() + b.array() * phase.sin(), v = b.array() * w.array() * phase.cos(),
                          u = -b.array() * w.array().square() * phase.sin();
    const int joints = n - 3;
    return {x.head(3), v.head(3), u.head(3), x.tail(joints), v.tail(joints), u.tail(joints)};
  }

  int n;
  Eigen::VectorXd a, b, w;
};

double energy(const PlanarRobot& robot, const PlanarConfiguration& x) {
  const auto frames = planar_kinematics(robot, x);
  double sum = 0.0;
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    const auto com = planar_point(frames[b], robot.bodies[b].com_B);
    sum += robot.bodies[b].mass * (0.5 * com.velocity_W.squaredNorm() + robot.gravity * com.position_W.y()) +
           0.5 * robot.bodies[b].inertia * com.rate * com.rate;
  }
  return sum;
}

}  // namespace

TEST_CASE("a valid planar robot is accepted, without limits too") {
  CHECK(field([](PlanarRobot&) {}) == "accepted");
  CHECK(field([](PlanarRobot& r) { r.bodies[1].torque_max = HUGE_VAL; }) == "accepted");
  CHECK(field([](PlanarRobot& r) { r.bodies[1].position_min = -HUGE_VAL; }) == "accepted");
}

TEST_CASE("the field of a planar robot that is out of its range is named") {
  using R = PlanarRobot;
  CHECK(field([](R& r) { r.bodies.clear(); }) == "bodies");
  CHECK(field([](R& r) { r.bodies[0].parent = 1; }) == "bodies[0].parent");
  CHECK(field([](R& r) { r.bodies[2].parent = 2; }) == "bodies[2].parent");
  CHECK(field([](R& r) { r.bodies[2].parent = 3; }) == "bodies[2].parent");
  CHECK(field([](R& r) { r.bodies[2].parent = -1; }) == "bodies[2].parent");
  CHECK(field([](R& r) { r.bodies[1].name = ""; }) == "bodies[1].name");
  CHECK(field([](R& r) { r.bodies[1].name = "trunk"; }) == "bodies[1].name");
  CHECK(field([](R& r) { r.bodies[1].joint_P.x() = NAN; }) == "bodies[1].joint[0]");
  CHECK(field([](R& r) { r.bodies[1].offset = HUGE_VAL; }) == "bodies[1].offset");
  CHECK(field([](R& r) { r.bodies[1].com_B.y() = NAN; }) == "bodies[1].com[1]");
  for (double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    CAPTURE(bad);
    CHECK(field([bad](R& r) { r.bodies[1].mass = bad; }) == "bodies[1].mass");
    CHECK(field([bad](R& r) { r.bodies[1].inertia = bad; }) == "bodies[1].inertia");
    CHECK(field([bad](R& r) { r.gravity = bad; }) == "gravity");
    CHECK(field([bad](R& r) { r.bodies[1].capsules[0].radius = bad; }) == "bodies[1].capsules[0].radius");
  }
  for (double bad : {0.0, -1.0, std::nan("")}) {
    CAPTURE(bad);
    CHECK(field([bad](R& r) { r.bodies[1].velocity_max = bad; }) == "bodies[1].velocity_max");
    CHECK(field([bad](R& r) { r.bodies[1].torque_max = bad; }) == "bodies[1].torque_max");
  }
  CHECK(field([](R& r) { r.bodies[1].position_max = r.bodies[1].position_min; }) == "bodies[1].position_max");
  CHECK(field([](R& r) { r.bodies[1].position_min = NAN; }) == "bodies[1].position_min");
  CHECK(field([](R& r) { r.bodies[1].capsules[0].to_B.x() = NAN; }) == "bodies[1].capsules[0].to[0]");
  CHECK(field([](R& r) { r.end_effectors.clear(); }) == "end_effectors");
  CHECK(field([](R& r) { r.end_effectors[1].name = "left_foot"; }) == "end_effectors[1].name");
  CHECK(field([](R& r) { r.end_effectors[1].body = 6; }) == "end_effectors[1].body");
  CHECK(field([](R& r) { r.end_effectors[1].body = -1; }) == "end_effectors[1].body");
  CHECK(field([](R& r) { r.end_effectors[1].position_B.x() = NAN; }) == "end_effectors[1].position[0]");
  CHECK(field([](R& r) { r.end_effectors[1].angle_B = NAN; }) == "end_effectors[1].angle");
  CHECK(field([](R& r) { r.end_effectors[1].points.clear(); }) == "end_effectors[1].points");
  CHECK(field([](R& r) { r.end_effectors[1].points = {0.1, 0.1}; }) == "end_effectors[1].points");
  CHECK(field([](R& r) { r.end_effectors[1].points[0] = NAN; }) == "end_effectors[1].points[0]");
  CHECK(field([](R& r) { r.collision_pairs[0].second = 6; }) == "collision_pairs[0]");
  CHECK(field([](R& r) { r.collision_pairs[0].second = planar::left_leg; }) == "collision_pairs[0]");
  CHECK(field([](R& r) { r.collision_pairs[0].second = planar::trunk; }) == "collision_pairs[0]");  // no capsules
}

TEST_CASE("names lead to indices, bodies to the joints above them") {
  const PlanarRobot robot = planar::stander();
  CHECK(robot.body_index("right_sole") == planar::right_sole);
  CHECK(robot.body_index("tail") == -1);
  CHECK(robot.end_effector_index("hand") == planar::hand);
  CHECK(robot.end_effector_index("tail") == -1);
  CHECK(robot.joints_to(planar::trunk).empty());
  CHECK(robot.joints_to(planar::right_sole) == std::vector<int>{2, 3});
  CHECK(robot.mass() == doctest::Approx(34.0));
}

TEST_CASE("velocities and accelerations are those of the positions") {
  const PlanarRobot robot = planar::stander();
  const Swinging motion(robot);
  const double t = 0.4, h = 1e-5;
  const auto before = planar_kinematics(robot, motion.at(t - h)), now = planar_kinematics(robot, motion.at(t)),
             after = planar_kinematics(robot, motion.at(t + h));
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    const auto tip = [&](const auto& frames) { return planar_point(frames[b], {0.3, -0.2}, 0.1); };
    CHECK((tip(now).velocity_W - (tip(after).position_W - tip(before).position_W) / (2.0 * h)).norm() < 1e-8);
    CHECK((tip(now).acceleration_W - (tip(after).velocity_W - tip(before).velocity_W) / (2.0 * h)).norm() < 1e-7);
    CHECK(std::abs(tip(now).rate - (tip(after).angle - tip(before).angle) / (2.0 * h)) < 1e-8);
    CHECK(std::abs(tip(now).angular_acceleration - (tip(after).rate - tip(before).rate) / (2.0 * h)) < 1e-7);
  }
}

TEST_CASE("torques, forces and what is left at the base together supply the change of energy") {
  const PlanarRobot robot = planar::stander();
  const Swinging motion(robot);
  const double h = 1e-5;
  for (double t : {0.0, 0.3, 1.1}) {
    const PlanarConfiguration x = motion.at(t);
    const auto frames = planar_kinematics(robot, x);
    const auto sole = planar_point(frames[planar::right_sole], {0.1, -0.05});
    const auto tip = planar_point(frames[planar::arm], {0.0, -0.2});
    const std::vector<mcplan::PlanarForce> forces{{planar::right_sole, sole.position_W, {30.0, 250.0}},
                                                  {planar::arm, tip.position_W, {-70.0, 20.0}}};
    const auto dynamics = planar_inverse_dynamics(robot, x, forces);
    const double supplied = dynamics.torque.dot(x.velocity) + dynamics.base_residual.dot(x.base_velocity) +
                            forces[0].force_W.dot(sole.velocity_W) + forces[1].force_W.dot(tip.velocity_W);
    const double change = (energy(robot, motion.at(t + h)) - energy(robot, motion.at(t - h))) / (2.0 * h);
    CHECK(supplied == doctest::Approx(change).epsilon(1e-7));
  }
}

TEST_CASE("a pendulum obeys its textbook equation") {
  PlanarRobot robot;
  robot.bodies.push_back(planar::body("base", -1, {0.0, 0.0}, 0.0, 1.0, {0.0, 0.0}, 1.0));
  robot.bodies.push_back(planar::body("rod", 0, {0.0, 0.0}, 0.0, 2.0, {0.0, -0.7}, 0.3));
  PlanarConfiguration x;
  x.q = Eigen::VectorXd::Constant(1, 0.4);
  x.velocity = Eigen::VectorXd::Constant(1, 3.0);
  x.acceleration = Eigen::VectorXd::Constant(1, -2.0);
  const double inertia = 0.3 + 2.0 * 0.7 * 0.7;
  CHECK(planar_inverse_dynamics(robot, x, {}).torque[0] ==
        doctest::Approx(inertia * -2.0 + 2.0 * 9.81 * 0.7 * std::sin(0.4)).epsilon(1e-13));
}
