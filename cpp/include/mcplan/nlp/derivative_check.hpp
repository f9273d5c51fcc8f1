#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mcplan/nlp/problem.hpp"

namespace mcplan::nlp {

/// A derivative that disagrees with central differences.
struct WrongDerivative {
  std::string piece;          ///< e.g. "momentum_rate"
  std::string kind;           ///< "jacobian", "hessian" or "structure" (an entry that finish() took for zero)
  int row = 0;                ///< of the piece, -1 for a Hessian (summed over rows with random weights)
  std::string first, second;  ///< variables: d/d first (d/d second), second empty for a Jacobian
  double given = 0.0, difference = 0.0;

  /// "momentum_rate: jacobian, row 1, d/d com[2] at stage 3: 0.5, central difference 0.7"
  std::string to_string() const;
};

/// Compare every Jacobian and Hessian entry of one piece with central differences of its values and Jacobian at x (the
/// piece's own variables); relative error above `tolerance` of max(1, |entry|) is reported.
std::vector<WrongDerivative> check_derivatives(const Piece& piece, const Eigen::VectorXd& x, double tolerance = 1e-5);

/// The same for every piece of a problem at x, and that the sparse structure leaves nothing out; worst first.
std::vector<WrongDerivative> check_derivatives(const Problem& problem, const Eigen::VectorXd& x,
                                               double tolerance = 1e-5);

}  // namespace mcplan::nlp
