#pragma once

#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "mcplan/nlp/derivative_check.hpp"
#include "mcplan/nlp/problem.hpp"
#include "rhp/pieces/contact_point.hpp"
#include "rhp/walkers.hpp"

namespace mcplan::rhp::tests {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using walkers::Random;

/// Jacobian and Hessian of one piece agree with differences at ten random points.
inline void expect_derivatives(const nlp::Piece& piece, unsigned seed) {
  Random random(seed);
  for (int trial = 0; trial < 10; ++trial)
    for (const auto& wrong : nlp::check_derivatives(piece, random.vector(piece.size(), 2.0)))
      FAIL_CHECK("seed " << seed << ", trial " << trial << ": " << wrong.to_string());
}

inline VectorXd values(const nlp::Piece& piece, const VectorXd& x) {
  VectorXd out(piece.rows());
  piece.values(x, out);
  return out;
}

/// Builders add linear rows to a problem: whether x keeps its rows and bounds, and by how much.
inline double violation(const nlp::Problem& problem, const VectorXd& x) { return problem.worst_violation(x).value; }

/// Derivatives of all pieces that a builder added, and that its rows are what finish() takes them for.
inline void expect_derivatives(const nlp::Problem& problem, unsigned seed) {
  Random random(seed);
  const VectorXd x = random.vector(problem.variable_count(), 2.0);
  for (const auto& wrong : nlp::check_derivatives(problem, x)) FAIL_CHECK("seed " << seed << ": " << wrong.to_string());
}

/// A foot on a surface that is turned and tilted at random, its two coordinates the variables `variable`, + 1.
inline Placement random_placement(Random& random, int variable) {
  Placement out;
  out.origin_W = random.three();
  out.axes_W = random.rotation();
  out.variable = variable;
  return out;
}

}  // namespace mcplan::rhp::tests
