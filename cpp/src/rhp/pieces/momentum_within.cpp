#include "rhp/pieces/momentum_within.hpp"

#include <Eigen/Geometry>
#include <array>

#include "rhp/pieces/contact_point.hpp"

namespace mcplan::rhp {
namespace {

using Eigen::Vector3d;

/// The variables, and how a combination and its derivatives are made of them.
struct Within {
  static constexpr int kR0 = 0, kR1 = 3, kV0 = 6, kA0 = 9, kA1 = 12, kDuration = 15, kCount = 16;
  using Jacobian = Eigen::Matrix<double, 3, kCount>;

  Vector3d R0, R1, v0, a0, a1;
  double h, ratio, mass, gravity;

  Within(const nlp::ConstVector& x, int first, double ratio, double mass, double gravity)
      : R0(x.segment<3>(first + kR0)),
        R1(x.segment<3>(first + kR1)),
        v0(x.segment<3>(first + kV0)),
        a0(x.segment<3>(first + kA0)),
        a1(x.segment<3>(first + kA1)),
        h(ratio * x[first + kDuration]),
        ratio(ratio),
        mass(mass),
        gravity(gravity) {}

  /// m (h `once` + h^2 `twice`) is what beta and gamma have in a combination.
  Vector3d once(const RateCombination& c) const { return c.of_beta * v0.cross(a1 - a0); }
  Vector3d twice(const RateCombination& c) const {
    const Vector3d up = Vector3d::UnitZ();
    return c.of_gamma / 3.0 * a0.cross(a1) + gravity_of_a0(c) * a0.cross(up) + gravity_of_a1(c) * a1.cross(up);
  }
  double gravity_of_a0(const RateCombination& c) const { return gravity * (c.of_beta / 2.0 - c.of_gamma / 6.0); }
  double gravity_of_a1(const RateCombination& c) const { return gravity * c.of_gamma / 6.0; }

  Vector3d value(const RateCombination& c) const {
    return c.of_R0 * R0 + c.of_R1 * R1 + mass * h * (once(c) + h * twice(c));
  }

  Jacobian jacobian(const RateCombination& c) const {
    const double m1 = mass * h, m2 = m1 * h;
    const Eigen::Matrix3d up = skew(Vector3d::UnitZ());
    Jacobian J = Jacobian::Zero();
    J.middleCols<3>(kR0).diagonal().setConstant(c.of_R0);
    J.middleCols<3>(kR1).diagonal().setConstant(c.of_R1);
    J.middleCols<3>(kV0) = -m1 * c.of_beta * skew(a1 - a0);
    J.middleCols<3>(kA0) = -m1 * c.of_beta * skew(v0) - m2 * (c.of_gamma / 3.0 * skew(a1) + gravity_of_a0(c) * up);
    J.middleCols<3>(kA1) = m1 * c.of_beta * skew(v0) + m2 * (c.of_gamma / 3.0 * skew(a0) - gravity_of_a1(c) * up);
    J.col(kDuration) = ratio * mass * (once(c) + 2.0 * h * twice(c));
    return J;
  }

  /// Adds factor times the lower triangle of the second derivatives of y . (combination).
  template <class Matrix>
  void add_hessian(const RateCombination& c, const Vector3d& y, double factor, Matrix&& H) const {
    const double m1 = factor * mass * h, m2 = m1 * h;
    const Vector3d up_y = Vector3d::UnitZ().cross(y), y_v0 = c.of_beta * y.cross(v0);
    H.template block<3, 3>(kA0, kV0) -= m1 * c.of_beta * skew(y);
    H.template block<3, 3>(kA1, kV0) += m1 * c.of_beta * skew(y);
    H.template block<3, 3>(kA1, kA0) += m2 * c.of_gamma / 3.0 * skew(y);
    const double once_m = factor * ratio * mass, twice_m = 2.0 * ratio * m1;
    H.template block<1, 3>(kDuration, kV0) += once_m * c.of_beta * (a1 - a0).cross(y).transpose();
    H.template block<1, 3>(kDuration, kA0) +=
        (-once_m * y_v0 + twice_m * (c.of_gamma / 3.0 * a1.cross(y) + gravity_of_a0(c) * up_y)).transpose();
    H.template block<1, 3>(kDuration, kA1) +=
        (once_m * y_v0 + twice_m * (c.of_gamma / 3.0 * y.cross(a0) + gravity_of_a1(c) * up_y)).transpose();
    H(kDuration, kDuration) += 2.0 * ratio * once_m * y.dot(twice(c));
  }
};

/// Bernstein's form of the cubic R(s): of s (1 - s) it is (0, 1/3, 1/3, 0), of s (1 - s^2) (0, 1/3, 2/3, 0).
constexpr std::array<RateCombination, 2> kControlPoints{
    {{2.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, {1.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0}}};

struct GaussPoint {
  double s, weight;
};

/// Gauss's rule of five points on [0, 1].
constexpr std::array<GaussPoint, 5> kGauss{{{0.046910077030668004, 0.11846344252809454},
                                            {0.23076534494715845, 0.23931433524968324},
                                            {0.5, 0.28444444444444444},
                                            {0.7692346550528415, 0.23931433524968324},
                                            {0.953089922969332, 0.11846344252809454}}};

}  // namespace

RateCombination RateCombination::at(double s) { return {1.0 - s, s, s * (1.0 - s), s * (1.0 - s * s)}; }

RateCombination RateCombination::integral(double s) {
  const double half = 0.5 * s * s;
  return {s - half, half, half - s * s * s / 3.0, half - half * half};
}

MomentumRateWithin::MomentumRateWithin(const LinearForceInterval& i, const Eigen::Matrix3d& axes_W, double mass,
                                       double gravity)
    : Piece("momentum_rate_within",
            triples_and_duration({i.rate0, i.rate1, i.velocity0, i.acceleration0, i.acceleration1}, i.duration), 6),
      axes_W_(axes_W),
      ratio_(1.0 / i.intervals),
      mass_(mass),
      gravity_(gravity) {}

void MomentumRateWithin::values(const nlp::ConstVector& x, nlp::Vector f) const {
  const Within within(x, 0, ratio_, mass_, gravity_);
  for (int i : {0, 1}) f.segment<3>(3 * i) = axes_W_.transpose() * within.value(kControlPoints[i]);
}

void MomentumRateWithin::jacobian(const nlp::ConstVector& x, nlp::Matrix J) const {
  const Within within(x, 0, ratio_, mass_, gravity_);
  for (int i : {0, 1}) J.middleRows<3>(3 * i).noalias() = axes_W_.transpose() * within.jacobian(kControlPoints[i]);
}

void MomentumRateWithin::hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const {
  const Within within(x, 0, ratio_, mass_, gravity_);
  for (int i : {0, 1}) within.add_hessian(kControlPoints[i], axes_W_ * weights.segment<3>(3 * i), 1.0, H);
}

// x = (L0, R0, R1, v0, a0, a1, T). L(s) is a sum of five vectors times polynomials, whose Gram matrix G is constant:
//
//     V = (L0, h R0, h R1, m h beta, m h gamma),   cost = h sum_ij G_ij V_i . V_j = h sum_i V_i . M_i,   M = G V

namespace {

using Gram = Eigen::Matrix<double, 5, 5>;

Gram gram_of_momentum() {
  Gram out = Gram::Zero();
  for (const auto& [s, weight] : kGauss) {
    const RateCombination c = RateCombination::integral(s);
    const Eigen::Matrix<double, 5, 1> at(1.0, c.of_R0, c.of_R1, c.of_beta, c.of_gamma);
    out += weight * at * at.transpose();
  }
  return out;
}

/// The five vectors, and what the cost and its derivatives are made of.
struct MomentumSquare {
  static constexpr int kL0 = 0, kR0 = 3, kR1 = 6, kV0 = 9, kA0 = 12, kA1 = 15, kDuration = 18, kCount = 19;
  static constexpr int kCurved = 10;  // the last ones, v0, a0, a1 and T, in which beta and gamma are not linear
  using Five = Eigen::Matrix<double, 3, 5>;
  using Curved = Eigen::Matrix<double, 3, kCurved>;

  Vector3d R0, R1, v0, a0, a1, up = Vector3d::UnitZ();
  double h, ratio, mass, gravity;
  Vector3d twice, thrice, gamma;  ///< m h beta = m h^2 twice + m h^3 thrice, and m h^3 gamma
  Gram G;
  Five V, M;

  MomentumSquare(const nlp::ConstVector& x, double ratio, double mass, double gravity)
      : R0(x.segment<3>(kR0)),
        R1(x.segment<3>(kR1)),
        v0(x.segment<3>(kV0)),
        a0(x.segment<3>(kA0)),
        a1(x.segment<3>(kA1)),
        h(ratio * x[kDuration]),
        ratio(ratio),
        mass(mass),
        gravity(gravity),
        twice(v0.cross(a1 - a0)),
        thrice(gravity / 2.0 * a0.cross(up)),
        gamma(a0.cross(a1) / 3.0 + gravity / 6.0 * (a1 - a0).cross(up)) {
    static const Gram gram = gram_of_momentum();
    G = gram;
    V << x.segment<3>(kL0), h * R0, h * R1, mass * h * h * (twice + h * thrice), mass * h * h * h * gamma;
    M.noalias() = V * G;
  }

  double square() const { return V.cwiseProduct(M).sum(); }

  /// sum_i V_i' . M_i, half the gradient of the square, and the derivatives by T of its entries in v0, a0 and a1, with
  /// M held.
  struct Slope {
    Eigen::Matrix<double, kCount, 1> of_all;
    Vector3d of_v0, of_a0, of_a1;
  };
  Slope slope() const {
    const Vector3d beta = M.col(3), bent = M.col(4), across = v0.cross(beta);
    const Vector3d high_a0 = up.cross(gravity / 2.0 * beta - gravity / 6.0 * bent) + a1.cross(bent) / 3.0;
    const Vector3d high_a1 = up.cross(gravity / 6.0 * bent) + bent.cross(a0) / 3.0;
    const Vector3d of_v0 = (a1 - a0).cross(beta);
    const double m2 = mass * h * h, m3 = m2 * h, mT = ratio * mass * h, mTT = 3.0 * mT * h;
    Slope out;
    out.of_all << M.col(0), h * M.col(1), h * M.col(2), m2 * of_v0, m2 * across + m3 * high_a0,
        m3 * high_a1 - m2 * across,
        ratio * (R0.dot(M.col(1)) + R1.dot(M.col(2))) + 2.0 * mT * twice.dot(beta) +
            mTT * (thrice.dot(beta) + gamma.dot(bent));
    out.of_v0 = 2.0 * mT * of_v0;
    out.of_a0 = 2.0 * mT * across + mTT * high_a0;
    out.of_a1 = mTT * high_a1 - 2.0 * mT * across;
    return out;
  }

  /// Derivatives of the last two vectors by v0, a0, a1 and T.
  std::array<Curved, 2> slopes() const {
    const double m2 = mass * h * h, m3 = m2 * h;
    std::array<Curved, 2> out;
    const Eigen::Matrix3d by_v0 = skew(v0), by_up = skew(up);
    out[0] << -m2 * skew(a1 - a0), -m2 * by_v0 - m3 * gravity / 2.0 * by_up, m2 * by_v0,
        ratio * mass * h * (2.0 * twice + 3.0 * h * thrice);
    out[1] << Eigen::Matrix3d::Zero(), m3 * (gravity / 6.0 * by_up - skew(a1) / 3.0),
        m3 * (skew(a0) / 3.0 - gravity / 6.0 * by_up), 3.0 * ratio * mass * h * h * gamma;
    return out;
  }
};

}  // namespace

MomentumSquareOverTime::MomentumSquareOverTime(const LinearForceInterval& i, double mass, double gravity)
    : Piece("momentum_cost",
            triples_and_duration({i.momentum0, i.rate0, i.rate1, i.velocity0, i.acceleration0, i.acceleration1},
                                 i.duration),
            1),
      ratio_(1.0 / i.intervals),
      mass_(mass),
      gravity_(gravity) {}

void MomentumSquareOverTime::values(const nlp::ConstVector& x, nlp::Vector f) const {
  const MomentumSquare s(x, ratio_, mass_, gravity_);
  f[0] = s.h * s.square();
}

void MomentumSquareOverTime::jacobian(const nlp::ConstVector& x, nlp::Matrix J) const {
  const MomentumSquare s(x, ratio_, mass_, gravity_);
  J.row(0) = 2.0 * s.h * s.slope().of_all.transpose();
  J(0, MomentumSquare::kDuration) += ratio_ * s.square();
}

void MomentumSquareOverTime::hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const {
  using S = MomentumSquare;
  const S s(x, ratio_, mass_, gravity_);
  const double h = s.h, factor = 2.0 * weights[0] * h;
  const S::Slope slope = s.slope();
  const std::array<S::Curved, 2> slopes = s.slopes();
  constexpr int kT = S::kCurved - 1;
  const std::array<double, 3> of_h{1.0, h, h};  // V_i over L0, R0, R1
  const std::array<Vector3d, 3> by_T{Vector3d::Zero(), ratio_ * s.R0, ratio_ * s.R1};

  // sum_ij G_ij V_i' . V_j': of V_j' its part in v0, a0, a1 and T, summed over j
  const auto others = [&](int i) {
    S::Curved out = s.G(i, 3) * slopes[0] + s.G(i, 4) * slopes[1];
    out.col(kT) += s.G(i, 1) * by_T[1] + s.G(i, 2) * by_T[2];
    return out;
  };
  Eigen::Matrix<double, S::kCurved, S::kCurved> curved = slopes[0].transpose().lazyProduct(others(3));
  curved += slopes[1].transpose().lazyProduct(others(4));
  for (int i = 0; i < 3; ++i) {
    const S::Curved beside = others(i);
    curved.row(kT) += by_T[i].transpose() * beside;
    H.block<S::kCurved, 3>(S::kV0, 3 * i) = factor * of_h[i] * beside.transpose();
    for (int j = 0; j <= i; ++j)
      H.block<3, 3>(3 * i, 3 * j).diagonal().setConstant(factor * s.G(i, j) * of_h[i] * of_h[j]);
    if (i > 0) H.block<1, 3>(S::kDuration, 3 * i) += factor * ratio_ * s.M.col(i).transpose();
  }
  // sum_i M_i . V_i''
  const Vector3d beta = s.M.col(3), bent = s.M.col(4);
  const double m2 = s.mass * h * h;
  curved.block<3, 3>(3, 0) -= m2 * skew(beta);
  curved.block<3, 3>(6, 0) += m2 * skew(beta);
  curved.block<3, 3>(6, 3) += m2 * h / 3.0 * skew(bent);
  curved.row(kT).head<3>() += slope.of_v0.transpose();
  curved.row(kT).segment<3>(3) += slope.of_a0.transpose();
  curved.row(kT).segment<3>(6) += slope.of_a1.transpose();
  curved(kT, kT) +=
      ratio_ * ratio_ * s.mass * (2.0 * s.twice.dot(beta) + 6.0 * h * (s.thrice.dot(beta) + s.gamma.dot(bent)));
  H.block<S::kCurved, S::kCurved>(S::kV0, S::kV0) = factor * curved;
  // and of the factor h before the square
  const double before = 2.0 * weights[0] * ratio_;
  H.row(S::kDuration) += before * slope.of_all.transpose();
  H(S::kDuration, S::kDuration) += before * slope.of_all[S::kDuration];
}

}  // namespace mcplan::rhp
