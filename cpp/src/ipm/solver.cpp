#include "mcplan/ipm/solver.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "ipm/barrier.hpp"
#include "ipm/functions.hpp"
#include "ipm/kkt.hpp"
#include "ipm/phase_one.hpp"
#include "ipm/unknowns.hpp"
#include "mcplan/base/error.hpp"
#include "nlp/has_ipopt.hpp"
#include "nlp/start.hpp"

namespace mcplan::ipm {
namespace {

using Eigen::VectorXd;
using nlp::Outcome;

Point point_at(const Unknowns& unknowns, const VectorXd& x) {
  Point out;
  out.x = x;
  out.t = VectorXd::Zero(unknowns.lower.size());
  for (int i = 0; i < unknowns.free_count(); ++i) out.t[i] = x[unknowns.free[i]];
  out.equalities = VectorXd::Zero(unknowns.equality_count());
  out.inequalities = VectorXd::Zero(unknowns.slack_count());
  return out;
}

/// Of the problem's rows.
VectorXd multipliers_of(const nlp::Problem& problem, const Unknowns& unknowns, Barrier& barrier) {
  VectorXd out = VectorXd::Zero(problem.row_count());
  const VectorXd slacks = barrier.inequality_multipliers();
  for (int i = 0; i < unknowns.equality_count(); ++i) out[unknowns.equalities[i]] = barrier.equality_multipliers()[i];
  for (int i = 0; i < unknowns.slack_count(); ++i) out[unknowns.inequalities[i]] = unknowns.scale[i] * slacks[i];
  return out;
}

VectorXd bound_multipliers_of(const nlp::Problem& problem, const Unknowns& unknowns, const Barrier& barrier) {
  VectorXd out = VectorXd::Zero(problem.variable_count());
  out(unknowns.free) = barrier.bound_multipliers();
  return out;
}

/// Multipliers with which the options ask to begin, if they do.
std::optional<Barrier::Duals> duals_of(const Unknowns& unknowns, const nlp::SolverOptions& options) {
  const VectorXd &rows = options.start.multipliers, &bounds = options.start.bound_multipliers;
  if (rows.size() == 0 && bounds.size() == 0) return std::nullopt;
  Barrier::Duals out;
  out.equalities = VectorXd::Zero(unknowns.equality_count());
  VectorXd net = VectorXd::Zero(unknowns.lower.size());
  const int n = unknowns.free_count();
  if (bounds.size() > 0) net.head(n) = bounds(unknowns.free);
  if (rows.size() > 0) {
    out.equalities = rows(unknowns.equalities);
    net.tail(unknowns.slack_count()) = rows(unknowns.inequalities).cwiseQuotient(unknowns.scale);
  }
  out.lower = (-net).cwiseMax(0.0);
  out.upper = net.cwiseMax(0.0);
  for (int i = 0; i < net.size(); ++i) {
    if (unknowns.lower[i] == -nlp::kInfinity) out.lower[i] = 0.0;
    if (unknowns.upper[i] == nlp::kInfinity) out.upper[i] = 0.0;
  }
  return out;
}

void require_size(const char* field, const VectorXd& given, int size) {
  if (given.size() > 0 && given.size() != size)
    throw InvalidOptions(field, "must be empty or have " + text(size) + " entries",
                         text(static_cast<int>(given.size())));
  if (!given.allFinite()) throw InvalidOptions(field, "must be finite numbers", "nan or inf");
}

/// A problem that leaves nothing to solve for: bounds that contradict each other, or every variable fixed.
bool decided(const nlp::Problem& problem, const VectorXd& x, double constraint_tolerance, nlp::Solution& out) {
  const std::string impossible = nlp::contradiction(problem);
  const bool fixed = Unknowns(problem, false).free_count() == 0;
  if (impossible.empty() && !fixed) return false;
  const nlp::Verdict verdict = impossible.empty() ? nlp::judge_fixed(problem, x, constraint_tolerance)
                                                  : nlp::Verdict{Outcome::infeasible, impossible};
  out.outcome = verdict.outcome;
  out.message = verdict.message;
  out.x = x;
  out.multipliers = VectorXd::Zero(problem.row_count());
  out.bound_multipliers = VectorXd::Zero(problem.variable_count());
  return true;
}

/// Where the barrier method fails from a start, it begins again from the same start after a phase one: what a failed
/// attempt leaves behind is no better a place to go on from.
constexpr PhaseOne kAttempts[] = {{10.0, 0}, {10.0, 8}, {1.0, 50}};
constexpr PhaseOne kAttemptsFromAfar[] = {
    {10.0, 50, 2.0, 0.05, false}, {100.0, 50, 2.0, 0.05, false}, {1.0, 50, 2.0, 0.05, false}};
constexpr int kMaxProof = 300;  // steps towards a point of least violation, where all attempts have failed
constexpr int kPatience = 30;   // of them, from afar: near such a point they are many and short where rows are curved
// Otherwise: towards a point without violations so many steps do far more than lessen the sum of squares by a quarter.
constexpr int kLongPatience = 100;
constexpr double kFarLess = 0.25;

/// What the kernel found. gave_up: it is infeasible since violations hardly fall any more, which is no proof.
struct ByKernel {
  nlp::Solution solution;
  bool gave_up = false;
};

void run(const nlp::Problem& problem, const VectorXd& x, const nlp::SolverOptions& options, const Deadline& deadline,
         ByKernel& found) {
  nlp::Solution& out = found.solution;
  const Unknowns unknowns(problem, options.kernel.distant_start);
  Functions functions(problem, unknowns, options, deadline);
  Kkt kkt(problem, unknowns);
  Barrier barrier(unknowns, options, functions, kkt);
  const std::optional<Barrier::Duals> duals = duals_of(unknowns, options);
  Point point;
  out.start_s = deadline.elapsed_s();
  try {
    for (const PhaseOne& phase_one : options.kernel.distant_start ? kAttemptsFromAfar : kAttempts) {
      point = point_at(unknowns, x);
      phase_one.run(unknowns, functions, kkt, point);
      // A start that a phase one has moved is no neighbour of where the multipliers are from.
      const bool given = duals && phase_one.max_iterations == 0;
      const Barrier::Ending ending = barrier.run(point, options.max_iterations, given ? &*duals : nullptr);
      out.outcome = ending.outcome;
      out.message = ending.message;
      if (ending.outcome != Outcome::numerical_failure) break;
    }
    if (out.outcome == Outcome::numerical_failure) {
      point = point_at(unknowns, x);
      const int steps = std::min(kMaxProof, options.max_iterations - functions.iterations());
      const bool from_afar = options.kernel.distant_start;
      PhaseOne proof{1.0, steps, 10.0 * options.constraint_tolerance, 0.0, !from_afar};
      if (from_afar) {
        proof.patience = kPatience;
      } else {
        proof.patience = kLongPatience;
        proof.hardly = kFarLess;
      }
      if (proof.run(unknowns, functions, kkt, point)) {
        out.outcome = Outcome::infeasible;
        found.gave_up = proof.patience > 0 && !from_afar;
        out.message = proof.patience > 0
                          ? "found no point within all constraints: least squares of the violations hardly fall"
                          : "converged to a point at which the violation is locally least";
      } else if (!from_afar && functions.iterations() >= options.max_iterations) {
        out.outcome = Outcome::iteration_limit;
        out.message = "reached max_iterations before it was known whether there is a point within all constraints";
      }
    }
  } catch (const Halt& halt) {
    out.outcome = halt.outcome;
    out.message = halt.message;
  }
  out.x = out.outcome == Outcome::converged ? point.x : functions.best_x();
  if (out.x.size() == 0) out.x = x;
  out.multipliers = multipliers_of(problem, unknowns, barrier);
  out.bound_multipliers = bound_multipliers_of(problem, unknowns, barrier);
  out.barrier = barrier.parameter();
  out.iterations = functions.iterations();
  out.evaluation_s = functions.evaluation_s();
  out.linear_solver_s = barrier.linear_solver_s();
}

ByKernel solve_by_kernel(const nlp::Problem& problem, const VectorXd& x0, const nlp::SolverOptions& options) {
  const Deadline deadline(options.time_limit_s, options.clock);
  options.validate();
  require_size("start.multipliers", options.start.multipliers, problem.row_count());
  require_size("start.bound_multipliers", options.start.bound_multipliers, problem.variable_count());
  const VectorXd x = nlp::start_of(problem, x0);
  ByKernel found;
  nlp::Solution& out = found.solution;
  out.solver = nlp::Solver::ipm;
  if (!decided(problem, x, options.constraint_tolerance, out)) run(problem, x, options, deadline, found);
  out.cost = problem.cost(out.x);
  out.worst = problem.worst_violation(out.x);
  out.time_s = deadline.elapsed_s();
  return found;
}

}  // namespace

nlp::Solution solve(const nlp::Problem& problem, const VectorXd& x0, const nlp::SolverOptions& options) {
  return solve_by_kernel(problem, x0, options).solution;
}

nlp::Solution solve(nlp::Solver solver, const nlp::Problem& problem, const VectorXd& x0,
                    const nlp::SolverOptions& options) {
  if (solver == nlp::Solver::ipopt) return nlp::solve(problem, x0, options);
  ByKernel by_kernel = solve_by_kernel(problem, x0, options);
  nlp::Solution& first = by_kernel.solution;
  const double left_s = options.time_limit_s - first.time_s;
  const int iterations = options.max_iterations - first.iterations;
  const bool ended = !by_kernel.gave_up && first.outcome != Outcome::numerical_failure &&
                     first.outcome != Outcome::nearly_converged && first.outcome != Outcome::iteration_limit;
  if (solver == nlp::Solver::ipm || !nlp::has_ipopt() || ended || !(left_s > 0.0) || iterations <= 0) return first;
  nlp::SolverOptions rest = options;
  rest.time_limit_s = left_s;
  rest.max_iterations = iterations;
  nlp::Solution second = nlp::solve(problem, x0, rest);
  const bool solved = second.outcome == Outcome::converged || second.outcome == Outcome::nearly_converged;
  const bool better = solved || second.worst.value <= first.worst.value;
  nlp::Solution& kept = better ? second : first;
  nlp::Solution& other = better ? first : second;
  // The reference has the last word, but where it cannot tell either.
  const bool told = solved || !by_kernel.gave_up || second.outcome == Outcome::interrupted;
  const nlp::Solution& last = told ? second : first;
  kept.outcome = last.outcome;
  kept.message = last.message;
  kept.iterations += other.iterations;
  kept.time_s += other.time_s;
  kept.evaluation_s += other.evaluation_s;
  kept.linear_solver_s += other.linear_solver_s;
  return kept;
}

}  // namespace mcplan::ipm
