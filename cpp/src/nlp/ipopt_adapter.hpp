#pragma once

#include <Eigen/Core>
#include <IpIpoptData.hpp>
#include <IpTNLP.hpp>
#include <exception>
#include <string>
#include <vector>

#include "mcplan/base/deadline.hpp"
#include "mcplan/nlp/problem.hpp"
#include "mcplan/nlp/solver.hpp"

namespace mcplan::nlp {

/// A Problem as Ipopt asks for it. Ipopt's pointers are mapped, nothing is copied or allocated in an evaluation. Keeps
/// the best of all points, the clocks, and why it stopped Ipopt.
class IpoptAdapter : public Ipopt::TNLP {
 public:
  using Index = Ipopt::Index;
  using Number = Ipopt::Number;

  /// Refers to problem, options and deadline.
  IpoptAdapter(const Problem& problem, const Eigen::VectorXd& x0, const SolverOptions& options,
               const Deadline& deadline);

  /// Why the adapter stopped Ipopt.
  enum class Reason { none, time, stop, not_finite, exception };

  /// The solve begins now, after what it may have had to wait for.
  void begin();

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override;
  bool get_bounds_info(Index, Number* x_lower, Number* x_upper, Index, Number* g_lower, Number* g_upper) override;
  bool get_starting_point(Index n, bool init_x, Number* x, bool init_z, Number*, Number*, Index, bool init_lambda,
                          Number*) override;
  bool eval_f(Index n, const Number* x, bool new_x, Number& cost) override;
  bool eval_grad_f(Index n, const Number* x, bool new_x, Number* gradient) override;
  bool eval_g(Index n, const Number* x, bool new_x, Index m, Number* g) override;
  bool eval_jac_g(Index n, const Number* x, bool new_x, Index, Index entries, Index* rows, Index* columns,
                  Number* values) override;
  bool eval_h(Index n, const Number* x, bool new_x, Number cost_factor, Index m, const Number* multipliers, bool,
              Index entries, Index* rows, Index* columns, Number* values) override;
  bool intermediate_callback(Ipopt::AlgorithmMode mode, Index iteration, Number cost, Number violation,
                             Number dual_violation, Number barrier, Number step, Number regularization, Number alpha_du,
                             Number alpha_pr, Index trials, const Ipopt::IpoptData* data,
                             Ipopt::IpoptCalculatedQuantities*) override;
  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*, const Number*, Index m,
                         const Number*, const Number* multipliers, Number, const Ipopt::IpoptData* data,
                         Ipopt::IpoptCalculatedQuantities*) override;

  Reason reason() const { return reason_; }
  const Eigen::VectorXd& best_x() const { return best_.x; }
  const Eigen::VectorXd& last_x() const { return last_x_; }
  const Eigen::VectorXd& multipliers() const { return multipliers_; }
  const std::string& not_finite() const { return not_finite_; }
  int iterations() const { return iterations_; }
  double evaluation_s() const { return evaluation_s_; }
  double start_s() const { return start_s_; }
  double linear_solver_s() const { return regular_s_ + restorations_s_ + restoration_s_; }
  bool feasible() const { return best_.violation <= options_.constraint_tolerance; }

  /// Throws what an evaluation, the logger or the stop request threw, if one did.
  void rethrow() const;

 private:
  /// The point to return when a solve does not converge: feasible and cheapest, or else least violated. Line-search
  /// trials count like iterates.
  struct Best {
    Eigen::VectorXd x;
    double violation = kInfinity;
    double cost = kInfinity;
  };

  /// One evaluation of the problem: clock, deadline, exceptions and numbers that are not finite.
  template <class Function>
  bool evaluate(Index n, const Number* x, bool new_x, Number* out, Index size, const Function& function);

  /// Whether the limit has passed or would pass within the next iteration, taken to last as long as the longer of the
  /// last two: a factorisation cannot be interrupted. What comes before the first iteration counts as one, since it
  /// has a factorisation of the same size.
  bool out_of_time();

  /// What the caller needs afterwards, but no more than half of the limit.
  void reserve();

  [[noreturn]] void halt(Reason reason);
  [[noreturn]] void halt_with_exception();

  /// Keep the point of the last evaluations if it is the best. Ipopt asks for cost and rows in either order, and in a
  /// restoration phase perhaps for the rows alone.
  void consider(Index n, const Number* x);

  /// A restoration phase has clocks of its own, which start from zero each time.
  void clock_linear_solver(const Ipopt::IpoptData* data, bool restoration);

  const Problem& problem_;
  const SolverOptions& options_;
  const Deadline& deadline_;
  double left_s_ = 0.0, before_s_ = 0.0;  ///< left when the last iteration ended, and how long it took
  double reserved_s_ = 0.0, start_s_ = 0.0;
  const Eigen::VectorXd x0_;

  bool cost_known_ = false, rows_known_ = false;  ///< at Ipopt's current x
  double cost_ = 0.0, row_violation_ = 0.0;
  Best best_;
  Eigen::VectorXd last_x_, multipliers_;

  Reason reason_ = Reason::none;
  std::exception_ptr thrown_;
  std::string not_finite_;
  bool header_written_ = false;
  int iterations_ = 0;
  double evaluation_s_ = 0.0;
  double regular_s_ = 0.0, restorations_s_ = 0.0, restoration_s_ = 0.0;
};

}  // namespace mcplan::nlp
