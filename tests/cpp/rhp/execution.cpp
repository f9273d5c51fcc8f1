#include "rhp/execution.hpp"

#include <doctest/doctest.h>

#include "rhp/guess.hpp"
#include "rhp/walkers.hpp"

namespace mcplan::rhp::tests {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using walkers::Random;

/// A horizon with numbers that keep no constraint: conversion to a plan does not depend on a solution.
struct Anything {
  Walker walker;
  State state;
  Horizon horizon;
  VectorXd x;

  explicit Anything(const Options& options)
      : walker(walkers::uneven(), walkers::robot(), options), state(walker.start()) {
    state.com_velocity_W = {0.1, 0.05, -0.02};
    state.angular_momentum_W = {0.3, -0.1, 0.2};
    const Footsteps footsteps = footsteps_of(walker);
    HorizonRequest request;
    request.state = state;
    request.steps = options.lookahead;
    request.footholds_W = nominal_footholds(walker, state, footsteps, 0, options.lookahead);
    request.guess = [&](const Horizon& built) { return nominal_guess(walker, state, built); };
    horizon = build_horizon(walker, footsteps, request);
    const nlp::Problem& problem = horizon.problem;
    x = horizon.guess + Random(3).vector(problem.variable_count(), 0.1);
    for (int i = 0; i < problem.variable_count(); ++i)
      x[i] = std::min(std::max(x[i], problem.variable_lower()[i]), problem.variable_upper()[i]);
  }
};

}  // namespace

TEST_CASE("the plan of a step has the forces of its control nodes, in newtons and world axes, at the corners") {
  for (Transcription transcription : {Transcription::trapezoidal, Transcription::euler}) {
    Options options = walkers::quick();
    options.transcription = transcription;
    const Anything any(options);
    const Plan plan = executed_plan(any.walker, any.state, any.horizon, any.x, 1);
    CHECK_NOTHROW(plan.validate());
    REQUIRE(plan.phases.size() == 3);
    for (int q = 0; q < 3; ++q) {
      const Horizon::Phase& phase = any.horizon.phases[q];
      CHECK(plan.phases[q].duration == any.x[phase.duration]);
      const bool held = transcription == Transcription::euler;
      CHECK(plan.phases[q].law == (held ? ForceLaw(laws::Held()) : ForceLaw(laws::Linear())));
      for (int k = 0; k < phase.control_count; ++k) {
        const Horizon::Control& control = any.horizon.controls[phase.first_control + k];
        // Sum and moment about the world's origin do not depend on the order of the points.
        Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
        for (const ContactPoint& point : control.points) {
          const Placement& foot = any.horizon.placements[point.placement];
          const Vector3d f = walkers::force_W(point, foot, any.x);
          force += f;
          moment += (any.horizon.position_W(any.x, point.placement) + point.offset_W).cross(f);
        }
        for (const Contact& contact : plan.phases[q].contacts)
          for (std::size_t i = 0; i < contact.points_W.size(); ++i) {
            const Vector3d& f = contact.point_forces_W[k * contact.points_W.size() + i];
            force -= f;
            moment -= contact.points_W[i].cross(f);
          }
        CHECK(force.norm() < 1e-9);
        CHECK(moment.norm() < 1e-9);
      }
    }
    CHECK((plan.knots.back().end_effectors_W[walkers::left] - any.horizon.position_W(any.x, 2)).norm() == 0.0);
    CHECK(plan.knots.back().end_effectors_W[walkers::right] == any.state.feet_W[walkers::right]);
  }
}

TEST_CASE("under linear forces the knots are the integral of the forces") {
  const Anything any(walkers::quick());
  const Plan plan = executed_plan(any.walker, any.state, any.horizon, any.x, 1);
  Vector3d com = any.state.com_W, velocity = any.state.com_velocity_W, momentum = any.state.angular_momentum_W;
  for (std::size_t q = 0; q < plan.phases.size(); ++q) {
    const Phase& phase = plan.phases[q];
    const int nodes = phase.node_count(), steps = 4000;
    const double dt = phase.duration / steps;
    for (int i = 0; i < steps; ++i) {  // midpoint rule
      const double at = (i + 0.5) / steps * phase.intervals;
      const int k = std::min(static_cast<int>(at), nodes - 2);
      const double s = at - k;
      Vector3d force = -any.walker.robot.mass * any.walker.scene.gravity * Vector3d::UnitZ(), moment = Vector3d::Zero();
      const Vector3d middle = com + 0.5 * dt * velocity;
      for (const Contact& contact : phase.contacts)
        for (std::size_t p = 0; p < contact.points_W.size(); ++p) {
          const std::size_t n = contact.points_W.size();
          const Vector3d f =
              (1.0 - s) * contact.point_forces_W[k * n + p] + s * contact.point_forces_W[(k + 1) * n + p];
          force += f;
          moment += (contact.points_W[p] - middle).cross(f);
        }
      const Vector3d a = force / any.walker.robot.mass;
      com += dt * velocity + 0.5 * dt * dt * a;
      velocity += dt * a;
      momentum += dt * moment;
    }
    CHECK((plan.knots[q + 1].com_W - com).norm() < 1e-6);
    CHECK((plan.knots[q + 1].com_velocity_W - velocity).norm() < 1e-6);
    CHECK((plan.knots[q + 1].angular_momentum_W - momentum).norm() < 1e-4);
  }
}

TEST_CASE("under forward Euler the knots are the states of the program") {
  Options options = walkers::quick();
  options.transcription = Transcription::euler;
  const Anything any(options);
  const Plan plan = executed_plan(any.walker, any.state, any.horizon, any.x, 1);
  for (int q = 1; q <= 3; ++q) {
    const Horizon::Node& node = any.horizon.nodes[q * options.intervals];
    CHECK((plan.knots[q].com_W - any.x.segment<3>(node.com) - any.horizon.shift_W).norm() == 0.0);
    CHECK((plan.knots[q].com_velocity_W - any.x.segment<3>(node.velocity)).norm() == 0.0);
    CHECK((plan.knots[q].angular_momentum_W - any.x.segment<3>(node.momentum)).norm() == 0.0);
  }
}

TEST_CASE("measures: the largest residual of an equation, and how far a replay ends from the states") {
  const Anything any(walkers::quick());
  const Plan plan = executed_plan(any.walker, any.state, any.horizon, any.x, 1);
  const Measures measures = measure(any.walker, any.state, any.horizon, any.x, plan);
  const nlp::Problem& problem = any.horizon.problem;
  VectorXd rows(problem.row_count());
  problem.rows(any.x, rows);
  double defect = 0.0;
  for (int i = 0; i < problem.row_count(); ++i)
    if (problem.row_lower()[i] == problem.row_upper()[i])
      defect = std::max(defect, std::abs(rows[i] - problem.row_lower()[i]));
  CHECK(measures.defect == defect);
  CHECK(defect > 0.01);
  const Horizon::Node& end = any.horizon.nodes[3 * any.walker.options.intervals];
  const Vector3d com = any.horizon.shift_W + any.x.segment<3>(end.com);
  CHECK(measures.drift_com_m == doctest::Approx((plan.knots.back().com_W - com).norm()));
  CHECK(measures.drift_momentum ==
        doctest::Approx((plan.knots.back().angular_momentum_W - any.x.segment<3>(end.momentum)).norm()));
}

TEST_CASE("plans joined end to end keep phases, knots and swings in order") {
  Options options = walkers::quick();
  auto planner = RecedingHorizon(walkers::uneven(), walkers::robot(), options);
  REQUIRE(planner.step().executed);
  const Plan first = planner.executed();
  REQUIRE(planner.step().executed);
  const Plan second = planner.executed();
  Plan both = first;
  append_plan(both, second);
  CHECK_NOTHROW(both.validate());
  CHECK(both.knots.size() == 7);
  CHECK(both.duration() == doctest::Approx(first.duration() + second.duration()));
  REQUIRE(both.swings.size() == first.swings.size() + second.swings.size());
  for (const Swing& swing : both.swings)
    for (int q = swing.first_phase; q < swing.end_phase; ++q)
      CHECK(both.phases[q].contacts[swing.end_effector].surface < 0);
  const double t = first.duration() + 0.4 * second.duration();
  CHECK((both.at(t).com_W - second.at(0.4 * second.duration()).com_W).norm() < 1e-9);
}

}  // namespace mcplan::rhp::tests
