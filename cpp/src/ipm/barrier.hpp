#pragma once

#include <Eigen/Core>
#include <string>

#include "ipm/filter.hpp"
#include "ipm/linear_system.hpp"
#include "ipm/oracle.hpp"
#include "ipm/unknowns.hpp"

namespace mcplan::ipm {

/// The primal-dual barrier method: Newton steps on the optimality conditions of
///
///     min f(x) - mu sum ln(t - lower) - mu sum ln(upper - t)   s.t.  c(x) = 0,  g(x) = s,   t = (x, s)
///
/// with a filter line search and second-order corrections (Wächter, Biegler 2006), while the barrier parameter mu goes
/// to zero.
class Barrier {
 public:
  Barrier(const Unknowns& unknowns, const nlp::SolverOptions& options, Oracle& functions, LinearSystem& kkt);

  struct Ending {
    nlp::Outcome outcome = nlp::Outcome::numerical_failure;
    std::string message;
  };

  /// Multipliers with which a run begins: of equalities, and of free variables and slacks, zero or more.
  struct Duals {
    Eigen::VectorXd equalities, lower, upper;
  };

  /// From point.t, moved off its bounds, while fewer than max_iterations are counted by the functions. Throws Halt.
  Ending run(Point& point, int max_iterations, const Duals* duals = nullptr);

  const Eigen::VectorXd& equality_multipliers() const { return lambda_; }
  const Eigen::VectorXd& inequality_multipliers() { return multipliers_of_slacks(); }
  Eigen::VectorXd bound_multipliers() const { return upper_dual_.head(n()) - lower_dual_.head(n()); }
  double parameter() const { return mu_; }
  double linear_solver_s() const { return linear_solver_s_; }

 private:
  struct Step {
    Eigen::VectorXd t, lambda, lower, upper;  ///< lambda: the new multipliers, not a difference
  };
  struct Errors {
    double dual = 0.0, primal = 0.0, complementarity = 0.0;
    double largest() const;
  };

  bool cost_settled(const Point& point, const Errors& now);

  int n() const { return unknowns_.free_count(); }
  const Eigen::VectorXd& multipliers_of_slacks();
  void start(Point& point, const Duals* duals);
  void find_gaps(const Point& point);
  Errors errors(const Point& point, double mu);
  bool factor(const Point& point);
  bool factor_blend(const Point& point);
  bool factor_ladder();
  void set_weights();
  /// A step towards the solution for mu, with the violations c and slack_error. With what probe() found of these, dx_
  /// and multipliers are but refined.
  void direction(double mu, const Eigen::VectorXd& c, const Eigen::VectorXd& slack_error, Step& step,
                 bool given = false);
  void probe(const Point& point);
  void follow(double mu, const Eigen::VectorXd& slack_error, Step& step);
  double max_step(const Eigen::VectorXd& d, double tau) const;
  double max_dual_step(const Step& step, double tau) const;
  void choose_mu(const Point& point, const Errors& now);
  void raise_mu();
  double probed_mu(const Point& point, double average);
  double average_complementarity() const;

  double theta(const Point& point) const;
  double barrier_cost(const Point& point, double mu) const;
  bool search(Point& point, Step& step);
  bool acceptable(double theta_trial, double phi_trial, double alpha, bool& armijo);
  bool correct(const Point& point, const Point& trial, double max_alpha, Step& step);
  void take(Point& point, const Step& step, double alpha, double alpha_dual);
  void log(const Point& point, const Errors& now, const Step& step);

  const Unknowns& unknowns_;
  const nlp::SolverOptions& options_;
  Oracle& functions_;
  LinearSystem& kkt_;
  const bool probing_;  ///< the barrier parameter, from a start that no phase one has moved
  Filter filter_{nlp::kInfinity};
  Eigen::VectorXd gradient_, lambda_, lower_dual_, upper_dual_;
  Eigen::VectorXd gap_lower_, gap_upper_;          ///< distances to the bounds, kNoBound where there is none
  Eigen::VectorXd inverse_lower_, inverse_upper_;  ///< of the gaps, zero where there is no bound
  Eigen::VectorXd has_lower_, has_upper_;          ///< one where there is a bound, else zero
  Eigen::VectorXd base_lower_, base_upper_;        ///< minus the lower and the upper bound, one where there is none
  int bound_count_ = 0;
  Eigen::VectorXd pull_;  ///< gradient of the barrier's terms, over mu
  // Workspace of the iterations.
  Eigen::VectorXd right_a_, right_b_, weights_, slack_error_, slack_work_, slack_multipliers_;
  Eigen::VectorXd dual_, dx_, corrected_equalities_, corrected_slacks_;
  Step step_, affine_, corrected_;
  LinearSystem::Solution rights_[2], at_zero_, per_mu_;  ///< right sides and solutions of probe()
  bool probed_ = false;                                  ///< in this iteration
  Point trial_;
  Eigen::VectorXd gauss_newton_, exact_, blend_;  ///< Hessians
  double part_ = 0.0;                             ///< of the exact Hessian in the blend
  double damping_ = 0.0;                          ///< of the blend, after steps cut short
  double mu_ = 0.1, delta_ = 0.0, last_delta_ = 0.0;
  double theta_now_ = 0.0, phi_now_ = 0.0, slope_ = 0.0, theta_min_ = 0.0;
  bool fixed_mu_ = false;  ///< monotone: the barrier falls when its problem is solved
  static constexpr int kHistory = 4;
  std::vector<double> history_;  ///< of optimality errors, the last kHistory
  bool header_written_ = false;
  int trials_ = 0;
  int short_steps_ = 0, cut_steps_ = 0;  ///< in a row
  double last_cost_ = 0.0;               ///< of the iteration before
  double alpha_ = 0.0, alpha_dual_ = 0.0, linear_solver_s_ = 0.0;
};

}  // namespace mcplan::ipm
