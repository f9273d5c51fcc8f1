#pragma once

#include <Eigen/Core>
#include <vector>

#include "mcplan/nlp/problem.hpp"

namespace mcplan::ipm {

/// What a problem leaves to solve for. Variables whose bounds are equal are constants and no unknowns; rows whose
/// limits are equal are equalities, the others inequalities with a slack each, and rows without limits are left out.
/// Equal is also what differs by rounding errors: a barrier in between would have no room.
struct Unknowns {
  /// scaled: rows with two limits are multiplied by 2 / (upper - lower), at most by 20.
  Unknowns(const nlp::Problem& problem, bool scaled);

  /// Of what is no nlp::Problem: `count` variables, none of them fixed, so many equalities with a right side of zero,
  /// and an inequality for each further bound.
  Unknowns(int count, int equality_count, Eigen::VectorXd lower_bounds, Eigen::VectorXd upper_bounds);

  std::vector<int> free;          ///< the problem's variables that are unknowns
  std::vector<int> equalities;    ///< the problem's rows
  std::vector<int> inequalities;  ///< the problem's rows
  std::vector<int> index_of;      ///< of a variable among free, or -1
  std::vector<int> equality_of;   ///< of a row among equalities, or -1
  std::vector<int> slack_of;      ///< of a row among inequalities, or -1
  Eigen::VectorXd right_side;     ///< of the equalities
  Eigen::VectorXd scale;          ///< of each inequality: its row is multiplied by it
  Eigen::VectorXd lower, upper;   ///< of the free variables, then of the slacks, which are scaled

  int free_count() const { return static_cast<int>(free.size()); }
  int equality_count() const { return static_cast<int>(equalities.size()); }
  int slack_count() const { return static_cast<int>(inequalities.size()); }
};

}  // namespace mcplan::ipm
