#pragma once

#include <Eigen/Core>
#include <string>

#include "mcplan/nlp/problem.hpp"

namespace mcplan::nlp {

/// x within the problem's bounds.
Eigen::VectorXd projected(const Problem& problem, Eigen::VectorXd x);

/// x0, projected. Throws InvalidInput where it does not have one finite value for each variable.
Eigen::VectorXd start_of(const Problem& problem, const Eigen::VectorXd& x0);

/// "the lower bound of com[2] at stage 3 lies above its upper bound", of a variable or a row; or "".
std::string contradiction(const Problem& problem);

}  // namespace mcplan::nlp
