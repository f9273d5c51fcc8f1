#include "rhp/guess.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

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

/// A point beside the guess, the feet that stand where they are.
VectorXd near(const Horizon& horizon, unsigned seed) {
  VectorXd x = horizon.guess + walkers::Random(seed).vector(horizon.problem.variable_count(), 0.02);
  for (int foot = 0; foot < 2; ++foot) x.segment<2>(horizon.placements[foot].variable).setZero();
  return x;
}

/// By the names of their pieces, how far a point is from the limits of the rows, smallest first.
std::map<std::string, std::vector<double>> distances(const Horizon& horizon, const VectorXd& x) {
  const nlp::Problem& problem = horizon.problem;
  VectorXd rows(problem.row_count());
  problem.rows(x, rows);
  std::map<std::string, std::vector<double>> out;
  for (int i = 0; i < rows.size(); ++i) {
    const std::string name = problem.row_name(i);
    const double low = rows[i] - problem.row_lower()[i], high = problem.row_upper()[i] - rows[i];
    out[name.substr(0, name.find_first_of(" ["))].push_back(std::min(std::abs(low), std::abs(high)));
  }
  for (auto& [name, values] : out) std::sort(values.begin(), values.end());
  return out;
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
  const Memory memory = memory_of(state, horizon, near(horizon, 5));

  const Vector3d way(0.6, -0.1, 0.0);
  State later = state;
  later.com_W += way;
  for (Vector3d& foot : later.feet_W) foot += way;
  const auto moved = moved_footholds(walker, later, footsteps, 0, memory);
  const Horizon next = horizon_of(walker, later, moved);
  const VectorXd guess = remembered_guess(walker, later, next, memory);
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

TEST_CASE("what is remembered of a step with the other foot is its mirror image") {
  for (Fidelity fidelity : {Fidelity::single, Fidelity::point, Fidelity::rectangle}) {
    Options options = walkers::quick();
    options.fidelity = fidelity;
    const Walker walker(walkers::plain(), walkers::robot(), options);
    const Walker other(walkers::mirrored(walkers::plain()), walkers::robot(), options);
    const State state = walker.start(), image = other.start();
    const Horizon horizon = horizon_of(walker, state, nominal_footholds(walker, state, footsteps_of(walker), 0, 2));
    const VectorXd x = near(horizon, 7);
    const Memory memory = memory_of(state, horizon, x);
    const Horizon next = horizon_of(other, image, moved_footholds(other, image, footsteps_of(other), 0, memory));
    const VectorXd guess = remembered_guess(other, image, next, memory);
    CHECK(next.problem.cost(guess) == doctest::Approx(horizon.problem.cost(x)).epsilon(1e-12));
    const auto before = distances(horizon, x), after = distances(next, guess);
    for (const auto& [name, values] : before) {
      if (name == "foothold") continue;  // how far the edges of the ground are
      REQUIRE(after.at(name).size() == values.size());
      for (std::size_t i = 0; i < values.size(); ++i)
        CHECK_MESSAGE(std::abs(after.at(name)[i] - values[i]) < 1e-9, name);
    }
  }
}

TEST_CASE("the CoM is remembered as high over the feet as it was, and forces keep their direction") {
  const Walker walker(walkers::uneven(), walkers::robot(), walkers::quick());
  const State state = walker.start();
  const Footsteps footsteps = footsteps_of(walker);
  const Horizon horizon = horizon_of(walker, state, nominal_footholds(walker, state, footsteps, 0, 2));
  const VectorXd x = near(horizon, 9);
  Memory memory = memory_of(state, horizon, x);
  const double deeper = 0.07;  // than here were the footholds of the memory
  for (Vector3d& foothold_W : memory.footholds_W) foothold_W.z() -= deeper;
  Horizon next = horizon_of(walker, state, moved_footholds(walker, state, footsteps, 0, memory));
  for (int i = 0; i < 2; ++i) {  // tilted otherwise
    next.placements[2 + i].axes_W = Eigen::AngleAxisd(0.1, Vector3d::UnitX()) * next.placements[2 + i].axes_W;
    next.placements[2 + i].origin_W.z() = memory.footholds_W[i].z() + deeper;
  }
  const VectorXd guess = remembered_guess(walker, state, next, memory);
  const auto end = [](const Horizon& of, const VectorXd& at) { return at[of.nodes.back().com + 2]; };
  CHECK(end(next, guess) - end(horizon, x) == doctest::Approx(deeper).epsilon(1e-9));
  for (std::size_t k = 0; k < next.controls.size(); ++k)
    for (std::size_t i = 0; i < next.controls[k].points.size(); ++i) {
      const ContactPoint& point = next.controls[k].points[i];
      const Vector3d force_W = point.force_W(next.placements[point.placement], guess);
      CHECK((force_W - memory.forces_W[k].col(static_cast<int>(i))).norm() < 1e-9);
    }
}

}  // namespace mcplan::rhp::tests
