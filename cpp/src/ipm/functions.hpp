#pragma once

#include <Eigen/Core>
#include <string>

#include "ipm/jacobian.hpp"
#include "ipm/oracle.hpp"
#include "ipm/unknowns.hpp"
#include "mcplan/base/deadline.hpp"
#include "mcplan/nlp/problem.hpp"
#include "mcplan/nlp/solver.hpp"

namespace mcplan::ipm {

/// The problem's functions in terms of the unknowns, with the clock, and the best point of all that were evaluated.
/// Throws Halt at the time limit, and where a number is not finite.
class Functions : public Oracle {
 public:
  Functions(const nlp::Problem& problem, const Unknowns& unknowns, const nlp::SolverOptions& options,
            const Deadline& deadline);

  /// Cost and rows at point.t, whose slacks are taken as they are.
  void evaluate(Point& point) override;

  /// Gradient of the cost, in the free variables; the Jacobian goes to the system.
  void derivatives(const Point& point, Eigen::VectorXd& gradient, LinearSystem& system) override;

  /// Hessian of cost_factor * cost + equalities' + inequalities' multipliers; valid until the next call.
  const Eigen::VectorXd& hessian(const Point& point, double cost_factor, const Eigen::VectorXd& equalities,
                                 const Eigen::VectorXd& inequalities) override;
  void gauss_newton_hessian(const Point& point, Eigen::VectorXd& values) override;  ///< of the cost

  /// Largest violation of rows and bounds, slacks aside.
  double violation(const Point& point) const override;

  const Eigen::VectorXd& best_x() const { return best_x_; }
  double evaluation_s() const { return evaluation_s_; }
  int iterations() const override { return iterations_; }  ///< begun, of phase one and of the barrier method
  const Deadline& deadline() const override { return deadline_; }

  /// Once an iteration, at its begin: the time that the caller needs afterwards, and whether to stop.
  void begin_iteration() override;

 private:
  void look_at_clock();
  template <class Function>
  void clocked(const Eigen::VectorXd& x, const Function& function);

  const nlp::Problem& problem_;
  const Unknowns& unknowns_;
  const nlp::SolverOptions& options_;
  const Deadline& deadline_;
  Eigen::VectorXd rows_, gradient_, hessian_, multipliers_;
  Jacobian jacobian_;
  Eigen::VectorXd best_x_;
  double best_violation_ = nlp::kInfinity, best_cost_ = nlp::kInfinity;
  double evaluation_s_ = 0.0, reserved_s_ = 0.0, left_s_ = 0.0, longest_s_ = 0.0;
  int iterations_ = 0;
};

}  // namespace mcplan::ipm
