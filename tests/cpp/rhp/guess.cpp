#include "rhp/guess.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "rhp/walkers.hpp"

namespace mcplan::rhp::tests {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

Horizon horizon_of(const Walker& walker, const State& state, const std::vector<Vector3d>& footholds_W) {
  HorizonRequest request;
  request.state = state;
  request.steps = static_cast<int>(footholds_W.size());
  request.footholds_W = footholds_W;
  request.guess = [&](const Horizon& built) { return nominal_guess(walker, state, built); };
  return build_horizon(walker, footsteps_of(walker), request);
}

}  // namespace

TEST_CASE("nominal footholds lie on the surfaces of their steps, each foot on its own side") {
  const Walker walker(walkers::uneven(), walkers::robot(), walkers::quick());
  const State state = walker.start();
  const Footsteps footsteps = footsteps_of(walker);
  const auto footholds = nominal_footholds(walker, state, footsteps, 0, 6);
  REQUIRE(footholds.size() == 6);
  for (int i = 0; i < 6; ++i) {
    const Polygon& surface = walker.surfaces[footsteps[i].surface];
    CHECK(std::abs(surface.height(footholds[i])) < 1e-9);
    CHECK(surface.outside(footholds[i]) < -0.05);
    CHECK((footholds[i].y() > 0.0) == (footsteps[i].foot == walkers::left));
    if (i > 0) CHECK(footholds[i].x() > footholds[i - 1].x());
  }
}

TEST_CASE("the first guess stands in balance: its forces carry the weight, its durations are allowed") {
  const Walker walker(walkers::uneven(), walkers::robot(), walkers::quick());
  const State state = walker.start();
  const Horizon horizon = horizon_of(walker, state, nominal_footholds(walker, state, footsteps_of(walker), 0, 2));
  const VectorXd& x = horizon.guess;
  for (const Horizon::Control& control : horizon.controls) {
    Vector3d sum = Vector3d::Zero();
    for (const ContactPoint& point : control.points)
      sum += walkers::force_W(point, horizon.placements[point.placement], x);
    CHECK((sum - Vector3d(0.0, 0.0, 95.0 * walkers::kGravity)).norm() < 1e-9);
  }
  for (const Horizon::Phase& phase : horizon.phases) {
    CHECK(x[phase.duration] >= horizon.problem.variable_lower()[phase.duration]);
    CHECK(x[phase.duration] <= horizon.problem.variable_upper()[phase.duration]);
  }
  CHECK((x.segment<3>(horizon.nodes[0].com) + horizon.shift_W - state.com_W).norm() < 1e-12);
}

TEST_CASE("what is remembered fits a robot that has moved on level ground as it stood before") {
  const Walker walker(walkers::plain(), walkers::robot(), walkers::quick());
  const State state = walker.start();
  const Footsteps footsteps = footsteps_of(walker);
  const auto footholds = nominal_footholds(walker, state, footsteps, 0, 2);
  const Horizon horizon = horizon_of(walker, state, footholds);
  Memory memory;
  memory.state = state;
  memory.x = horizon.guess + walkers::Random(5).vector(horizon.problem.variable_count(), 0.02);
  memory.swing = walkers::left;
  for (int foot = 0; foot < 2; ++foot) memory.x.segment<2>(horizon.placements[foot].variable).setZero();  // fixed
  for (int i = 0; i < 2; ++i) memory.footholds_W.push_back(horizon.position_W(memory.x, 2 + i));

  const Vector3d way(0.6, -0.1, 0.0);
  State later = state;
  later.com_W += way;
  for (Vector3d& foot : later.feet_W) foot += way;
  const auto moved = moved_footholds(walker, later, footsteps, 0, memory);
  const Horizon next = horizon_of(walker, later, moved);
  const VectorXd guess = remembered_guess(later, next, memory);
  for (int i = 0; i < 2; ++i)
    CHECK((next.position_W(guess, 2 + i) - way - horizon.position_W(memory.x, 2 + i)).norm() < 1e-9);
  for (std::size_t k = 0; k < next.nodes.size(); ++k)
    CHECK((guess.segment<3>(next.nodes[k].com) + next.shift_W - way - memory.x.segment<3>(horizon.nodes[k].com) -
           horizon.shift_W)
              .norm() < 1e-9);
  // Every row is as far from its limit as before, but those on how far the edges of the ground are.
  VectorXd before(horizon.problem.row_count()), after(next.problem.row_count());
  horizon.problem.rows(memory.x, before);
  next.problem.rows(guess, after);
  REQUIRE(before.size() == after.size());
  const auto& lower = horizon.problem.row_lower();
  for (int i = 0; i < before.size(); ++i) {
    if (horizon.problem.row_name(i).rfind("foothold", 0) == 0) continue;
    const bool from_below = std::isfinite(lower[i]);
    before[i] -= from_below ? lower[i] : horizon.problem.row_upper()[i];
    after[i] -= from_below ? next.problem.row_lower()[i] : next.problem.row_upper()[i];
    CHECK_MESSAGE(std::abs(before[i] - after[i]) < 1e-9, horizon.problem.row_name(i));
  }
}

}  // namespace mcplan::rhp::tests
