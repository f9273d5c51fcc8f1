#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <string>

#include "mcplan/base/logging.hpp"
#include "mcplan/nlp/solver.hpp"
#include "mcplan/wb/problem.hpp"

namespace mcplan::wb {

struct Options {
  double constraint_tolerance = 3e-4;  ///< on scaled rows: 0.03 N, 0.03 mm, 0.03 mrad, parts of limits
  double cost_tolerance = 1e-4;        ///< on the relative change of the cost in a step
  double tolerance = 1e-5;             ///< on the optimality error; a tenth of it is the least barrier parameter
  double initial_barrier = 0.1;
  int max_iterations = 100;
  double time_limit_s = std::numeric_limits<double>::infinity();  ///< wall clock
  Logger logger;                                                  ///< one line an iteration
  StopRequest stop;                                               ///< polled at every evaluation
};

struct Solution {
  nlp::Outcome outcome = nlp::Outcome::numerical_failure;
  std::string message;
  Eigen::VectorXd x;     ///< unknowns
  double cost = 0.0;     ///< without what elastic variables cost
  double penalty = 0.0;  ///< what they do
  double violation = 0.0;
  int iterations = 0;
  double time_s = 0.0, evaluation_s = 0.0, linear_solver_s = 0.0;  ///< wall clock
};

/// One motion problem: its unknowns are coefficients of splines, forces along the edges of friction pyramids, and by
/// how much elastic limits are exceeded.
class Solver {
 public:
  /// `callback` fills what dynamics() hands it. Throws InvalidInput.
  Solver(Problem problem, Dynamics::Callback callback);
  ~Solver();
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  const Problem& problem() const;
  Dynamics& dynamics();

  int variables() const;
  int equalities() const;
  int rows() const;

  /// Unknowns out of spline coefficients (n + 2, nv) and forces on the end-effectors' points, in their contacts' frames
  /// [N], (n, 3 * points of all end-effectors); rows that are exceeded there are given elastic variables that large.
  Eigen::VectorXd unknowns(const Dynamics::Rows& coefficients, const Dynamics::Rows& forces_S);
  Dynamics::Rows coefficients(const Eigen::VectorXd& x) const;
  Dynamics::Rows forces(const Eigen::VectorXd& x) const;

  Solution solve(const Eigen::VectorXd& start, const Options& options);

  /// For tests: cost, equalities and inequalities at x; products of their Jacobians with a step, and the gradient.
  struct Values {
    double cost = 0.0;
    Eigen::VectorXd equalities, inequalities;
  };
  Values values(const Eigen::VectorXd& x);
  struct Slopes {
    double cost = 0.0;
    Eigen::VectorXd equalities, inequalities;
  };
  Slopes slopes(const Eigen::VectorXd& x, const Eigen::VectorXd& step);

  /// By how much the limits of node k are used at x: rows of positions, velocities, torques (over their limits), then
  /// of tubes and pairs [m] beyond the nearer limit, positive outside.
  Dynamics::Rows usage(const Eigen::VectorXd& x);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace mcplan::wb
