#include "rhp/pieces/linear_force_step.hpp"

#include <Eigen/Geometry>

#include "rhp/pieces/contact_point.hpp"

namespace mcplan::rhp {

using Eigen::Vector3d;

// x = (v0, v1, a0, a1, T)

LinearForceVelocity::LinearForceVelocity(const LinearForceInterval& i)
    : Piece("velocity_step",
            triples_and_duration({i.velocity0, i.velocity1, i.acceleration0, i.acceleration1}, i.duration), 3),
      ratio_(1.0 / i.intervals) {}

void LinearForceVelocity::values(const nlp::ConstVector& x, nlp::Vector f) const {
  f = x.segment<3>(3) - x.segment<3>(0) - 0.5 * ratio_ * x[12] * (x.segment<3>(6) + x.segment<3>(9));
}

void LinearForceVelocity::jacobian(const nlp::ConstVector& x, nlp::Matrix J) const {
  J.middleCols<3>(0).diagonal().setConstant(-1.0);
  J.middleCols<3>(3).diagonal().setConstant(1.0);
  for (int a : {6, 9}) J.middleCols<3>(a).diagonal().setConstant(-0.5 * ratio_ * x[12]);
  J.col(12) = -0.5 * ratio_ * (x.segment<3>(6) + x.segment<3>(9));
}

void LinearForceVelocity::hessian(const nlp::ConstVector&, const nlp::ConstVector& weights, nlp::Matrix H) const {
  for (int a : {6, 9}) H.block<1, 3>(12, a) = -0.5 * ratio_ * weights.transpose();
}

// x = (c0, c1, v0, a0, a1, T)

LinearForcePosition::LinearForcePosition(const LinearForceInterval& i)
    : Piece("position_step",
            triples_and_duration({i.com0, i.com1, i.velocity0, i.acceleration0, i.acceleration1}, i.duration), 3),
      ratio_(1.0 / i.intervals) {}

void LinearForcePosition::values(const nlp::ConstVector& x, nlp::Vector f) const {
  const double h = ratio_ * x[15];
  f = x.segment<3>(3) - x.segment<3>(0) - h * x.segment<3>(6) -
      h * h / 6.0 * (2.0 * x.segment<3>(9) + x.segment<3>(12));
}

void LinearForcePosition::jacobian(const nlp::ConstVector& x, nlp::Matrix J) const {
  const double h = ratio_ * x[15];
  J.middleCols<3>(0).diagonal().setConstant(-1.0);
  J.middleCols<3>(3).diagonal().setConstant(1.0);
  J.middleCols<3>(6).diagonal().setConstant(-h);
  J.middleCols<3>(9).diagonal().setConstant(-h * h / 3.0);
  J.middleCols<3>(12).diagonal().setConstant(-h * h / 6.0);
  J.col(15) = -ratio_ * (x.segment<3>(6) + h / 3.0 * (2.0 * x.segment<3>(9) + x.segment<3>(12)));
}

void LinearForcePosition::hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const {
  const double h = ratio_ * x[15];
  H.block<1, 3>(15, 6) = -ratio_ * weights.transpose();
  H.block<1, 3>(15, 9) = -ratio_ * h * 2.0 / 3.0 * weights.transpose();
  H.block<1, 3>(15, 12) = -ratio_ * h / 3.0 * weights.transpose();
  H(15, 15) = -ratio_ * ratio_ / 3.0 * weights.dot(2.0 * x.segment<3>(9) + x.segment<3>(12));
}

// x = (L0, L1, R0, R1, v0, a0, a1, T)

namespace {
constexpr int kL0 = 0, kL1 = 3, kR0 = 6, kR1 = 9, kV0 = 12, kA0 = 15, kA1 = 18, kDuration = 21;
}

LinearForceMomentum::LinearForceMomentum(const LinearForceInterval& i, double mass, double gravity)
    : Piece(
          "momentum_step",
          triples_and_duration(
              {i.momentum0, i.momentum1, i.rate0, i.rate1, i.velocity0, i.acceleration0, i.acceleration1}, i.duration),
          3),
      ratio_(1.0 / i.intervals),
      mass_(mass),
      gravity_(gravity) {}

void LinearForceMomentum::values(const nlp::ConstVector& x, nlp::Vector f) const {
  const double h = ratio_ * x[kDuration];
  const Vector3d v0 = x.segment<3>(kV0), a0 = x.segment<3>(kA0), a1 = x.segment<3>(kA1);
  f = x.segment<3>(kL1) - x.segment<3>(kL0) - 0.5 * h * (x.segment<3>(kR0) + x.segment<3>(kR1)) +
      mass_ * h * h *
          (v0.cross(a0 - a1) / 6.0 - h / 12.0 * a0.cross(a1) -
           gravity_ * h / 24.0 * (a0 + a1).cross(Vector3d::UnitZ()));
}

void LinearForceMomentum::jacobian(const nlp::ConstVector& x, nlp::Matrix J) const {
  const double h = ratio_ * x[kDuration];
  const Vector3d v0 = x.segment<3>(kV0), a0 = x.segment<3>(kA0), a1 = x.segment<3>(kA1), up = Vector3d::UnitZ();
  const double m2 = mass_ * h * h / 6.0, m3 = mass_ * h * h * h / 12.0, mg = 0.5 * gravity_ * m3;
  J.middleCols<3>(kL0).diagonal().setConstant(-1.0);
  J.middleCols<3>(kL1).diagonal().setConstant(1.0);
  for (int r : {kR0, kR1}) J.middleCols<3>(r).diagonal().setConstant(-0.5 * h);
  J.middleCols<3>(kV0) = -m2 * skew(a0 - a1);
  J.middleCols<3>(kA0) = m2 * skew(v0) + m3 * skew(a1) + mg * skew(up);
  J.middleCols<3>(kA1) = -m2 * skew(v0) - m3 * skew(a0) + mg * skew(up);
  J.col(kDuration) =
      ratio_ *
      (-0.5 * (x.segment<3>(kR0) + x.segment<3>(kR1)) +
       mass_ * h * (v0.cross(a0 - a1) / 3.0 - 0.25 * h * a0.cross(a1) - 0.125 * gravity_ * h * (a0 + a1).cross(up)));
}

void LinearForceMomentum::hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const {
  const double h = ratio_ * x[kDuration];
  const Vector3d y = weights, v0 = x.segment<3>(kV0), a0 = x.segment<3>(kA0), a1 = x.segment<3>(kA1);
  const Vector3d up = Vector3d::UnitZ(), difference = a0 - a1;
  for (int r : {kR0, kR1}) H.block<1, 3>(kDuration, r) = -0.5 * ratio_ * y.transpose();
  H.block<1, 3>(kDuration, kV0) = ratio_ * mass_ * h / 3.0 * difference.cross(y).transpose();
  const Vector3d from_v0 = mass_ * h / 3.0 * y.cross(v0);
  const Vector3d from_gravity = -0.125 * mass_ * gravity_ * h * h * up.cross(y);
  H.block<1, 3>(kDuration, kA0) = ratio_ * (from_v0 - 0.25 * mass_ * h * h * a1.cross(y) + from_gravity).transpose();
  H.block<1, 3>(kDuration, kA1) = ratio_ * (-from_v0 - 0.25 * mass_ * h * h * y.cross(a0) + from_gravity).transpose();
  H(kDuration, kDuration) =
      ratio_ * ratio_ * mass_ *
      y.dot(v0.cross(difference) / 3.0 - 0.5 * h * a0.cross(a1) - 0.25 * gravity_ * h * (a0 + a1).cross(up));
  // y . (v0 x a) = a . (y x v0) and y . (a0 x a1) = a1 . (y x a0)
  H.block<3, 3>(kA0, kV0) = mass_ * h * h / 6.0 * skew(y);
  H.block<3, 3>(kA1, kV0) = -mass_ * h * h / 6.0 * skew(y);
  H.block<3, 3>(kA1, kA0) = -mass_ * h * h * h / 12.0 * skew(y);
}

}  // namespace mcplan::rhp
