#pragma once

#include <Eigen/Core>
#include <string>

#include "ipm/linear_system.hpp"
#include "mcplan/base/deadline.hpp"
#include "mcplan/nlp/solver.hpp"

namespace mcplan::ipm {

/// A point and the values of the problem's functions there.
struct Point {
  Eigen::VectorXd x;  ///< all variables of the problem
  Eigen::VectorXd t;  ///< free variables, then slacks
  double cost = 0.0;
  Eigen::VectorXd equalities;    ///< minus their right side: zero where they hold
  Eigen::VectorXd inequalities;  ///< of which the slacks are to be the values

  auto slack_error() const { return inequalities - t.tail(inequalities.size()); }
};

/// Why a solve has to end now.
struct Halt {
  nlp::Outcome outcome = nlp::Outcome::converged;
  std::string message;
};

/// What the barrier method asks of a problem in terms of its unknowns. Throws Halt at the time limit, and where a
/// number is not finite.
class Oracle {
 public:
  virtual ~Oracle() = default;

  /// Cost and rows at point.t, whose slacks are taken as they are.
  virtual void evaluate(Point& point) = 0;

  /// Gradient of the cost, in the free variables; the Jacobian goes to the system.
  virtual void derivatives(const Point& point, Eigen::VectorXd& gradient, LinearSystem& system) = 0;

  /// Hessian of cost_factor * cost + equalities' + inequalities' multipliers; valid until the next call.
  virtual const Eigen::VectorXd& hessian(const Point& point, double cost_factor, const Eigen::VectorXd& equalities,
                                         const Eigen::VectorXd& inequalities) = 0;
  virtual void gauss_newton_hessian(const Point& point, Eigen::VectorXd& values) = 0;  ///< of the cost

  /// Largest violation of rows and bounds, slacks aside.
  virtual double violation(const Point& point) const = 0;

  /// Once an iteration, at its begin: the time that the caller needs afterwards, and whether to stop.
  virtual void begin_iteration() = 0;

  virtual int iterations() const = 0;  ///< begun, of phase one and of the barrier method
  virtual const Deadline& deadline() const = 0;
};

}  // namespace mcplan::ipm
