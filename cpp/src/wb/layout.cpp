#include "wb/layout.hpp"

namespace mcplan::wb {
namespace {

std::vector<double> times_of(const Problem& problem) {
  std::vector<double> out;
  for (const Node& node : problem.nodes) out.push_back(node.time_s);
  return out;
}

}  // namespace

Layout::Layout(const Problem& problem)
    : velocities(problem.velocity_count()),
      joints(problem.joint_count()),
      nodes(problem.node_count()),
      spline(times_of(problem)) {
  coefficients = spline.coefficients() * velocities;
  variables = coefficients;
  node.resize(nodes);
  weight.resize(nodes);
  for (int k = 0; k < nodes; ++k) {
    NodeLayout& at = node[k];
    at.at_rest = k == 0 || k == nodes - 1;
    at.first_force = variables;
    at.first_equality = equalities;
    at.first_row = rows;
    int carrying = 0;
    for (const Contact& contact : problem.nodes[k].contacts) {
      const EndEffector& end = problem.end_effectors[contact.end_effector];
      at.poses += pose_rows(end);
      if (contact.rests && !at.at_rest) at.still += pose_rows(end);
      if (contact.limited()) at.loads.push_back(carrying);
      carrying += contact.carries ? 1 : 0;
      if (contact.carries) at.forces += kEdges * static_cast<int>(end.points_S.cols());
    }
    for (const Swing& swing : problem.nodes[k].swings) {
      const EndEffector& end = problem.end_effectors[swing.end_effector];
      at.swings += pose_rows(end);
      if (swing.in_tube) at.tubes += 3 * static_cast<int>(end.points_S.cols());
    }
    at.pairs = static_cast<int>(problem.pairs.size());
    variables += at.forces;
    equalities += equality_count(k);
    rows += row_count(k);
    elastic_rows += elastic_count(k);
    const double before = k > 0 ? problem.nodes[k].time_s - problem.nodes[k - 1].time_s : 0.0;
    const double after = k + 1 < nodes ? problem.nodes[k + 1].time_s - problem.nodes[k].time_s : 0.0;
    weight[k] = problem.weights.rate * 0.5 * (before + after);
  }
  for (int k = 0; k < nodes; ++k) {
    node[k].first_elastic = variables;
    variables += 2 * elastic_count(k);
  }
}

}  // namespace mcplan::wb
