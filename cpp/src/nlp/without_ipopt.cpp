// What stands for Ipopt where mcplan is built without it (MCPLAN_IPOPT=OFF): who asks for it is told.

#include "mcplan/base/error.hpp"
#include "mcplan/nlp/solver.hpp"
#include "nlp/has_ipopt.hpp"

namespace mcplan::nlp {

Solution solve(const Problem&, const Eigen::VectorXd&, const SolverOptions&) {
  throw InvalidOptions("solver", "must be ipm or auto, since this mcplan was built without Ipopt", "ipopt");
}

bool has_ipopt() { return false; }

std::string ipopt_version() { return "none"; }

}  // namespace mcplan::nlp
