#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <string>

#include "mcplan/base/deadline.hpp"
#include "mcplan/base/logging.hpp"
#include "mcplan/base/status.hpp"
#include "mcplan/nlp/problem.hpp"

namespace mcplan::nlp {

/// Which solver a planner hands its programs to.
enum class Solver {
  ipopt,      ///< Ipopt with MUMPS: the reference
  ipm,        ///< the interior-point kernel of the room ipm, which goes stage by stage
  automatic,  ///< the kernel; where it does not converge, Ipopt with what is left of the time
};

/// How pivots are ordered before the factorisation; which is faster depends on the problem, by up to a factor of two.
enum class Ordering { automatic, amd };

/// Where second derivatives come from.
enum class Hessian { exact, limited_memory };

struct SolverOptions {
  double tolerance = 1e-5;             ///< on the optimality error
  double constraint_tolerance = 1e-6;  ///< on rows and bounds, absolute
  int max_iterations = 400;
  double time_limit_s = std::numeric_limits<double>::infinity();  ///< wall clock, looked at in every evaluation
  Ordering ordering = Ordering::amd;
  Hessian hessian = Hessian::exact;
  double initial_barrier = 0.1;
  bool adaptive_barrier = false;
  /// What the kernel alone looks at.
  struct Kernel {
    /// For starts far from all that holds: the kernel goes towards a point without violations before its barrier
    /// method, not only where that fails, and scales rows by the widths of their limits.
    bool distant_start = false;
    bool feasible_is_enough = false;  ///< a solve ends at the first iterate within constraint_tolerance
    /// Second derivatives are those of Piece::gauss_newton_hessian() while rows are violated, and then as much of the
    /// difference to the exact ones as leaves the system's inertia as it should be.
    bool blend_hessians = false;
    /// Where the Hessian is Gauss and Newton's, steps that hardly change the cost any more may go on for long: a solve
    /// ends, too, at a point within constraint_tolerance after a step by which the cost changed relatively by no more
    /// than this; 0: never.
    double cost_tolerance = 0.0;
  } kernel;
  /// Multipliers of an earlier solve of a problem like this one, with which the kernel's barrier method begins: as
  /// Solution has them, of the rows and of the variables' bounds. Empty: none. A start is then moved off its limits no
  /// further than initial_barrier over their multipliers, so that with Solution::barrier as initial_barrier a solve
  /// goes on where another one was cut short.
  struct Start {
    Eigen::VectorXd multipliers, bound_multipliers;
  } start;
  bool gradient_scaling = true;  ///< Ipopt scales costs and rows by their gradients at x0; off for well-scaled problems
  Logger logger;                 ///< one line an iteration; null: silent
  StopRequest stop;              ///< polled once an iteration; null: never
  Clock clock;                   ///< what time_limit_s is measured by; null: the steady clock
  /// What the caller still does with a point after the solve takes so long [s]. The solve ends earlier by that of the
  /// best point so far, but after half of the limit at least; asked once an iteration; null: nothing is kept.
  std::function<double(const Eigen::VectorXd&)> finishing_s;

  /// Throws InvalidOptions naming the first field out of its range.
  void validate() const;
};

/// How a solve ended. It says nothing about a plan, which is judged by its checker (Status).
enum class Outcome {
  converged,          ///< within the tolerances
  nearly_converged,   ///< feasible, and no further progress is made
  infeasible,         ///< the violation is locally least and not zero, or bounds contradict each other
  iteration_limit,    ///< the best point of the iterations is returned
  time_limit,         ///< the best point until then is returned
  interrupted,        ///< the caller has stopped the solve
  numerical_failure,  ///< a step could not be computed, or a number was not finite
};

/// What a user is told, unless a checker objects: converged is solved, nearly_converged acceptable.
Status status_of(Outcome outcome);

struct Solution {
  Outcome outcome = Outcome::numerical_failure;
  Solver solver = Solver::ipopt;      ///< that found it: ipopt or ipm
  std::string message;                ///< why it ended, in one sentence
  Eigen::VectorXd x;                  ///< the solution, or the best iterate: feasible and cheap, or least violated
  Eigen::VectorXd multipliers;        ///< of the rows, at the last iterate: <= 0 at a lower limit, >= 0 at an upper one
  Eigen::VectorXd bound_multipliers;  ///< of the variables, of the same signs; empty where Ipopt found x
  double barrier = 0.0;               ///< the kernel's barrier parameter at the end; 0 where Ipopt found x
  double cost = 0.0;
  Problem::Worst worst;  ///< largest violation at x
  int iterations = 0;
  double time_s = 0.0;           ///< wall clock
  double evaluation_s = 0.0;     ///< of which in the problem's functions
  double linear_solver_s = 0.0;  ///< of which in factorisations and back-substitutions
  double start_s = 0.0;          ///< until x0 was evaluated and its multipliers were found; 0: it did not come to that
};

/// Solve with Ipopt from x0 (projected into the bounds).
///
/// Ipopt before 3.14 and its MUMPS are not re-entrant: calls wait for each other, process-wide. The problem's finish()
/// must have been called, and a Problem serves one thread at a time. Rethrows what a piece throws; a number that is not
/// finite ends with numerical_failure and a message that names the piece.
Solution solve(const Problem& problem, const Eigen::VectorXd& x0, const SolverOptions& options = {});

/// Version of the Ipopt that is linked, e.g. "3.11.9".
std::string ipopt_version();

}  // namespace mcplan::nlp
