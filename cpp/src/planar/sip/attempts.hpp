#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "mcplan/nlp/solver.hpp"
#include "mcplan/planar/sip/options.hpp"
#include "nlp/has_ipopt.hpp"

namespace mcplan::sip {

/// One way of solving a program.
struct Attempt {
  HessianChoice hessian;
  bool adaptive_barrier;
  double initial_barrier;
  int max_iterations;
  nlp::Solver solver = nlp::Solver::ipopt;
  nlp::SolverOptions::Kernel kernel{};
};

/// The kernel's ways. For a point within the constraints second derivatives say nothing. Where it is all that is asked
/// for, the barrier begins small: a large one draws durations to the middle of their range, where phases are long and
/// polynomials coarse. With a cost, the exact Hessian is blended with that of Gauss and Newton (docs/theory/ipm.md).
inline std::vector<Attempt> kernel_attempts_for(const Options& options, bool cost) {
  const int max = options.max_iterations;
  const double barrier = options.has_cost() ? 0.1 : 0.01;
  if (!cost) return {{HessianChoice::gauss_newton, true, barrier, max, nlp::Solver::ipm, {true, true, false}}};
  const bool blend = options.hessian == HessianChoice::automatic;
  const HessianChoice hessian = blend ? HessianChoice::exact : options.hessian;
  return {{hessian, false, 2e-3, max, nlp::Solver::ipm, {false, false, blend}}};
}

/// Ipopt's, in turn. Without a cost second derivatives say little: L-BFGS, the weak pull's own Hessian, and the exact
/// one each solve what the others do not. With one the exact Hessian converges in some tens of iterations where
/// Gauss-Newton, which leaves out the constraints' curvature, needs hundreds (docs/theory/sip.md).
inline std::vector<Attempt> ipopt_attempts_for(const Options& options, bool cost) {
  const int max = options.max_iterations, some = std::min(max, 200);
  if (options.hessian != HessianChoice::automatic) return {{options.hessian, !cost, cost ? 0.01 : 0.1, max}};
  if (cost)
    return {{HessianChoice::exact, false, 0.01, std::min(max, 400)},
            {HessianChoice::exact, true, 0.1, std::min(max, 400)},
            {HessianChoice::gauss_newton, true, 0.1, max}};
  return {{HessianChoice::limited_memory, true, 0.1, some},
          {HessianChoice::gauss_newton, true, 0.1, some},
          {HessianChoice::exact, true, 0.1, max}};
}

/// All ways to try, in turn. With a cost, who asks for a history instead of second derivatives asks for Ipopt: the
/// kernel has none, and with the Hessian of Gauss and Newton, which is what would be left to it, it takes minutes.
inline std::vector<Attempt> attempts_for(const Options& options, bool cost) {
  const bool history = cost && options.hessian == HessianChoice::limited_memory;
  if (options.solver == nlp::Solver::ipopt || history) return ipopt_attempts_for(options, cost);
  std::vector<Attempt> out = kernel_attempts_for(options, cost);
  if (options.solver == nlp::Solver::ipm || !nlp::has_ipopt()) return out;
  const std::vector<Attempt> more = ipopt_attempts_for(options, cost);
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

/// What the kernel may take of iterations for a point within all constraints while there are other ways to one. The
/// motions of the tasks that are built in take at most 110, or it fails.
constexpr int kTrialIterations = 150;

/// Options of such a try: by the kernel alone.
inline Options trial_of(Options options) {
  options.solver = nlp::Solver::ipm;
  options.max_iterations = std::min(options.max_iterations, kTrialIterations);
  return options;
}

/// The forces with one more weight for each contact, or for each point: they have all motions of the ones given.
inline std::optional<Forces> freer(Forces forces) {
  if (forces == Forces::uniform) return Forces::per_body;
  if (forces == Forces::per_body) return Forces::per_point;
  return std::nullopt;
}

/// Whether no further attempt is wanted.
inline bool ends_all(nlp::Outcome outcome) {
  return outcome == nlp::Outcome::converged || outcome == nlp::Outcome::time_limit ||
         outcome == nlp::Outcome::interrupted;
}

/// The one of two solutions of a program without a cost that is worth keeping, with the later one's outcome.
inline nlp::Solution better_of(nlp::Solution first, nlp::Solution second) {
  if (first.worst.value >= second.worst.value || second.outcome == nlp::Outcome::converged) return second;
  first.outcome = second.outcome;
  first.message = second.message;
  return first;
}

}  // namespace mcplan::sip
