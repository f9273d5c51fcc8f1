#pragma once

#include <Eigen/Core>
#include <string>

#include "mcplan/nlp/problem.hpp"
#include "mcplan/nlp/solver.hpp"

namespace mcplan::nlp {

/// x within the problem's bounds.
Eigen::VectorXd projected(const Problem& problem, Eigen::VectorXd x);

/// x0, projected. Throws InvalidInput where it does not have one finite value for each variable, and where a limit of a
/// variable or a row is no number, or one that nothing finite keeps.
Eigen::VectorXd start_of(const Problem& problem, const Eigen::VectorXd& x0);

/// "the lower bound of com[2] at stage 3 lies above its upper bound", of a variable or a row; or "".
std::string contradiction(const Problem& problem);

/// How a solve ends, and why.
struct Verdict {
  Outcome outcome = Outcome::numerical_failure;
  std::string message;
};

/// Of a problem whose variables are all fixed, at x.
Verdict judge_fixed(const Problem& problem, const Eigen::VectorXd& x, double constraint_tolerance);

}  // namespace mcplan::nlp
