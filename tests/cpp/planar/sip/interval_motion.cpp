#include "planar/sip/interval_motion.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "interval.hpp"
#include "planar/robots.hpp"

using namespace mcplan::sip;
using mcplan::PlanarState;
using mcplan::PlanarTask;

namespace {

/// Order 12 and links that turn by some tenths of a radian: what is truncated is below these.
constexpr double kMetres = 1e-9, kNewtons = 1e-4;

Eigen::VectorXd gentle_parameters(const PlanarTask& task, const Options& options, unsigned seed) {
  Eigen::VectorXd x = random_parameters(task, options, seed);
  x.head(Layout(task, options).first_duration) *= 0.3;
  return x;
}

Options with(Forces forces, bool free_durations = true, FreeFlyer free_flyer = FreeFlyer::computed) {
  Options options;
  options.order = 12;
  options.forces = forces;
  options.free_durations = free_durations;
  options.free_flyer = free_flyer;
  return options;
}

void check_kinematics(IntervalAt& interval) {
  const auto& robot = interval.task.robot;
  for (double s : kPlaces) {
    CAPTURE(s);
    const PlanarState state = interval.exact(s);
    const auto frames = interval.frames(s);
    for (std::size_t j = 0; j < interval.motion.joints.size(); ++j)
      CHECK(interval.at(interval.motion.joints[j], s) ==
            doctest::Approx(state.configuration.q[static_cast<int>(j)]).epsilon(1e-12).scale(1.0));
    for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
      const IntervalMotion::Body& body = interval.motion.bodies[b];
      CHECK(interval.at(body.angle, s) == doctest::Approx(frames[b].angle).epsilon(1e-12).scale(1.0));
      CHECK(std::abs(interval.at(body.sine, s) - std::sin(frames[b].angle)) < kMetres);
      CHECK(std::abs(interval.at(body.cosine, s) - std::cos(frames[b].angle)) < kMetres);
      CHECK((interval.at_W(body.joint, s) - frames[b].position_W).norm() < kMetres);
      const Eigen::Vector2d com_W = planar_point(frames[b], robot.bodies[b].com_B).position_W;
      CHECK((interval.at_W(body.com, s) - com_W).norm() < kMetres);
    }
    REQUIRE(interval.motion.contacts.size() == state.contact_error.size());
    for (std::size_t i = 0; i < state.contact_error.size(); ++i) {
      const IntervalMotion::Contact& contact = interval.motion.contacts[i];
      CHECK(std::abs(interval.at(contact.error.x, s) - state.contact_error[i].x()) < kMetres);
      CHECK(std::abs(interval.at(contact.error.y, s) - state.contact_error[i].y()) < kMetres);
      CHECK(std::abs(interval.at(contact.angle_error, s) - state.contact_error[i].z()) < 1e-11);
    }
  }
}

void check_dynamics(IntervalAt& interval) {
  for (double s : kPlaces) {
    CAPTURE(s);
    const PlanarState state = interval.exact(s);
    REQUIRE(interval.motion.forces.size() == state.forces.size());
    for (std::size_t v = 0; v < state.forces.size(); ++v) {
      CHECK(std::abs(interval.at(interval.motion.forces[v].tangential, s) - state.forces[v].tangential) < kNewtons);
      CHECK(std::abs(interval.at(interval.motion.forces[v].normal, s) - state.forces[v].normal) < kNewtons);
      CHECK(interval.motion.forces[v].contact == state.forces[v].contact);
    }
    for (int j = 0; j < state.torque.size(); ++j)
      CHECK(std::abs(interval.at(interval.motion.torques[j], s) - state.torque[j]) < kNewtons);
  }
}

/// Largest difference of the torques from the exact ones for a smooth motion that is cut into this many intervals.
double torque_error(int order, int intervals) {
  PlanarTask task = planar::standing();
  task.phases.resize(1);
  task.phases[0].intervals = intervals;
  task.phases[0].contacts.pop_back();
  task.phases[0].clearances.clear();
  Options options = with(Forces::uniform);
  options.order = order;
  const Layout layout(task, options);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(layout.parameters);
  for (int i = 0; i < layout.control_points(); ++i)
    for (int j = 0; j < layout.splines; ++j)
      x[layout.control_point(j, i)] = 0.5 * std::sin(4.0 * i / layout.control_points() + j);
  x[layout.first_duration] = 1.0;
  double worst = 0.0;
  for (int k = intervals / 4; k < 3 * intervals / 4; ++k) {  // away from the rest at the ends
    IntervalAt interval(task, options, k, x);
    interval.evaluate();
    for (double s : kPlaces) {
      const PlanarState state = interval.exact(s);
      for (int j = 0; j < state.torque.size(); ++j)
        worst = std::max(worst, std::abs(interval.at(interval.motion.torques[j], s) - state.torque[j]));
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("polynomials of an interval agree with exact kinematics and dynamics") {
  for (int number : {1, 2, 3})
    for (Forces forces : {Forces::uniform, Forces::per_body, Forces::per_point, Forces::parameters})
      for (bool free : {false, true}) {
        const PlanarTask task = planar_tasks::paper_task(number);
        const Options options = with(forces, free);
        const Eigen::VectorXd x = gentle_parameters(task, options, 10 * number + free);
        const int last = task.interval_count() - 1;
        for (int k : {0, 2, 3, 5, last - 2, last}) {
          CAPTURE(task.name);
          CAPTURE(static_cast<int>(forces));
          CAPTURE(free);
          CAPTURE(k);
          IntervalAt interval(task, options, k, x);
          interval.evaluate();
          check_kinematics(interval);
          check_dynamics(interval);
          CHECK(interval.at(interval.motion.half_length, 0.0) ==
                doctest::Approx(0.5 * interval.plan.interval_lengths()[k]));
        }
      }
}

TEST_CASE("polynomials of an interval agree with a base that has splines of its own") {
  for (int number : {1, 3})
    for (bool free : {false, true}) {
      const PlanarTask task = planar_tasks::paper_task(number);
      const Options options = with(Forces::per_point, free, FreeFlyer::parameterised);
      for (int k : {1, 4, 9}) {
        IntervalAt interval(task, options, k, gentle_parameters(task, options, 7));
        REQUIRE(interval.plan.base_control_points.cols() == task.interval_count() + 3);
        interval.evaluate();
        check_kinematics(interval);
        check_dynamics(interval);
        for (const auto& contact : interval.motion.contacts) CHECK(contact.free);
      }
    }
}

TEST_CASE("a contact alone has no error, whatever the joints do") {
  const PlanarTask task = planar_tasks::walking();
  const Options options = with(Forces::uniform);
  IntervalAt interval(task, options, 4, gentle_parameters(task, options, 2));
  interval.evaluate();
  REQUIRE(interval.motion.contacts.size() == 1);
  const IntervalMotion::Contact& contact = interval.motion.contacts[0];
  CHECK(!contact.free);
  for (TaylorGraph::Node node : {contact.error.x, contact.error.y, contact.angle_error}) {
    CHECK(interval.motion.graph.coefficients(interval.work, node).norm() < 1e-12);
    CHECK(interval.motion.graph.tangents(interval.work, node).norm() < 1e-12);
  }
}

TEST_CASE("given forces: what they leave of the balance is what nothing carries") {
  const PlanarTask task = planar_tasks::cartwheel();
  const Options options = with(Forces::parameters);
  for (int k : {0, 4, 9}) {
    IntervalAt interval(task, options, k, gentle_parameters(task, options, 8));
    interval.evaluate();
    for (double s : kPlaces) {
      const PlanarState state = interval.exact(s);
      // The plan's forces act at the actual points, the program's at the expected ones.
      Eigen::Vector3d expected = state.base_residual;
      const Eigen::Vector2d to_base_W = state.configuration.base.head<2>() - interval.motion.origin_W;
      expected.z() += to_base_W.x() * expected.y() - to_base_W.y() * expected.x();
      for (const auto& force : state.forces) {
        const auto& contact = task.phases[interval.motion.local.phase].contacts[force.contact];
        const double along = task.robot.end_effectors[force.end_effector].points[force.point];
        const Eigen::Vector2d off_W =
            force.position_W - contact.position_W - along * task.surfaces[contact.surface].tangent_W();
        expected.z() += off_W.x() * force.force_W.y() - off_W.y() * force.force_W.x();
      }
      for (int i = 0; i < 3; ++i) CHECK(std::abs(interval.at(interval.motion.balance[i], s) - expected[i]) < kNewtons);
    }
  }
}

TEST_CASE("what is left out of polynomials of order n falls as the (n + 1)th power of the interval") {
  for (int order : {3, 5, 8}) {
    const double wide = torque_error(order, 12), narrow = torque_error(order, 24);
    CAPTURE(order);
    CAPTURE(narrow);
    CHECK(narrow > 1e-10);  // above rounding, else the next lines say nothing
    CHECK(std::log2(wide / narrow) > order + 0.5);
    CHECK(std::log2(wide / narrow) < order + 3.0);
  }
}

TEST_CASE("a small robot whose sole is turned against its body") {
  PlanarTask task = planar::standing();
  for (int foot : {planar::left_foot, planar::right_foot}) {
    // The same sole on a body whose axes are turned by 0.3 rad.
    auto& end = task.robot.end_effectors[foot];
    auto& body = task.robot.bodies[end.body];
    body.offset += 0.3;
    end.angle_B = -0.3;
    end.position_B = Eigen::Rotation2Dd(-0.3) * end.position_B;
    body.com_B = Eigen::Rotation2Dd(-0.3) * body.com_B;
  }
  task.validate();
  const Options options = with(Forces::per_point);
  for (int k : {0, 5, 11}) {
    IntervalAt interval(task, options, k, gentle_parameters(task, options, 3));
    interval.evaluate();
    check_kinematics(interval);
    check_dynamics(interval);
  }
}

TEST_CASE("kinematics alone has neither forces nor torques") {
  Options options = with(Forces::per_point);
  options.dynamics = false;
  const PlanarTask task = planar_tasks::cartwheel();
  IntervalAt interval(task, options, 5, gentle_parameters(task, options, 1));
  interval.evaluate();
  check_kinematics(interval);
  CHECK(interval.motion.forces.empty());
  CHECK(interval.motion.torques.empty());
}
