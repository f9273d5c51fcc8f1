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

// x = (L0, R0, R1, v0, a0, a1, T); L(s) = L0 + h (integral of R), so that the cost is h sum_k w_k |L(s_k)|^2

MomentumSquareOverTime::MomentumSquareOverTime(const LinearForceInterval& i, double mass, double gravity)
    : Piece("momentum_cost",
            triples_and_duration({i.momentum0, i.rate0, i.rate1, i.velocity0, i.acceleration0, i.acceleration1},
                                 i.duration),
            1),
      ratio_(1.0 / i.intervals),
      mass_(mass),
      gravity_(gravity) {}

void MomentumSquareOverTime::values(const nlp::ConstVector& x, nlp::Vector f) const {
  const Within within(x, 3, ratio_, mass_, gravity_);
  f[0] = 0.0;
  for (const auto& [s, weight] : kGauss) {
    const Vector3d L = x.head<3>() + within.h * within.value(RateCombination::integral(s));
    f[0] += within.h * weight * L.squaredNorm();
  }
}

void MomentumSquareOverTime::jacobian(const nlp::ConstVector& x, nlp::Matrix J) const {
  const Within within(x, 3, ratio_, mass_, gravity_);
  for (const auto& [s, weight] : kGauss) {
    const RateCombination c = RateCombination::integral(s);
    const Vector3d rise = within.value(c), L = x.head<3>() + within.h * rise;
    const double factor = 2.0 * within.h * weight;
    J.leftCols<3>() += factor * L.transpose();
    J.rightCols<Within::kCount>() += factor * within.h * L.transpose() * within.jacobian(c);
    J(0, 3 + Within::kDuration) += ratio_ * (factor * L.dot(rise) + weight * L.squaredNorm());
  }
}

void MomentumSquareOverTime::hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const {
  constexpr int kAll = 3 + Within::kCount, kPadded = kAll + 1;  // whole registers
  const Within within(x, 3, ratio_, mass_, gravity_);
  Eigen::Matrix<double, kPadded, kPadded> sum = Eigen::Matrix<double, kPadded, kPadded>::Zero();
  auto inner = sum.block<Within::kCount, Within::kCount>(3, 3);
  for (const auto& [s, weight] : kGauss) {
    const RateCombination c = RateCombination::integral(s);
    const Vector3d rise = within.value(c), L = x.head<3>() + within.h * rise;
    const Within::Jacobian of_rate = within.jacobian(c);
    Eigen::Matrix<double, kPadded, 3> of_L;  // transposed derivatives of L
    of_L.topRows<3>().setIdentity();
    of_L.middleRows<Within::kCount>(3) = within.h * of_rate.transpose();
    of_L.row(3 + Within::kDuration) += ratio_ * rise.transpose();
    of_L.bottomRows<1>().setZero();

    const double w = 2.0 * weights[0] * weight, factor = w * within.h;
    const Eigen::Matrix<double, 3, kPadded> scaled = factor * of_L.transpose();
    sum += of_L.lazyProduct(scaled);
    within.add_hessian(c, L, factor * within.h, inner);
    // of L itself, h times the integral of R: its duration's row beside that of the integral
    const Eigen::Matrix<double, Within::kCount, 1> beside = factor * ratio_ * of_rate.transpose() * L;
    inner.row(Within::kDuration) += beside.transpose();
    inner(Within::kDuration, Within::kDuration) += beside[Within::kDuration];
    // and of the factor h before |L|^2
    const Eigen::Matrix<double, kPadded, 1> before = w * ratio_ * (of_L * L);
    sum.row(3 + Within::kDuration) += before.transpose();
    sum(3 + Within::kDuration, 3 + Within::kDuration) += before[3 + Within::kDuration];
  }
  H += sum.topLeftCorner<kAll, kAll>();
}

}  // namespace mcplan::rhp
