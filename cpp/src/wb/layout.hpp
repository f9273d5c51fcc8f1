#pragma once

#include <vector>

#include "mcplan/wb/problem.hpp"
#include "wb/spline.hpp"

namespace mcplan::wb {

/// Where unknowns and rows of a node lie. Unknowns: coefficients of the splines, then node by node the forces along the
/// edges of friction pyramids, then node by node two for each elastic row, by which it falls short of its lower limit
/// and exceeds its upper one.
struct NodeLayout {
  int first_force = 0, forces = 0;
  int first_elastic = 0;
  /// Equalities: base (6), poses of contacts, velocities of contacts that rest, velocity of all where the robot rests.
  int first_equality = 0, poses = 0, still = 0;
  bool at_rest = false;
  /// Inequalities: positions of joints, which are not elastic; their velocities; torques; tubes; pairs of capsules;
  /// loads of contacts that have a limit, of which these are the numbers among the wrenches of contacts that carry.
  int first_row = 0, tubes = 0, pairs = 0;
  std::vector<int> loads;
  int first_swing = 0;  ///< rows of cost: of end-effectors in the air
  int swings = 0;
};

class Layout {
 public:
  explicit Layout(const Problem& problem);

  int velocities, joints, nodes;
  int coefficients;  ///< of all splines
  int variables = 0, equalities = 0, rows = 0, elastic_rows = 0;
  std::vector<NodeLayout> node;
  std::vector<double> weight;  ///< of a node in the cost: rate times the time that it stands for
  Spline spline;

  /// The column of a node's first spline coefficient.
  int window(int k) const { return k * velocities; }
  int equality_count(int k) const { return 6 + node[k].poses + node[k].still + (node[k].at_rest ? velocities : 0); }
  int row_count(int k) const { return limit_count(k) + static_cast<int>(node[k].loads.size()); }
  /// Of a robot and its surroundings: all but loads.
  int limit_count(int k) const { return 3 * joints + node[k].tubes + node[k].pairs; }
  int elastic_count(int k) const { return row_count(k) - joints; }
  /// Rows that depend on the configuration alone: poses, tubes, pairs, and of the cost swings and the CoM.
  int placed_count(int k) const { return node[k].poses + node[k].tubes + node[k].pairs + node[k].swings + 3; }
};

/// Rows of a contact's pose or of a swing.
inline int pose_rows(const EndEffector& end) { return end.is_point() ? 3 : 6; }

/// Edges of friction pyramids at one point.
inline constexpr int kEdges = 4;

}  // namespace mcplan::wb
