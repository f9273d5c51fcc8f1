#include "rhp/horizon.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "mcplan/nlp/derivative_check.hpp"
#include "mcplan/nlp/solver.hpp"
#include "rhp/execution.hpp"
#include "rhp/guess.hpp"
#include "rhp/momentum_cost.hpp"
#include "rhp/pieces/torque_bound.hpp"
#include "rhp/walkers.hpp"

namespace mcplan::rhp::tests {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using walkers::Random;

struct Case {
  Options options;
  std::string name;
};

/// Every fidelity, both transcriptions, psi eliminated and lifted where there is one.
std::vector<Case> all_cases() {
  std::vector<Case> out;
  const std::pair<Fidelity, const char*> fidelities[] = {{Fidelity::single, "single"},
                                                         {Fidelity::com, "com"},
                                                         {Fidelity::rectangle, "rectangle"},
                                                         {Fidelity::point, "point"}};
  for (const auto& [fidelity, name] : fidelities)
    for (Transcription transcription : {Transcription::trapezoidal, Transcription::euler})
      for (bool lifted : {false, true}) {
        if (lifted && (fidelity == Fidelity::single || fidelity == Fidelity::com)) continue;
        Case next{walkers::quick(fidelity, 3), name};
        next.options.intervals = 3;
        next.options.transcription = transcription;
        next.options.lifted_psi = lifted;
        // All three kinds of force variables.
        next.options.friction_rows = transcription == Transcription::euler;
        next.options.solver = lifted || fidelity == Fidelity::com ? nlp::Solver::ipopt : nlp::Solver::ipm;
        next.name += transcription == Transcription::euler ? " euler" : " trapezoidal";
        if (lifted) next.name += " lifted";
        out.push_back(next);
      }
  return out;
}

/// A walker on the uneven scene and its first horizon.
struct First {
  Walker walker;
  State state;
  Horizon horizon;

  explicit First(const Options& options, const Scene& scene = walkers::uneven(), bool rest = false)
      : walker(scene, walkers::robot(), options), state(walker.start()) {
    const Footsteps footsteps = footsteps_of(walker);
    HorizonRequest request;
    request.state = state;
    request.steps = options.lookahead;
    request.footholds_W = nominal_footholds(walker, state, footsteps, 0, options.lookahead);
    request.rest = rest;
    request.guess = [&](const Horizon& built) { return nominal_guess(walker, state, built); };
    horizon = build_horizon(walker, footsteps, request);
  }
  const VectorXd& guess() const { return horizon.guess; }
};

/// Rows of the problem by the name of their piece.
std::map<std::string, int> row_counts(const nlp::Problem& problem) {
  std::map<std::string, int> out;
  for (const nlp::Problem::Block& block : problem.blocks())
    if (!block.is_cost()) out[block.piece->name()] += block.piece->rows();
  return out;
}

}  // namespace

TEST_CASE("derivatives and sparse structure of whole horizons") {
  for (const Case& test : all_cases()) {
    CAPTURE(test.name);
    const First first(test.options);
    Random random(17);
    const VectorXd x = first.guess() + random.vector(first.horizon.problem.variable_count(), 0.3);
    for (const auto& wrong : nlp::check_derivatives(first.horizon.problem, x)) FAIL_CHECK(wrong.to_string());
  }
}

TEST_CASE("every piece joins one stage or two neighbours, and what lasts is alive there") {
  for (const Case& test : all_cases()) {
    CAPTURE(test.name);
    const First first(test.options);
    const nlp::Problem& problem = first.horizon.problem;
    const int last = 3 * test.options.lookahead * test.options.intervals;
    for (const nlp::Problem::Block& block : problem.blocks()) {
      // Worked out here from the variables alone: those of one stage say where the piece is.
      int from = last + 1, to = -1;
      for (int variable : block.piece->variables()) {
        const nlp::Stages alive = problem.variable_stages(variable);
        CHECK((0 <= alive.first && alive.first <= alive.last && alive.last <= last));
        if (alive.first != alive.last) continue;
        from = std::min(from, alive.first);
        to = std::max(to, alive.first);
      }
      // What joins footholds alone can hang at any stage at which all of them are alive.
      if (to < 0) {
        from = 0;
        int end = last;
        for (int variable : block.piece->variables()) {
          from = std::max(from, problem.variable_stages(variable).first);
          end = std::min(end, problem.variable_stages(variable).last);
        }
        CHECK_MESSAGE(from <= end, block.piece->name());
        to = from;
      }
      CHECK_MESSAGE(to - from <= 1, block.piece->name() << " from " << from << " to " << to);
      const nlp::Stages told = problem.piece_stages(*block.piece);
      CHECK_MESSAGE((told.first == from && told.last == to),
                    block.piece->name() << " at " << from << ": told " << told.first << " to " << told.last);
      for (int variable : block.piece->variables()) {
        const nlp::Stages alive = problem.variable_stages(variable);
        CHECK_MESSAGE((alive.first <= to && from <= alive.last),
                      block.piece->name() << " at stage " << from << " uses " << problem.variable_name(variable));
        if (alive.first != alive.last)
          CHECK_MESSAGE((alive.first <= from && to <= alive.last),
                        block.piece->name() << " at stage " << from << " uses " << problem.variable_name(variable));
      }
    }
  }
}

TEST_CASE("horizons of the four fidelities have the models of the paper's table") {
  for (const Case& test : all_cases()) {
    CAPTURE(test.name);
    const First first(test.options);
    const Options& options = test.options;
    const bool euler = options.transcription == Transcription::euler, single = options.fidelity == Fidelity::single;
    const int nodes = options.intervals + (euler ? 0 : 1), predicted = options.lookahead - 1;
    const int per_foot = options.fidelity == Fidelity::point ? 1 : 4;
    // Feet in contact in the three phases of a step: two, one, two.
    const int executed_points = 4 * 5 * nodes, predicted_points = per_foot * 5 * nodes * predicted;
    int points = 0;
    for (const Horizon::Control& control : first.horizon.controls) points += static_cast<int>(control.points.size());
    CHECK(points == executed_points + predicted_points);
    CHECK(first.horizon.nodes.size() == 3u * options.lookahead * options.intervals + 1);

    auto rows = row_counts(first.horizon.problem);
    const int intervals = 3 * options.intervals, centroidal_steps = single ? options.lookahead : 1;
    CHECK(rows["position_step"] == 3 * intervals * options.lookahead);
    CHECK(rows["velocity_step"] == 3 * intervals * options.lookahead);
    CHECK(rows["momentum_step"] == 3 * intervals * centroidal_steps);
    CHECK(rows["momentum_rate"] == 3 * 3 * nodes * centroidal_steps);
    const bool relaxed = options.fidelity == Fidelity::rectangle || options.fidelity == Fidelity::point;
    CHECK(rows["torque_bound"] == (relaxed ? 6 * predicted_points : 0));
    const bool edges = !options.friction_rows && options.solver == nlp::Solver::ipopt;
    CHECK(rows["friction"] == (edges ? 0 : 8 * (executed_points + predicted_points)));

    for (const Horizon::Phase& phase : first.horizon.phases) {
      const bool fixed = phase.step > 0 && !single;
      const double low = first.horizon.problem.variable_lower()[phase.duration];
      const double high = first.horizon.problem.variable_upper()[phase.duration];
      if (fixed) {
        CHECK((low == high && low == (phase.swing >= 0 ? 0.6 : 0.2)));
      } else {
        CHECK((low == (phase.swing >= 0 ? 0.8 : 0.1) && high == (phase.swing >= 0 ? 1.2 : 0.3)));
      }
    }
  }
}

TEST_CASE("forces act at the corners of a share of the sole, in the paper's form of all of it") {
  for (bool paper : {false, true})
    for (double ratio : {0.5, 1.0}) {
      Options options = walkers::quick(Fidelity::rectangle, 2);
      options.sole_ratio = ratio;
      options.paper = paper;
      const First first(options);
      const Eigen::Vector2d half = (paper ? 1.0 : ratio) * walkers::robot().end_effectors[0].half_size;
      for (const Horizon::Control& control : first.horizon.controls) {
        std::map<int, std::set<std::pair<int, int>>> corners;  // by placement, as signs
        for (const ContactPoint& point : control.points) {
          const Vector3d offset = first.horizon.placements[point.placement].axes_W.transpose() * point.offset_W;
          CHECK(std::abs(offset[0]) == doctest::Approx(half[0]));
          CHECK(std::abs(offset[1]) == doctest::Approx(half[1]));
          CHECK(std::abs(offset[2]) < 1e-12);
          corners[point.placement].insert({offset[0] > 0.0, offset[1] > 0.0});
        }
        for (const auto& [placement, signs] : corners) CHECK(signs.size() == 4);
      }
    }
}

TEST_CASE("the share of a sole does not move where single forces act") {
  Options options = walkers::quick(Fidelity::point, 2);
  options.sole_ratio = 0.5;
  const First first(options);
  int single = 0;
  for (const Horizon::Phase& phase : first.horizon.phases)
    for (int k = 0; phase.single_force && k < phase.control_count; ++k)
      for (const ContactPoint& point : first.horizon.controls[phase.first_control + k].points) {
        CHECK(point.offset_W.norm() == 0.0);
        ++single;
      }
  CHECK(single > 0);
}

TEST_CASE("reach and height bind both feet at every node where they stand, boundaries of phases included") {
  Options options = walkers::quick(Fidelity::single, 1);
  options.all_faces = true;
  const First first(options);
  const int n = options.intervals;
  const nlp::Problem& problem = first.horizon.problem;
  std::set<std::pair<int, int>> reach, height;  // node, foothold
  for (const nlp::Problem::Block& block : problem.blocks()) {
    const auto& variables = block.piece->variables();
    if (block.piece->name() == "com_reach") reach.insert({problem.variable_stages(variables[0]).first, variables[3]});
    if (block.piece->name() == "com_height") height.insert({problem.variable_stages(variables[0]).first, variables[1]});
  }
  std::set<std::pair<int, int>> expected;
  const auto& placements = first.horizon.placements;
  for (int k = 1; k <= 3 * n; ++k) {  // node 0 is given
    expected.insert({k, placements[walkers::right].variable});
    if (k <= n) expected.insert({k, placements[walkers::left].variable});
    if (k >= 2 * n) expected.insert({k, placements[2].variable});
  }
  CHECK(reach == expected);
  CHECK(height == expected);
}

TEST_CASE("the start is fixed to the state, with positions counted from beneath its CoM") {
  const First first(walkers::quick(), walkers::moved(walkers::uneven(), 0.7, {100.0, -40.0, 3.0}));
  const auto& lower = first.horizon.problem.variable_lower();
  const auto& upper = first.horizon.problem.variable_upper();
  const Horizon::Node& node = first.horizon.nodes[0];
  for (int i = 0; i < 3; ++i) {
    CHECK(lower[node.com + i] == upper[node.com + i]);
    CHECK(lower[node.com + i] + first.horizon.shift_W[i] == doctest::Approx(first.state.com_W[i]));
    CHECK((lower[node.velocity + i] == 0.0 && upper[node.velocity + i] == 0.0));
  }
  for (int i = 0; i < 2; ++i) CHECK(std::abs(lower[node.com + i]) < 1e-9);
  for (int foot = 0; foot < 2; ++foot)
    CHECK((first.horizon.position_W(first.guess(), foot) - first.state.feet_W[foot]).norm() < 1e-12);
}

TEST_CASE("at the end of the walk the robot stands still") {
  const First first(walkers::quick(Fidelity::single), walkers::uneven(), true);
  const nlp::Solution solution = nlp::solve(first.horizon.problem, first.guess());
  REQUIRE(solution.outcome == nlp::Outcome::converged);
  const Horizon::Node& end = first.horizon.nodes.back();
  CHECK(solution.x.segment<3>(end.velocity).norm() == 0.0);
  CHECK(solution.x.segment<3>(end.momentum).norm() == 0.0);
}

TEST_CASE("psi eliminated and lifted have the same optimum, and the lifted psi are tight") {
  for (Fidelity fidelity : {Fidelity::point, Fidelity::rectangle}) {
    Options options = walkers::quick(fidelity);
    options.intervals = 3;
    const First plain(options);
    options.lifted_psi = true;
    const First lifted(options);
    nlp::SolverOptions how;
    how.tolerance = 1e-7;
    how.gradient_scaling = false;
    const nlp::Solution a = nlp::solve(plain.horizon.problem, plain.guess(), how);
    const nlp::Solution b = nlp::solve(lifted.horizon.problem, lifted.guess(), how);
    REQUIRE(a.outcome == nlp::Outcome::converged);
    REQUIRE(b.outcome == nlp::Outcome::converged);
    CHECK(a.cost == doctest::Approx(b.cost).epsilon(1e-6));
    for (int i = 0; i < options.lookahead; ++i)
      CHECK((plain.horizon.position_W(a.x, 2 + i) - lifted.horizon.position_W(b.x, 2 + i)).norm() < 1e-3);
    for (std::size_t q = 0; q < plain.horizon.phases.size(); ++q)
      CHECK(std::abs(a.x[plain.horizon.phases[q].duration] - b.x[lifted.horizon.phases[q].duration]) < 1e-3);
    const auto cost_of = [](const First& first, const VectorXd& x) {
      const Measures m = measure(first.walker, first.state, first.horizon, x,
                                 executed_plan(first.walker, first.state, first.horizon, x, 1));
      return m.acceleration_cost + m.momentum_cost;
    };
    CHECK(std::abs(cost_of(plain, a.x) - cost_of(lifted, b.x)) < 1e-3);

    int costly = 0;
    for (const Horizon::Control& control : lifted.horizon.controls)
      for (std::size_t p = 0; p < control.psi.size(); ++p) {
        const ContactPoint& point = control.points[p];
        const Placement& foot = lifted.horizon.placements[point.placement];
        const double unit = fidelity == Fidelity::point ? 1600.0 : 400.0;
        const Vector3d lever = (foot.position_W(b.x.segment<2>(foot.variable)) + point.offset_W -
                                b.x.segment<3>(lifted.horizon.nodes[control.node].com));
        const Vector3d torque = lever.cross(walkers::force_W(point, foot, b.x));
        for (int i = 0; i < 3; ++i) {
          const double more = b.x[control.psi[p] + 2 * i], less = b.x[control.psi[p] + 2 * i + 1];
          if (std::min(more, less) < 1e-2) continue;  // costs next to nothing: flat
          ++costly;
          // Tight psi carry the torque: a slack s in one of the two would be off by s / 4.
          CHECK(std::abs((more - less) / 4.0 - torque[i] / (1.5 * unit)) < 0.25e-4);
        }
      }
    CHECK(costly > 20);
  }
}

TEST_CASE("faces that are left out of the reach are remembered, and found where a motion violates them") {
  Options options = walkers::quick(Fidelity::single);
  const First fewer(options);
  options.all_faces = true;
  const First all(options);
  CHECK(all.horizon.left_out.empty());
  REQUIRE_FALSE(fewer.horizon.left_out.empty());
  int kept = 0;
  for (const auto& [name, rows] : row_counts(fewer.horizon.problem)) kept += name == "com_reach" ? rows : 0;
  int on_ground = 0;  // a foot at a node, the first excepted
  for (const auto& [name, rows] : row_counts(fewer.horizon.problem)) on_ground += name == "com_height" ? rows : 0;
  const int faces = static_cast<int>(fewer.walker.feet[0].com_reach_W.A.rows());
  CHECK(kept + static_cast<int>(fewer.horizon.left_out.size()) == faces * on_ground);

  // A CoM that leaves the reach of a foot at one node: the rows of the complete problem say so, and so must these.
  VectorXd x = fewer.guess();
  CHECK(violated_reach(fewer.walker, fewer.horizon, x, 1e-9).empty());
  const ReachRow somewhere = fewer.horizon.left_out[fewer.horizon.left_out.size() / 2];
  const Polytope& reach_W = fewer.walker.feet[fewer.horizon.placements[somewhere.placement].foot].com_reach_W;
  x.segment<3>(fewer.horizon.nodes[somewhere.node].com) += 2.0 * reach_W.A.row(somewhere.row).transpose();
  const std::set<ReachRow> violated = violated_reach(fewer.walker, fewer.horizon, x, 1e-9);
  CHECK(violated.count(somewhere) == 1);
  for (const ReachRow& row : violated) CHECK(row.node == somewhere.node);
}

TEST_CASE("leaving out faces that others imply does not change the optimum") {
  Options options = walkers::quick(Fidelity::single);
  const First fewer(options);
  options.all_faces = true;
  const First all(options);
  CHECK(fewer.horizon.problem.row_count() < all.horizon.problem.row_count());
  const nlp::Solution a = nlp::solve(fewer.horizon.problem, fewer.guess()),
                      b = nlp::solve(all.horizon.problem, all.guess());
  REQUIRE(a.outcome == nlp::Outcome::converged);
  REQUIRE(b.outcome == nlp::Outcome::converged);
  CHECK(violated_reach(fewer.walker, fewer.horizon, a.x, 1e-6).empty());
  CHECK(all.horizon.problem.worst_violation(a.x).value <= 1e-6);
  CHECK(a.cost == doctest::Approx(b.cost).epsilon(1e-6));
}

TEST_CASE("the cost of a horizon is the documented integral") {
  for (const Case& test : all_cases()) {
    if (test.options.lifted_psi) continue;
    CAPTURE(test.name);
    const First first(test.options);
    const Horizon& horizon = first.horizon;
    Random random(23);
    const VectorXd x = first.guess() + random.vector(horizon.problem.variable_count(), 0.2);
    const bool euler = test.options.transcription == Transcription::euler;
    const int n = test.options.intervals;
    double cost =
        10.0 * (x.segment<3>(horizon.nodes.back().com) + horizon.shift_W - Vector3d(20.0, 0.0, 0.75)).squaredNorm();
    for (const Horizon::Phase& phase : horizon.phases) {
      const double h = x[phase.duration] / n, planned_h = (phase.swing >= 0 ? 0.6 : 0.2) / n;
      const auto acceleration = [&](int k) -> Vector3d {
        return x.segment<3>(horizon.controls[phase.first_control + k].acceleration);
      };
      for (int k = 0; k < n; ++k) {
        if (euler) {
          cost += h * acceleration(k).squaredNorm();
          continue;
        }
        // Simpson's rule is exact for the square of a linear function.
        const Vector3d a = acceleration(k), b = acceleration(k + 1);
        cost += h / 6.0 * (a.squaredNorm() + 4.0 * (0.5 * (a + b)).squaredNorm() + b.squaredNorm());
        if (phase.centroidal) cost += momentum_cost(horizon.interval(phase, k, n), x, h);
      }
      for (int k = 0; k < phase.control_count; ++k) {
        const double weight = !euler && (k == 0 || k == n) ? 0.5 : 1.0;
        const Horizon::Control& control = horizon.controls[phase.first_control + k];
        if (phase.centroidal && euler) cost += h * x.segment<3>(horizon.nodes[control.node].momentum).squaredNorm();
        if (phase.centroidal || test.options.fidelity == Fidelity::com) continue;
        for (const ContactPoint& point : control.points) {
          const Placement& foot = horizon.placements[point.placement];
          const double unit = test.options.fidelity == Fidelity::point ? 1600.0 : 400.0;
          const Vector3d l = (foot.origin_W + foot.axes_W.leftCols<2>() * x.segment<2>(foot.variable) + point.offset_W -
                              x.segment<3>(horizon.nodes[control.node].com)) /
                             1.5;
          const Vector3d d = walkers::force_W(point, foot, x) / unit;
          const Eigen::Vector2d alphas[] = {{-l.z(), l.y()}, {l.z(), -l.x()}, {-l.y(), l.x()}};
          const Eigen::Vector2d deltas[] = {{d.y(), d.z()}, {d.x(), d.z()}, {d.x(), d.y()}};
          for (int i = 0; i < 3; ++i)
            for (double sign : {1.0, -1.0})
              cost += weight * planned_h * std::pow((alphas[i] + sign * deltas[i]).squaredNorm(), 2);
        }
      }
    }
    CHECK(horizon.problem.cost(x) == doctest::Approx(cost).epsilon(1e-10));
  }
}

}  // namespace mcplan::rhp::tests
