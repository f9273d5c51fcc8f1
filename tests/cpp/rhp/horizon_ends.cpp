#include <doctest/doctest.h>

#include "rhp/guess.hpp"
#include "rhp/horizon.hpp"
#include "rhp/walkers.hpp"

namespace mcplan::rhp::tests {
namespace {

using Eigen::Vector3d;

/// The first horizon, which ends at rest.
struct Resting {
  Walker walker;
  Horizon horizon;

  explicit Resting(const Scene& scene) : walker(scene, walkers::robot(), walkers::quick(Fidelity::single)) {
    const Footsteps footsteps = footsteps_of(walker);
    HorizonRequest request;
    request.state = walker.start();
    request.steps = walker.options.lookahead;
    request.footholds_W = nominal_footholds(walker, request.state, footsteps, 0, request.steps);
    request.rest = true;
    request.guess = [&](const Horizon& built) { return nominal_guess(walker, request.state, built); };
    horizon = build_horizon(walker, footsteps, request);
  }

  /// Of ending at a place of the CoM, the footholds as guessed.
  double cost_of_end(const Vector3d& com_W) const {
    Eigen::VectorXd x = horizon.guess, f(1);
    x.segment<3>(horizon.nodes.back().com) = com_W - horizon.shift_W;
    double sum = 0.0;
    for (const nlp::Problem::Block& block : horizon.problem.blocks()) {
      if (block.piece->name() != "goal") continue;
      block.piece->values(x(block.piece->variables()), f);
      sum += f[0];
    }
    return sum;
  }

  Vector3d above_last_footholds_W() const {
    const auto& feet = horizon.phases.back().placements;
    return 0.5 * (horizon.position_W(horizon.guess, feet[0]) + horizon.position_W(horizon.guess, feet[1])) +
           walker.robot.com_height * Vector3d::UnitZ();
  }
};

}  // namespace

TEST_CASE("rest is sought at a goal that is near, and else above the last footholds") {
  Scene scene = walkers::plain();
  const Resting far(scene);
  CHECK(far.cost_of_end(far.above_last_footholds_W()) == doctest::Approx(0.0));
  CHECK(far.cost_of_end(far.above_last_footholds_W() + Vector3d(0.1, 0.0, 0.0)) > 1.0);
  scene.goal.position_W.x() = far.above_last_footholds_W().x() + 0.3;
  const Resting near_goal(scene);
  CHECK(near_goal.cost_of_end(near_goal.walker.goal_com_W) == doctest::Approx(0.0));
  CHECK(near_goal.cost_of_end(near_goal.above_last_footholds_W()) > 1.0);
}

TEST_CASE("the first phase of a horizon, and no other, may last longer by a landing") {
  Options options = walkers::quick(Fidelity::single);
  options.landing_s = 0.25;
  const Walker walker(walkers::uneven(), walkers::robot(), options);
  const Footsteps footsteps = footsteps_of(walker);
  HorizonRequest request;
  request.state = walker.start();
  request.steps = options.lookahead;
  request.footholds_W = nominal_footholds(walker, request.state, footsteps, 0, options.lookahead);
  request.guess = [&](const Horizon& built) { return nominal_guess(walker, request.state, built); };
  const Horizon horizon = build_horizon(walker, footsteps, request);
  REQUIRE(horizon.phases.size() == 6);
  for (const Horizon::Phase& phase : horizon.phases) {
    const Range range = phase.swing >= 0 ? options.single_support_s : options.double_support_s;
    const double longer = phase.first_node == 0 ? options.landing_s : 0.0;
    CHECK(horizon.problem.variable_lower()[phase.duration] == range.min);
    CHECK(horizon.problem.variable_upper()[phase.duration] == range.max + longer);
  }
}

}  // namespace mcplan::rhp::tests
