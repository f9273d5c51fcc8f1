// The only file that includes Ipopt. Its traps, and what is done about them here, are listed in docs/theory/nlp.md.

#include <IpoptConfig.h>
#include <pthread.h>

#include <IpIpoptApplication.hpp>
#include <IpIpoptData.hpp>
#include <IpTNLP.hpp>
#include <IpTimingStatistics.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <mutex>
#include <utility>

#include "mcplan/base/error.hpp"
#include "mcplan/nlp/solver.hpp"

#define MCPLAN_IPOPT_AT_LEAST(major, minor) \
  (IPOPT_VERSION_MAJOR > (major) || (IPOPT_VERSION_MAJOR == (major) && IPOPT_VERSION_MINOR >= (minor)))

namespace mcplan::nlp {
namespace {

using Eigen::VectorXd;
using Ipopt::Index;
using Ipopt::Number;

/// How a solve ends, and whether Ipopt's last iterate is the one to return (otherwise the best of all points).
struct Ending {
  Outcome outcome = Outcome::numerical_failure;
  std::string message;
  bool keep_last = false;
};

/// Ipopt's endings one by one. `feasible`: some point seen satisfies the constraints.
Ending ending_of(Ipopt::ApplicationReturnStatus code, bool feasible) {
  switch (code) {
    case Ipopt::Solve_Succeeded:
      return {Outcome::converged, "converged", true};
    case Ipopt::Solved_To_Acceptable_Level:
      return {Outcome::nearly_converged, "no further progress; the optimality error is within 100 times the tolerance",
              true};
    case Ipopt::Feasible_Point_Found:  // as many equalities as variables: feasible is all that can be asked for
      return {Outcome::converged, "found the feasible point of a square problem", true};
    case Ipopt::Infeasible_Problem_Detected:
      return {Outcome::infeasible, "converged to a point at which the violation is locally least", false};
    case Ipopt::Search_Direction_Becomes_Too_Small:
      if (feasible) return {Outcome::nearly_converged, "feasible, but the steps became too small to converge", false};
      return {Outcome::numerical_failure, "the steps became too small before a feasible point was found", false};
    case Ipopt::Diverging_Iterates:
      return {Outcome::numerical_failure, "the iterates diverge; is the cost bounded from below?", false};
    case Ipopt::User_Requested_Stop:
      return {Outcome::interrupted, "stopped by the caller", false};
    case Ipopt::Maximum_Iterations_Exceeded:
      return {Outcome::iteration_limit, "reached max_iterations", false};
    case Ipopt::Maximum_CpuTime_Exceeded:
#if MCPLAN_IPOPT_AT_LEAST(3, 14)
    case Ipopt::Maximum_WallTime_Exceeded:
#endif
      return {Outcome::time_limit, "reached time_limit_s", false};
    case Ipopt::Restoration_Failed:
      return {Outcome::numerical_failure, "found no way back to feasibility, nor that there is none", false};
    case Ipopt::Error_In_Step_Computation:
      return {Outcome::numerical_failure, "the linear system of a step could not be solved", false};
    case Ipopt::Not_Enough_Degrees_Of_Freedom:
      return {Outcome::infeasible, "there are more equalities than free variables", false};
    case Ipopt::Invalid_Problem_Definition:
      return {Outcome::infeasible, "Ipopt finds a contradiction in the bounds", false};
    case Ipopt::Invalid_Number_Detected:
      return {Outcome::numerical_failure, "a number in Ipopt's own computation is not finite", false};
    case Ipopt::Invalid_Option:
      return {Outcome::numerical_failure, "Ipopt refused an option; is it built without MUMPS?", false};
    case Ipopt::Insufficient_Memory:
      return {Outcome::numerical_failure, "out of memory", false};
    case Ipopt::Unrecoverable_Exception:
    case Ipopt::NonIpopt_Exception_Thrown:
    case Ipopt::Internal_Error:
      break;
  }
  return {Outcome::numerical_failure, "internal error of Ipopt", false};
}

/// Thrown through Ipopt, which hands it to nobody but ends at once: `false` from an evaluation would only shorten the
/// step, fifty times over. The reason stands in the Adapter.
struct Halt {};

/// The point to return when a solve does not converge: feasible and cheapest, or else least violated. Line-search
/// trials count like iterates.
struct Best {
  VectorXd x;
  double violation = kInfinity;
  double cost = kInfinity;
};

double largest_violation(const double* values, const std::vector<double>& lower, const std::vector<double>& upper) {
  double worst = 0.0;
  for (std::size_t i = 0; i < lower.size(); ++i)
    worst = std::max(worst, std::max(lower[i] - values[i], values[i] - upper[i]));
  return worst;
}

/// A Problem as Ipopt asks for it. Ipopt's pointers are mapped, nothing is copied or allocated in an evaluation.
class Adapter : public Ipopt::TNLP {
 public:
  Adapter(const Problem& problem, const VectorXd& x0, const SolverOptions& options, const Deadline& deadline)
      : problem_(problem), options_(options), deadline_(deadline), x0_(x0) {
    best_.x = x0;
    last_x_ = x0;
    multipliers_ = VectorXd::Zero(problem.row_count());
  }

  enum class Reason { none, time, stop, not_finite, exception };

  /// The solve begins now, after what it may have had to wait for.
  void begin() {
    if (!deadline_.limited()) return;
    left_s_ = deadline_.remaining_s();
    reserve();
  }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override {
    n = problem_.variable_count();
    m = problem_.row_count();
    jacobian = static_cast<Index>(problem_.jacobian_structure().size());
    hessian = static_cast<Index>(problem_.hessian_structure().size());
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index, Number* x_lower, Number* x_upper, Index, Number* g_lower, Number* g_upper) override {
    std::copy(problem_.variable_lower().begin(), problem_.variable_lower().end(), x_lower);
    std::copy(problem_.variable_upper().begin(), problem_.variable_upper().end(), x_upper);
    std::copy(problem_.row_lower().begin(), problem_.row_lower().end(), g_lower);
    std::copy(problem_.row_upper().begin(), problem_.row_upper().end(), g_upper);
    return true;
  }

  bool get_starting_point(Index n, bool init_x, Number* x, bool init_z, Number*, Number*, Index, bool init_lambda,
                          Number*) override {
    if (init_x) std::copy(x0_.data(), x0_.data() + n, x);
    return !init_z && !init_lambda;
  }

  bool eval_f(Index n, const Number* x, bool new_x, Number& cost) override {
    evaluate(n, x, new_x, &cost, 1, [&](const ConstVector& at, Vector out) { out[0] = problem_.cost(at); });
    cost_ = cost;
    cost_known_ = true;
    consider(n, x);
    return true;
  }

  bool eval_grad_f(Index n, const Number* x, bool new_x, Number* gradient) override {
    return evaluate(n, x, new_x, gradient, n, [&](const ConstVector& at, Vector out) { problem_.gradient(at, out); });
  }

  bool eval_g(Index n, const Number* x, bool new_x, Index m, Number* g) override {
    evaluate(n, x, new_x, g, m, [&](const ConstVector& at, Vector out) { problem_.rows(at, out); });
    row_violation_ = largest_violation(g, problem_.row_lower(), problem_.row_upper());
    rows_known_ = true;
    consider(n, x);
    return true;
  }

  bool eval_jac_g(Index n, const Number* x, bool new_x, Index, Index entries, Index* rows, Index* columns,
                  Number* values) override {
    if (!values) return structure(problem_.jacobian_structure(), rows, columns);
    return evaluate(n, x, new_x, values, entries,
                    [&](const ConstVector& at, Vector out) { problem_.jacobian(at, out); });
  }

  bool eval_h(Index n, const Number* x, bool new_x, Number cost_factor, Index m, const Number* multipliers, bool,
              Index entries, Index* rows, Index* columns, Number* values) override {
    if (!values) return structure(problem_.hessian_structure(), rows, columns);
    const Eigen::Map<const VectorXd> weights(multipliers, m);
    return evaluate(n, x, new_x, values, entries,
                    [&](const ConstVector& at, Vector out) { problem_.hessian(at, cost_factor, weights, out); });
  }

  bool intermediate_callback(Ipopt::AlgorithmMode mode, Index iteration, Number cost, Number violation,
                             Number dual_violation, Number barrier, Number step, Number regularization, Number alpha_du,
                             Number alpha_pr, Index trials, const Ipopt::IpoptData* data,
                             Ipopt::IpoptCalculatedQuantities*) override {
    const bool restoration = mode == Ipopt::RestorationPhaseMode;
    iterations_ = iteration;
    clock_linear_solver(data, restoration);
    try {
      reserve();
      if (options_.logger) {
        char line[160];
        if (!header_written_)
          options_.logger(LogLevel::info,
                          "iter      cost      inf_pr   inf_du lg(mu)  ||d||  lg(rg) alpha_du alpha_pr  ls");
        header_written_ = true;
        char lg_regularization[8] = "    -";
        if (regularization > 0.0)
          std::snprintf(lg_regularization, sizeof lg_regularization, "%5.1f", std::log10(regularization));
        std::snprintf(line, sizeof line, "%4d%c %12.6e %8.2e %8.2e %5.1f %8.2e %s %8.2e %8.2e %3d", iteration,
                      restoration ? 'r' : ' ', cost, violation, dual_violation, std::log10(barrier), step,
                      lg_regularization, alpha_du, alpha_pr, trials);
        options_.logger(LogLevel::info, line);
      }
      if (options_.stop && options_.stop()) reason_ = Reason::stop;
    } catch (...) {
      halt_with_exception();
    }
    if (reason_ == Reason::none && out_of_time()) reason_ = Reason::time;
    return reason_ == Reason::none;
  }

  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*, const Number*, Index m,
                         const Number*, const Number* multipliers, Number, const Ipopt::IpoptData* data,
                         Ipopt::IpoptCalculatedQuantities*) override {
    last_x_ = Eigen::Map<const VectorXd>(x, n);
    if (m > 0) multipliers_ = Eigen::Map<const VectorXd>(multipliers, m);
    if (data) clock_linear_solver(data, false);
  }

  Reason reason() const { return reason_; }
  const Best& best() const { return best_; }
  const VectorXd& last_x() const { return last_x_; }
  const VectorXd& multipliers() const { return multipliers_; }
  const std::string& not_finite() const { return not_finite_; }
  int iterations() const { return iterations_; }
  double evaluation_s() const { return evaluation_s_; }
  double start_s() const { return start_s_; }
  double linear_solver_s() const { return regular_s_ + restorations_s_ + restoration_s_; }
  bool feasible() const { return best_.violation <= options_.constraint_tolerance; }

  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  static bool structure(const std::vector<Entry>& entries, Index* rows, Index* columns) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      rows[i] = entries[i].row;
      columns[i] = entries[i].column;
    }
    return true;
  }

  /// One evaluation of the problem: clock, deadline, exceptions and numbers that are not finite.
  template <class Function>
  bool evaluate(Index n, const Number* x, bool new_x, Number* out, Index size, const Function& function) {
    if (new_x) cost_known_ = rows_known_ = false;
    if (deadline_.limited() && deadline_.remaining_s() <= reserved_s_) halt(Reason::time);
    const double start_s = deadline_.now_s();
    const Eigen::Map<const VectorXd> at(x, n);
    Eigen::Map<VectorXd> values(out, size);
    try {
      function(at, values);
      if (!values.allFinite()) {
        not_finite_ = problem_.first_not_finite(at);
        if (not_finite_.empty()) not_finite_ = "a sum of pieces";
        reason_ = Reason::not_finite;
      }
    } catch (...) {
      halt_with_exception();
    }
    evaluation_s_ += deadline_.now_s() - start_s;
    if (reason_ != Reason::none) throw Halt();
    return true;
  }

  /// Whether the limit has passed or would pass within the next iteration, taken to last as long as the longer of the
  /// last two: a factorisation cannot be interrupted. What comes before the first iteration counts as one, since it
  /// has a factorisation of the same size.
  bool out_of_time() {
    if (!deadline_.limited()) return false;
    const double left_s = deadline_.remaining_s(), took_s = left_s_ - left_s;
    const double expected_s = std::max(took_s, before_s_);
    if (start_s_ == 0.0) start_s_ = took_s;
    before_s_ = took_s;
    left_s_ = left_s;
    return left_s <= reserved_s_ + expected_s;
  }

  /// What the caller needs afterwards, but no more than half of the limit.
  void reserve() {
    if (deadline_.limited() && options_.finishing_s)
      reserved_s_ = std::min(options_.finishing_s(best_.x), 0.5 * options_.time_limit_s);
  }

  [[noreturn]] void halt(Reason reason) {
    reason_ = reason;
    throw Halt();
  }

  [[noreturn]] void halt_with_exception() {
    thrown_ = std::current_exception();
    halt(Reason::exception);
  }

  /// Keep the point of the last evaluations if it is the best. Ipopt asks for cost and rows in either order, and in a
  /// restoration phase perhaps for the rows alone.
  void consider(Index n, const Number* x) {
    if (!rows_known_ && problem_.row_count() > 0) return;
    const double violation = std::max(rows_known_ ? row_violation_ : 0.0,
                                      largest_violation(x, problem_.variable_lower(), problem_.variable_upper()));
    const double enough = options_.constraint_tolerance;
    const bool better = violation <= enough ? cost_known_ && (best_.violation > enough || cost_ < best_.cost)
                                            : violation < best_.violation;
    if (!better) return;
    best_.x = Eigen::Map<const VectorXd>(x, n);
    best_.violation = violation;
    best_.cost = cost_;
  }

  /// A restoration phase has clocks of its own, which start from zero each time.
  void clock_linear_solver(const Ipopt::IpoptData* data, bool restoration) {
    // Ipopt 3.11 has no reading access.
    Ipopt::TimingStatistics& timing = const_cast<Ipopt::IpoptData*>(data)->TimingStats();
    // Around all that MUMPS does: with it the clocks of the single parts leave the factorisation out.
    const double total = timing.StdAugSystemSolverMultiSolve().TotalWallclockTime();
    if (!restoration) {
      regular_s_ = total;
      return;
    }
    if (total < restoration_s_) restorations_s_ += restoration_s_;
    restoration_s_ = total;
  }

  const Problem& problem_;
  const SolverOptions& options_;
  const Deadline& deadline_;
  double left_s_ = 0.0, before_s_ = 0.0;  ///< left when the last iteration ended, and how long it took
  double reserved_s_ = 0.0, start_s_ = 0.0;
  const VectorXd x0_;

  bool cost_known_ = false, rows_known_ = false;  ///< at Ipopt's current x
  double cost_ = 0.0, row_violation_ = 0.0;
  Best best_;
  VectorXd last_x_, multipliers_;

  Reason reason_ = Reason::none;
  std::exception_ptr thrown_;
  std::string not_finite_;
  bool header_written_ = false;
  int iterations_ = 0;
  double evaluation_s_ = 0.0;
  double regular_s_ = 0.0, restorations_s_ = 0.0, restoration_s_ = 0.0;
};

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

VectorXd projected(const Problem& problem, VectorXd x) {
  for (int i = 0; i < problem.variable_count(); ++i)
    x[i] = std::max(problem.variable_lower()[i], std::min(problem.variable_upper()[i], x[i]));
  return x;
}

void require_start(const Problem& problem, const VectorXd& x0) {
  const int n = problem.variable_count();
  if (x0.size() != n) throw InvalidInput("x0", "must have " + text(n) + " values", text(static_cast<int>(x0.size())));
  for (int i = 0; i < n; ++i)
    if (!std::isfinite(x0[i])) throw InvalidInput("x0, " + problem.variable_name(i), "must be finite", text(x0[i]));
}

/// Name of a variable or row whose lower bound lies above its upper bound, or "".
std::string crossed(const Problem& problem) {
  for (int i = 0; i < problem.variable_count(); ++i)
    if (problem.variable_lower()[i] > problem.variable_upper()[i]) return problem.variable_name(i);
  for (int i = 0; i < problem.row_count(); ++i)
    if (problem.row_lower()[i] > problem.row_upper()[i]) return problem.row_name(i);
  return "";
}

/// Without a free variable there is nothing to optimise, and Ipopt's versions disagree on how to say so.
Ending judge_fixed(const Problem& problem, const VectorXd& x, double constraint_tolerance) {
  if (problem.worst_violation(x).value <= constraint_tolerance)
    return {Outcome::converged, "every variable is fixed, and the constraints hold", true};
  return {Outcome::infeasible, "every variable is fixed, and a constraint does not hold", true};
}

Ending run(const Problem& problem, const VectorXd& x0, Adapter& adapter, const SolverOptions& options,
           const Deadline& deadline) {
  const std::string impossible = crossed(problem);
  if (!impossible.empty())
    return {Outcome::infeasible, "the lower bound of " + impossible + " lies above its upper bound", false};
  if (problem.variable_lower() == problem.variable_upper())
    return judge_fixed(problem, x0, options.constraint_tolerance);
  const Turn turn(deadline);
  if (!turn.mine()) return {Outcome::time_limit, "reached time_limit_s while another solve was running", false};
  adapter.begin();
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  set_options(*application->Options(), options);
  Ipopt::ApplicationReturnStatus code = application->Initialize("");  // no name: no ipopt.opt is read
  if (code == Ipopt::Solve_Succeeded) code = application->OptimizeTNLP(&adapter);
  adapter.rethrow();
  if (adapter.reason() == Adapter::Reason::time) return {Outcome::time_limit, "reached time_limit_s", false};
  if (adapter.reason() == Adapter::Reason::not_finite)
    return {Outcome::numerical_failure, "not finite: " + adapter.not_finite(), false};
  return ending_of(code, adapter.feasible());
}

}  // namespace

Solution solve(const Problem& problem, const VectorXd& x0, const SolverOptions& options) {
  const Deadline deadline(options.time_limit_s, options.clock);
  options.validate();
  require_start(problem, x0);
  const VectorXd x = projected(problem, x0);
  Ipopt::SmartPtr<Adapter> adapter = new Adapter(problem, x, options, deadline);
  const Ending ending = run(problem, x, *adapter, options, deadline);

  Solution out;
  out.outcome = ending.outcome;
  out.message = ending.message;
  // Ipopt moves a bound by some 1e-12 where it would divide by the distance to it.
  out.x = projected(problem, ending.keep_last ? adapter->last_x() : adapter->best().x);
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

std::string ipopt_version() { return IPOPT_VERSION; }

}  // namespace mcplan::nlp
