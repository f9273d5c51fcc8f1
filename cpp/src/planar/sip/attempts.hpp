#pragma once

#include <algorithm>
#include <vector>

#include "mcplan/planar/sip/options.hpp"

namespace mcplan::sip {

/// One way of solving a program.
struct Attempt {
  HessianChoice hessian;
  bool adaptive_barrier;
  double initial_barrier;
  int max_iterations;
  nlp::SolverOptions::Kernel kernel{};
};

/// All ways to try, in turn. Without a cost second derivatives say little: L-BFGS, the weak pull's own Hessian, and the
/// exact one each solve what the others do not. With one the exact Hessian converges in some tens of iterations where
/// Gauss-Newton, which leaves out the constraints' curvature, needs hundreds (docs/theory/sip.md).
inline std::vector<Attempt> attempts_for(const Options& options, bool cost) {
  const int max = options.max_iterations, some = std::min(max, 200);
  if (options.solver == nlp::Solver::ipm) {
    if (!cost) return {{HessianChoice::gauss_newton, true, 0.1, max, {true, true, false}}};
    return {{HessianChoice::exact, false, 1e-3, max, {false, false, true}}};
  }
  if (options.hessian != HessianChoice::automatic) return {{options.hessian, !cost, cost ? 0.01 : 0.1, max}};
  if (cost)
    return {{HessianChoice::exact, false, 0.01, std::min(max, 400)},
            {HessianChoice::exact, true, 0.1, std::min(max, 400)},
            {HessianChoice::gauss_newton, true, 0.1, max}};
  return {{HessianChoice::limited_memory, true, 0.1, some},
          {HessianChoice::gauss_newton, true, 0.1, some},
          {HessianChoice::exact, true, 0.1, max}};
}

}  // namespace mcplan::sip
