#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "ddp/local_model.hpp"
#include "ddp/problem.hpp"
#include "scenes.hpp"
#include "slow_build.hpp"

namespace support {

namespace ddp = mcplan::ddp;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline VectorXd noise(Random& random, int n, double size) {
  VectorXd out(n);
  for (int i = 0; i < n; ++i) out[i] = uniform(random, -size, size);
  return out;
}

inline MatrixXd noise(Random& random, int rows, int cols, double size) {
  MatrixXd out(rows, cols);
  for (int j = 0; j < cols; ++j) out.col(j) = noise(random, rows, size);
  return out;
}

/// Derivative of f along every coordinate: central differences of fourth order, error ~ step^4.
inline MatrixXd differences(const std::function<VectorXd(const VectorXd&)>& f, const VectorXd& at, double step = 1e-3) {
  MatrixXd out;
  VectorXd z = at;
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    const auto moved = [&](double by) {
      z[i] = at[i] + by;
      return f(z);
    };
    const VectorXd column = (8.0 * (moved(step) - moved(-step)) - (moved(2 * step) - moved(-2 * step))) / (12.0 * step);
    z[i] = at[i];
    if (i == 0) out.resize(column.size(), at.size());
    out.col(i) = column;
  }
  return out;
}

/// The problem's first guess, shaken.
inline ddp::Trajectory shaken_guess(const ddp::Problem& problem, Random& random, double size) {
  ddp::Trajectory t = problem.initial_guess({});
  for (VectorXd& x : t.x) x += noise(random, static_cast<int>(x.size()), size);
  for (VectorXd& u : t.u) u += noise(random, static_cast<int>(u.size()), size);
  return t;
}

/// Makes and breaks needed from one contact state to another.
inline int distance(const ddp::ContactState& from, const ddp::ContactState& to) {
  int count = 0;
  for (std::size_t l = 0; l < from.size(); ++l)
    if (from[l] != to[l]) count += from[l] != ddp::kFree && to[l] != ddp::kFree ? 2 : 1;
  return count;
}

/// A random walk through the contact states from start to goal.
inline ddp::ContactSequence random_sequence(const ddp::Problem& problem, Random& random) {
  const int n = problem.steps;
  for (;;) {
    ddp::ContactSequence sequence{problem.start_contacts};
    while (static_cast<int>(sequence.size()) <= n) {
      std::vector<ddp::ContactState> next;
      for (const auto& state : problem.rules.successors(sequence.back()))
        if (distance(state, problem.goal_contacts) <= n - static_cast<int>(sequence.size())) next.push_back(state);
      if (next.empty()) break;
      sequence.push_back(next[random() % next.size()]);
    }
    if (static_cast<int>(sequence.size()) == n + 1 && problem.rules.valid(sequence)) return sequence;
  }
}

/// Every valid sequence from start to goal, by trying all states at all steps in between.
inline std::vector<ddp::ContactSequence> every_sequence(const ddp::Problem& problem) {
  std::vector<ddp::ContactState> states{{}};
  for (int l = 0; l < problem.layout.end_effector_count(); ++l) {
    std::vector<ddp::ContactState> longer;
    for (const auto& state : states) {
      std::vector<int> choices = problem.rules.surfaces(l);
      choices.push_back(ddp::kFree);
      for (int contact : choices) {
        longer.push_back(state);
        longer.back().push_back(contact);
      }
    }
    states = longer;
  }
  std::vector<ddp::ContactSequence> out;
  std::vector<std::size_t> digit(problem.steps - 1, 0);
  for (;;) {
    ddp::ContactSequence sequence{problem.start_contacts};
    for (std::size_t d : digit) sequence.push_back(states[d]);
    sequence.push_back(problem.goal_contacts);
    if (problem.rules.valid(sequence)) out.push_back(sequence);
    std::size_t i = 0;
    while (i < digit.size() && ++digit[i] == states.size()) digit[i++] = 0;
    if (i == digit.size()) return out;
  }
}

inline ddp::Schedule schedule(double contact, double interior, double proximal) {
  ddp::Schedule out;
  out.contact_weight = contact;
  out.interior_weight = interior;
  out.proximal_weight = proximal;
  return out;
}

inline mcplan::ddp::Options phases(int n, ddp::Model model = ddp::Options().model) {
  mcplan::ddp::Options options;
  options.phases = n;
  options.model = model;
  return options;
}

/// Most code serves both.
constexpr ddp::Model kModels[] = {ddp::Model::wrench, ddp::Model::lipm};

inline std::string name(ddp::Model model) { return model == ddp::Model::wrench ? "wrench" : "lipm"; }

/// The gap with a ramp on its far side and an upright wall for either hand: the feet's surfaces have different normals,
/// and so do the hands'.
inline mcplan::Scene gap_with_walls() {
  mcplan::Scene scene = scenes::gap();
  scene.name = "gap_with_walls";
  for (auto& v : scene.surfaces[1].vertices_W) v.z() += 0.3 * (v.x() - 1.3);
  scene.goal.position_W.z() = 0.3 * 0.7;
  for (double side : {-1.0, 1.0}) {
    mcplan::Surface wall;
    wall.name = side < 0 ? "right_wall" : "left_wall";
    wall.end_effectors = {"hand"};
    wall.friction = 0.5;
    const double y = 0.4 * side;
    wall.vertices_W = {{0.5, y, 0.5}, {1.3, y, 0.5}, {1.3, y, 1.2}, {0.5, y, 1.2}};
    if (side < 0) std::reverse(wall.vertices_W.begin(), wall.vertices_W.end());
    scene.surfaces.push_back(wall);
  }
  return scene;
}

/// The paper's four scenes and one of many normals.
inline std::vector<mcplan::Scene> scenes_of_all_kinds() {
  std::vector<mcplan::Scene> out = scenes::all_four();
  out.push_back(gap_with_walls());
  return out;
}

}  // namespace support
