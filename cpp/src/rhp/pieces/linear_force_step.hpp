#pragma once

#include "mcplan/nlp/piece.hpp"

namespace mcplan::rhp {

/// One interval, of length h = T / intervals, in which the forces are linear: the CoM is cubic in time, the angular
/// momentum of degree 4. 0 and 1 are the interval's two ends. All variables are first of three, but the duration T.
struct LinearForceInterval {
  int com0, com1, velocity0, velocity1, acceleration0, acceleration1;
  int momentum0 = -1, momentum1 = -1, rate0 = -1, rate1 = -1;  ///< of the angular momentum, where there is one
  int duration;
  int intervals;
};

/// v1 - v0 - h (a0 + a1) / 2 = 0.
class LinearForceVelocity : public nlp::Piece {
 public:
  explicit LinearForceVelocity(const LinearForceInterval& interval);
  void values(const nlp::ConstVector& x, nlp::Vector f) const override;
  void jacobian(const nlp::ConstVector& x, nlp::Matrix J) const override;
  void hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const override;

 private:
  double ratio_;  ///< h / T
};

/// c1 - c0 - h v0 - h^2 (2 a0 + a1) / 6 = 0.
class LinearForcePosition : public nlp::Piece {
 public:
  explicit LinearForcePosition(const LinearForceInterval& interval);
  void values(const nlp::ConstVector& x, nlp::Vector f) const override;
  void jacobian(const nlp::ConstVector& x, nlp::Matrix J) const override;
  void hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const override;

 private:
  double ratio_;
};

/// L1 - L0 - h (R0 + R1) / 2 + m h^2/6 v0 x (a0 - a1) - m h^3/12 a0 x a1 - m g h^3/24 (a0 + a1) x e_z = 0,
///
/// exact: L + m c x v has the rate sum_i p_i x f_i - m g c x e_z, which is a cubic. Derived in docs/theory/rhp.md. The
/// last three terms are what the trapezoidal rule for L leaves out.
class LinearForceMomentum : public nlp::Piece {
 public:
  LinearForceMomentum(const LinearForceInterval& interval, double mass, double gravity);
  void values(const nlp::ConstVector& x, nlp::Vector f) const override;
  void jacobian(const nlp::ConstVector& x, nlp::Matrix J) const override;
  void hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const override;

 private:
  double ratio_, mass_, gravity_;
};

}  // namespace mcplan::rhp
