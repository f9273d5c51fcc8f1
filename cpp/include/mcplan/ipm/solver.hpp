#pragma once

#include "mcplan/nlp/solver.hpp"

namespace mcplan::ipm {

/// Solve with the interior-point kernel from x0 (projected into the bounds): docs/theory/ipm.md.
///
/// Takes the same problems and options as nlp::solve and gives the same kind of solution; `ordering`, `hessian` and
/// `gradient_scaling` are not looked at. Any number of solves may run at once, each with a Problem of its own, and a
/// piece may call a solve. Throws InvalidInput or InvalidOptions before it begins; rethrows what a piece, the logger or
/// the stop request throws. A number that is not finite ends with numerical_failure and a message that names the piece.
nlp::Solution solve(const nlp::Problem& problem, const Eigen::VectorXd& x0, const nlp::SolverOptions& options = {});

/// Solve with the solver that is asked for. `automatic` is the kernel, and where it ends nearly converged, by a
/// numerical failure or at the limit of iterations, Ipopt from x0 with the iterations and the time that are left.
/// Iterations and times of both are added; the outcome is Ipopt's, and of two that did not converge the point that
/// violates less is kept.
nlp::Solution solve(nlp::Solver solver, const nlp::Problem& problem, const Eigen::VectorXd& x0,
                    const nlp::SolverOptions& options = {});

}  // namespace mcplan::ipm
