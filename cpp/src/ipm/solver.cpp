#include "mcplan/ipm/solver.hpp"

#include <algorithm>
#include <cmath>

#include "ipm/barrier.hpp"
#include "ipm/functions.hpp"
#include "ipm/kkt.hpp"
#include "ipm/phase_one.hpp"
#include "ipm/unknowns.hpp"
#include "nlp/has_ipopt.hpp"
#include "nlp/start.hpp"

namespace mcplan::ipm {
namespace {

using Eigen::VectorXd;
using nlp::Outcome;

Point point_at(const Unknowns& unknowns, const VectorXd& x) {
  Point out;
  out.x = x;
  out.x_count = unknowns.free_count();
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
  return true;
}

/// Where the barrier method fails from a start, it begins again from the same start after a phase one: what a failed
/// attempt leaves behind is no better a place to go on from.
constexpr PhaseOne kAttempts[] = {{10.0, 0}, {10.0, 8}, {1.0, 50}};
constexpr PhaseOne kAttemptsFromAfar[] = {
    {10.0, 50, 2.0, 0.05, false}, {100.0, 50, 2.0, 0.05, false}, {1.0, 50, 2.0, 0.05, false}};
constexpr int kMaxProof = 300;  // steps towards a point of least violation, where all attempts have failed
constexpr int kPatience = 30;   // of them, from afar: near such a point they are many and short where rows are curved

void run(const nlp::Problem& problem, const VectorXd& x, const nlp::SolverOptions& options, const Deadline& deadline,
         nlp::Solution& out) {
  const Unknowns unknowns(problem, options.kernel.distant_start);
  Functions functions(problem, unknowns, options, deadline);
  Kkt kkt(problem, unknowns);
  Barrier barrier(unknowns, options, functions, kkt);
  Point point;
  out.start_s = deadline.elapsed_s();
  try {
    for (const PhaseOne& phase_one : options.kernel.distant_start ? kAttemptsFromAfar : kAttempts) {
      point = point_at(unknowns, x);
      phase_one.run(unknowns, functions, kkt, point);
      const Barrier::Ending ending = barrier.run(point, options.max_iterations);
      out.outcome = ending.outcome;
      out.message = ending.message;
      if (ending.outcome != Outcome::numerical_failure) break;
    }
    if (out.outcome == Outcome::numerical_failure) {
      point = point_at(unknowns, x);
      const int steps = std::min(kMaxProof, options.max_iterations - functions.iterations());
      const int patience = options.kernel.distant_start ? kPatience : 0;
      const bool within = !options.kernel.distant_start;
      const PhaseOne proof{1.0, steps, 10.0 * options.constraint_tolerance, 0.0, within, patience};
      if (proof.run(unknowns, functions, kkt, point)) {
        out.outcome = Outcome::infeasible;
        out.message = patience > 0
                          ? "found no point within all constraints: least squares of the violations hardly fall"
                          : "converged to a point at which the violation is locally least";
      }
    }
  } catch (const Halt& halt) {
    out.outcome = halt.outcome;
    out.message = halt.message;
  }
  out.x = out.outcome == Outcome::converged ? point.x : functions.best_x();
  if (out.x.size() == 0) out.x = x;
  out.multipliers = multipliers_of(problem, unknowns, barrier);
  out.iterations = functions.iterations();
  out.evaluation_s = functions.evaluation_s();
  out.linear_solver_s = barrier.linear_solver_s();
}

}  // namespace

nlp::Solution solve(const nlp::Problem& problem, const VectorXd& x0, const nlp::SolverOptions& options) {
  const Deadline deadline(options.time_limit_s, options.clock);
  options.validate();
  const VectorXd x = nlp::start_of(problem, x0);
  nlp::Solution out;
  out.solver = nlp::Solver::ipm;
  if (!decided(problem, x, options.constraint_tolerance, out)) run(problem, x, options, deadline, out);
  out.cost = problem.cost(out.x);
  out.worst = problem.worst_violation(out.x);
  out.time_s = deadline.elapsed_s();
  return out;
}

nlp::Solution solve(nlp::Solver solver, const nlp::Problem& problem, const VectorXd& x0,
                    const nlp::SolverOptions& options) {
  if (solver == nlp::Solver::ipopt) return nlp::solve(problem, x0, options);
  nlp::Solution first = ipm::solve(problem, x0, options);
  const double left_s = options.time_limit_s - first.time_s;
  const int iterations = options.max_iterations - first.iterations;
  const bool ended = first.outcome != Outcome::numerical_failure && first.outcome != Outcome::nearly_converged &&
                     first.outcome != Outcome::iteration_limit;
  if (solver == nlp::Solver::ipm || !nlp::has_ipopt() || ended || !(left_s > 0.0) || iterations <= 0) return first;
  nlp::SolverOptions rest = options;
  rest.time_limit_s = left_s;
  rest.max_iterations = iterations;
  nlp::Solution second = nlp::solve(problem, x0, rest);
  const bool better = second.outcome == Outcome::converged || second.outcome == Outcome::nearly_converged ||
                      second.worst.value <= first.worst.value;
  nlp::Solution& kept = better ? second : first;
  nlp::Solution& other = better ? first : second;
  kept.outcome = second.outcome;  // the reference has the last word
  kept.message = second.message;
  kept.iterations += other.iterations;
  kept.time_s += other.time_s;
  kept.evaluation_s += other.evaluation_s;
  kept.linear_solver_s += other.linear_solver_s;
  return kept;
}

}  // namespace mcplan::ipm
