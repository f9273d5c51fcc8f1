#pragma once

#include <string>

#include "mcplan/nlp/piece.hpp"

namespace mcplan::rhp {

/// y1 - y0 - h r = 0 with h = T / intervals: forward Euler for a state y of three components and its rate r
/// (Wang et al., eqs. 2a-2c). Bilinear in T and r.
class EulerStep : public nlp::Piece {
 public:
  /// First variables of y0, y1 and r, and the duration T [s] of the phase.
  EulerStep(const std::string& name, int y0, int y1, int rate, int duration, int intervals);

  void values(const nlp::ConstVector& x, nlp::Vector f) const override;
  void jacobian(const nlp::ConstVector& x, nlp::Matrix J) const override;
  void hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const override;

 private:
  double ratio_;  ///< h / T
};

}  // namespace mcplan::rhp
