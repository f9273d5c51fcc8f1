// The solve. It, the adapter and the endings alone include Ipopt, whose traps are listed in docs/theory/nlp.md.

#include <pthread.h>

#include <IpIpoptApplication.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "mcplan/base/error.hpp"
#include "mcplan/nlp/solver.hpp"
#include "nlp/has_ipopt.hpp"
#include "nlp/ipopt_adapter.hpp"
#include "nlp/ipopt_ending.hpp"
#include "nlp/ipopt_fork_gate.hpp"
#include "nlp/ipopt_version.hpp"
#include "nlp/start.hpp"

namespace mcplan::nlp {
namespace {

using Eigen::VectorXd;

void set_options(Ipopt::OptionsList& list, const SolverOptions& options) {
  list.SetIntegerValue("print_level", 0);
  list.SetStringValue("sb", "yes");
  list.SetStringValue("linear_solver", "mumps");
  if (options.ordering == Ordering::amd) list.SetIntegerValue("mumps_pivot_order", 0);
  list.SetStringValue("hessian_approximation", options.hessian == Hessian::exact ? "exact" : "limited-memory");
  list.SetStringValue("mu_strategy", options.adaptive_barrier ? "adaptive" : "monotone");
  list.SetNumericValue("mu_init", options.initial_barrier);
  list.SetStringValue("nlp_scaling_method", options.gradient_scaling ? "gradient-based" : "none");
  // Refine a step only where its residual asks for it: a tenth of the time of a solve.
  list.SetIntegerValue("min_refinement_steps", 0);
  list.SetIntegerValue("max_iter", options.max_iterations);
  list.SetNumericValue("tol", options.tolerance);
  list.SetNumericValue("constr_viol_tol", options.constraint_tolerance);
  list.SetNumericValue("compl_inf_tol", std::max(1e-4, options.tolerance));
  list.SetNumericValue("dual_inf_tol", std::max(1.0, options.tolerance));
  // "Acceptable" is no reason to stop early, only what a point is called at which Ipopt is stuck, and must be feasible.
  list.SetIntegerValue("acceptable_iter", 0);
  list.SetNumericValue("acceptable_tol", 100.0 * options.tolerance);
  list.SetNumericValue("acceptable_constr_viol_tol", options.constraint_tolerance);
  // Bounds hold exactly: a normal force is never negative, a step never longer than the reach.
  list.SetNumericValue("bound_relax_factor", 0.0);
  list.SetStringValue("fixed_variable_treatment", "make_parameter");
#if MCPLAN_IPOPT_AT_LEAST(3, 14)
  list.SetStringValue("timing_statistics", "yes");
#endif
}

constexpr bool kReentrant = MCPLAN_IPOPT_AT_LEAST(3, 14);

/// The process-wide lock of the solves. A child of fork() gets one of its own: the thread that held its parent's is not
/// there to let go of it.
std::timed_mutex* the_lock = new std::timed_mutex;
[[maybe_unused]] const int at_fork = pthread_atfork(nullptr, nullptr, [] { the_lock = new std::timed_mutex; });

/// Holds the lock while it lives: neither Ipopt before 3.14 nor its MUMPS is re-entrant.
class Turn {
 public:
  explicit Turn(const Deadline& deadline) : lock_(*the_lock, std::defer_lock) {
    if (kReentrant) return;
    if (inside())
      throw InvalidInput("solve", "must not be called from within a solve, by a piece, a logger or a stop request",
                         "a nested call");
    if (!deadline.limited()) lock_.lock();
    constexpr std::chrono::milliseconds kLook{2};
    while (!lock_.owns_lock() && !lock_.try_lock_for(kLook) && !deadline.passed()) continue;
    inside() = lock_.owns_lock();
  }
  ~Turn() {
    if (lock_.owns_lock()) inside() = false;
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

  bool mine() const { return kReentrant || lock_.owns_lock(); }

 private:
  static bool& inside() {
    static thread_local bool flag = false;
    return flag;
  }
  std::unique_lock<std::timed_mutex> lock_;
};

Ending run(const Problem& problem, const VectorXd& x0, IpoptAdapter& adapter, const SolverOptions& options,
           const Deadline& deadline) {
  const std::string impossible = contradiction(problem);
  if (!impossible.empty()) return {Outcome::infeasible, impossible, false};
  // Without a free variable there is nothing to optimise, and Ipopt's versions disagree on how to say so.
  if (problem.variable_lower() == problem.variable_upper()) {
    const Verdict verdict = judge_fixed(problem, x0, options.constraint_tolerance);
    return {verdict.outcome, verdict.message, true};
  }
  const Turn turn(deadline);
  if (!turn.mine()) return {Outcome::time_limit, "reached time_limit_s while another solve was running", false};
  adapter.begin();
  const ForkGate gate;
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  set_options(*application->Options(), options);
  Ipopt::ApplicationReturnStatus code = application->Initialize("");  // no name: no ipopt.opt is read
  if (code == Ipopt::Solve_Succeeded) code = application->OptimizeTNLP(&adapter);
  adapter.rethrow();
  if (adapter.reason() == IpoptAdapter::Reason::time) return {Outcome::time_limit, "reached time_limit_s", false};
  if (adapter.reason() == IpoptAdapter::Reason::stop) return {Outcome::interrupted, "stopped by the caller", false};
  if (adapter.reason() == IpoptAdapter::Reason::not_finite)
    return {Outcome::numerical_failure, "not finite: " + adapter.not_finite(), false};
  return ending_of(code, adapter.feasible());
}

}  // namespace

Solution solve(const Problem& problem, const VectorXd& x0, const SolverOptions& options) {
  const Deadline deadline(options.time_limit_s, options.clock);
  options.validate();
  const VectorXd x = start_of(problem, x0);
  Ipopt::SmartPtr<IpoptAdapter> adapter = new IpoptAdapter(problem, x, options, deadline);
  const Ending ending = run(problem, x, *adapter, options, deadline);

  Solution out;
  out.outcome = ending.outcome;
  out.message = ending.message;
  // Ipopt moves a bound by some 1e-12 where it would divide by the distance to it.
  out.x = projected(problem, ending.keep_last ? adapter->last_x() : adapter->best_x());
  out.multipliers = adapter->multipliers();
  out.cost = problem.cost(out.x);
  out.worst = problem.worst_violation(out.x);
  out.iterations = adapter->iterations();
  out.evaluation_s = adapter->evaluation_s();
  out.linear_solver_s = adapter->linear_solver_s();
  out.start_s = adapter->start_s();
  out.time_s = deadline.elapsed_s();
  return out;
}

bool has_ipopt() { return true; }

std::string ipopt_version() { return IPOPT_VERSION; }

}  // namespace mcplan::nlp
