#include <doctest/doctest.h>

#include <cmath>

#include "planar/sip/constraints.hpp"
#include "planar/sip/interval.hpp"

using namespace mcplan::sip;
using mcplan::PlanarTask;

namespace {

Options with_margin(double margin) {
  Options options;
  options.order = 12;
  options.margin = margin;
  return options;
}

Eigen::VectorXd gentle_parameters(const PlanarTask& task, const Options& options) {
  Eigen::VectorXd x = random_parameters(task, options, 1);
  x.head(Layout(task, options).first_duration) *= 0.3;
  return x;
}

}  // namespace

TEST_CASE("joint limits hold positions, velocities and torques of the exact plan") {
  for (int number : {1, 2, 3}) {
    const PlanarTask task = planar_tasks::paper_task(number);
    const Options options = with_margin(0.05);
    IntervalAt interval(task, options, 4, gentle_parameters(task, options));
    std::vector<Limited> positions, velocities, torques;
    limit_positions(interval.motion, positions);
    limit_velocities(interval.motion, velocities);
    limit_torques(interval.motion, torques);
    REQUIRE(positions.size() == 9);
    REQUIRE(velocities.size() == 9);
    REQUIRE(torques.size() == 9);
    interval.evaluate();
    for (int j = 0; j < 9; ++j) {
      const auto& body = task.robot.bodies[j + 1];
      const double range = body.position_max - body.position_min;
      CHECK(positions[j].name == "position of " + body.name);
      CHECK(positions[j].lower == doctest::Approx(body.position_min + 0.05 * range));
      CHECK(positions[j].upper == doctest::Approx(body.position_max - 0.05 * range));
      CHECK(velocities[j].upper == doctest::Approx(0.95 * body.velocity_max));
      CHECK(velocities[j].lower == -velocities[j].upper);
      CHECK(torques[j].upper == doctest::Approx(0.95 * body.torque_max));
      CHECK(torques[j].lower == -torques[j].upper);
      // Rows of order one.
      CHECK(velocities[j].scale * velocities[j].upper == doctest::Approx(0.95));
      CHECK(torques[j].scale * torques[j].upper == doctest::Approx(0.95));
      for (double s : kPlaces) {
        const auto state = interval.exact(s);
        CHECK(interval.at(positions[j].node, s) == doctest::Approx(state.configuration.q[j]).scale(1.0));
        CHECK(std::abs(interval.at(velocities[j].node, s) - state.configuration.velocity[j]) < 1e-9);
        CHECK(std::abs(interval.at(torques[j].node, s) - state.torque[j]) < 1e-4);
      }
      // Positions and velocities are polynomials themselves: nothing is left out.
      CHECK(interval.motion.graph.order(positions[j].node) == 3);
      CHECK(interval.motion.graph.order(velocities[j].node) == 2);
    }
  }
}

TEST_CASE("a limit that is infinite has no rows; one finite side has its own") {
  PlanarTask task = planar_tasks::cartwheel();
  for (auto& body : task.robot.bodies) {
    body.position_min = -INFINITY;
    body.position_max = INFINITY;
    body.velocity_max = body.torque_max = INFINITY;
  }
  task.robot.bodies[2].position_min = -0.5;
  const Options options = with_margin(0.1);
  IntervalAt interval(task, options, 0, gentle_parameters(task, options));
  std::vector<Limited> out;
  limit_velocities(interval.motion, out);
  limit_torques(interval.motion, out);
  CHECK(out.empty());
  limit_positions(interval.motion, out);
  REQUIRE(out.size() == 1);
  CHECK(out[0].name == "position of A_lower");
  CHECK(out[0].lower == -0.5);  // there is no range of which the margin would be a share
  CHECK(out[0].upper == INFINITY);
}
