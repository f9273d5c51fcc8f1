#pragma once

#include <Eigen/Core>

#include "mcplan/nlp/piece.hpp"
#include "rhp/pieces/linear_force_step.hpp"

namespace mcplan::rhp {

/// What the angular momentum and its rate are between the two ends of an interval with linear forces, s = 0..1:
///
///     R(s) = (1 - s) R0 + s R1 + m (s (1 - s) beta + s (1 - s^2) gamma),
///     beta = h v0 x (a1 - a0) + h^2 g/2 a0 x e_z,
///     gamma = h^2/3 a0 x a1 + h^2 g/6 (a1 - a0) x e_z.
///
/// sum_i p_i x f_i is linear in s, and (c - c0) x m (a + g e_z), with the cubic c, is the rest: its term of s^4
/// vanishes. A combination of the four triples, and what pieces need of it; x = (R0, R1, v0, a0, a1, T).
struct RateCombination {
  double of_R0 = 0.0, of_R1 = 0.0, of_beta = 0.0, of_gamma = 0.0;  ///< the last two times m

  /// R at s, and its integral from 0 to s.
  static RateCombination at(double s);
  static RateCombination integral(double s);
};

/// The inner control points of R(s) as a cubic of Bernstein's form, in given axes: with R0 and R1 they span what R(s)
/// can be, so that limits of these six rows and of R at both ends hold on the whole of the interval.
class MomentumRateWithin : public nlp::Piece {
 public:
  /// axes_W: columns, the axes of the rows. mass [kg], gravity [m/s^2].
  MomentumRateWithin(const LinearForceInterval& interval, const Eigen::Matrix3d& axes_W, double mass, double gravity);
  void values(const nlp::ConstVector& x, nlp::Vector f) const override;
  void jacobian(const nlp::ConstVector& x, nlp::Matrix J) const override;
  void hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const override;

 private:
  Eigen::Matrix3d axes_W_;
  double ratio_, mass_, gravity_;
};

/// The integral of |L|^2 over the interval, exact: L is of degree 4 in s.
/// x = (L0, R0, R1, v0, a0, a1, T).
class MomentumSquareOverTime : public nlp::Piece {
 public:
  MomentumSquareOverTime(const LinearForceInterval& interval, double mass, double gravity);
  void values(const nlp::ConstVector& x, nlp::Vector f) const override;
  void jacobian(const nlp::ConstVector& x, nlp::Matrix J) const override;
  void hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const override;

 private:
  double ratio_, mass_, gravity_;
};

}  // namespace mcplan::rhp
