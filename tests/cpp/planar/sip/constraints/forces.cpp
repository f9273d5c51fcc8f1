#include <doctest/doctest.h>

#include <cmath>

#include "planar/sip/constraints.hpp"
#include "planar/sip/interval.hpp"

using namespace mcplan::sip;
using mcplan::PlanarTask;

namespace {

Options with(Forces forces) {
  Options options;
  options.order = 12;
  options.forces = forces;
  return options;
}

Eigen::VectorXd gentle_parameters(const PlanarTask& task, const Options& options) {
  Eigen::VectorXd x = random_parameters(task, options, 2);
  x.head(Layout(task, options).first_duration) *= 0.3;
  return x;
}

}  // namespace

TEST_CASE("the cone has two rows for each point: the room on both sides") {
  PlanarTask task = planar_tasks::climbing();
  task.surfaces[0].friction = 0.7;
  task.surfaces[1].friction = 1.3;
  Options options = with(Forces::per_point);
  options.margin = 0.01;
  const double weight = task.robot.mass() * task.robot.gravity;
  for (int k : {0, 4}) {  // three contacts, two contacts
    IntervalAt interval(task, options, k, gentle_parameters(task, options));
    std::vector<Limited> out;
    keep_in_friction_cone(interval.motion, out);
    interval.evaluate();
    REQUIRE(out.size() == 2 * interval.exact(0.0).forces.size());
    for (double s : kPlaces) {
      const auto state = interval.exact(s);
      for (std::size_t v = 0; v < state.forces.size(); ++v) {
        const auto& force = state.forces[v];
        const double mu = task.surfaces[force.surface].friction;
        CHECK(std::abs(interval.at(out[2 * v].node, s) - (mu * force.normal + force.tangential)) < 1e-4);
        CHECK(std::abs(interval.at(out[2 * v + 1].node, s) - (mu * force.normal - force.tangential)) < 1e-4);
        for (const Limited& row : {out[2 * v], out[2 * v + 1]}) {
          CHECK(row.lower == doctest::Approx(0.01 * weight));
          CHECK(row.upper == INFINITY);
          CHECK(row.scale == doctest::Approx(1.0 / weight));
          CHECK(row.name == "friction of " + task.robot.end_effectors[force.end_effector].name + " point " +
                                std::to_string(force.point));
        }
      }
    }
  }
}

TEST_CASE("a least normal force has a row for each point, zero has none: the cone implies it") {
  const PlanarTask task = planar_tasks::cartwheel();
  Options options = with(Forces::uniform);
  std::vector<Limited> out;
  {
    IntervalAt interval(task, options, 1, gentle_parameters(task, options));
    keep_pushing(interval.motion, out);
    CHECK(out.empty());
  }
  options.min_normal_force = 12.0;
  IntervalAt interval(task, options, 1, gentle_parameters(task, options));
  keep_pushing(interval.motion, out);
  interval.evaluate();
  const auto state = interval.exact(0.3);
  REQUIRE(out.size() == state.forces.size());
  for (std::size_t v = 0; v < out.size(); ++v) {
    CHECK(out[v].lower == 12.0);
    CHECK(out[v].upper == INFINITY);
    CHECK(std::abs(interval.at(out[v].node, 0.3) - state.forces[v].normal) < 1e-4);
  }
}

TEST_CASE("forces that are parameters balance by their lowest coefficients, others by construction") {
  const PlanarTask task = planar_tasks::cartwheel();
  std::vector<Limited> out;
  {
    const Options options = with(Forces::per_body);
    IntervalAt interval(task, options, 1, gentle_parameters(task, options));
    balance_forces(interval.motion, out);
    CHECK(out.empty());
  }
  const Options options = with(Forces::parameters);
  IntervalAt interval(task, options, 1, gentle_parameters(task, options));
  balance_forces(interval.motion, out);
  interval.evaluate();
  REQUIRE(out.size() == 3);
  const auto state = interval.exact(0.0);
  for (int i = 0; i < 3; ++i) {
    CHECK(out[i].when == Limited::When::coefficients);
    CHECK(out[i].highest == options.neq);
    CHECK(out[i].lower == 0.0);
    CHECK(out[i].upper == 0.0);
    if (i < 2) CHECK(std::abs(interval.at(out[i].node, 0.0) - state.base_residual[i]) < 1e-4);
  }
}
