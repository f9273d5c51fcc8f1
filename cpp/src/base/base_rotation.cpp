#include "base/base_rotation.hpp"

#include <cmath>

namespace mcplan {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Sine and cosine of the sum of two angles, of which the second is small as a rule.
inline void add_angle(double& sine, double& cosine, double by) {
  // Below a quarter the series to the eleventh and twelfth power err by less than rounding, without a division.
  constexpr double kSmall = 0.25;
  double s, c;
  if (std::abs(by) < kSmall) {
    const double b = by * by;
    s = by + by * b * (-1.0 / 6 + b * (1.0 / 120 + b * (-1.0 / 5040 + b * (1.0 / 362880 + b * (-1.0 / 39916800)))));
    c = 1.0 + b * (-0.5 + b * (1.0 / 24 +
                               b * (-1.0 / 720 + b * (1.0 / 40320 + b * (-1.0 / 3628800 + b * (1.0 / 479001600))))));
  } else {
    s = std::sin(by);
    c = std::cos(by);
  }
  const double sum = sine * c + cosine * s;
  cosine = cosine * c - sine * s;
  sine = sum;
}

/// A momentum turned into the base step by step.
struct RatesOfAngles {
  const RpyTrig& t;
  Vector3d after_yaw, after_pitch, in_base;

  RatesOfAngles(const RpyTrig& trig, const Vector3d& l)
      : t(trig),
        after_yaw(t.cy * l[0] + t.sy * l[1], t.cy * l[1] - t.sy * l[0], l[2]),
        after_pitch(pitched(after_yaw)),
        in_base(rolled(after_pitch)) {}

  Vector3d pitched(const Vector3d& l) const { return {t.cp * l[0] - t.sp * l[2], l[1], t.sp * l[0] + t.cp * l[2]}; }
  Vector3d rolled(const Vector3d& l) const { return {l[0], t.cr * l[1] + t.sr * l[2], t.cr * l[2] - t.sr * l[1]}; }

  /// Rates of the angles of an angular velocity in the axes of the base.
  Vector3d rates(const Vector3d& omega) const {
    const double level = (t.sr * omega[1] + t.cr * omega[2]) / t.cp;
    return {omega[0] + t.sp * level, t.cr * omega[1] - t.sr * omega[2], level};
  }
};

Vector3d rate_of(const RpyTrig& trig, const Vector3d& momentum_W, const Vector3d& inverse_inertia) {
  const RatesOfAngles angles(trig, momentum_W);
  return angles.rates(angles.in_base.cwiseProduct(inverse_inertia));
}

RpyRate differentiated(const RpyTrig& t, const Vector3d& momentum_W, const Vector3d& inverse_inertia) {
  const RatesOfAngles angles(t, momentum_W);
  const Vector3d omega = angles.in_base.cwiseProduct(inverse_inertia);
  RpyRate out;
  out.rate = angles.rates(omega);

  // The momentum seen from the base turns against each angle.
  const Vector3d by_roll(0.0, angles.in_base[2], -angles.in_base[1]);
  const Vector3d by_pitch = angles.rolled({-angles.after_pitch[2], 0.0, angles.after_pitch[0]});
  const Vector3d by_yaw = angles.rolled(angles.pitched({angles.after_yaw[1], -angles.after_yaw[0], 0.0}));
  out.d_rpy.col(0) = angles.rates(by_roll.cwiseProduct(inverse_inertia));
  out.d_rpy.col(1) = angles.rates(by_pitch.cwiseProduct(inverse_inertia));
  out.d_rpy.col(2) = angles.rates(by_yaw.cwiseProduct(inverse_inertia));
  // And the rates' own dependence on roll and pitch.
  const double level = t.sr * omega[1] + t.cr * omega[2], level_by_roll = t.cr * omega[1] - t.sr * omega[2];
  out.d_rpy.col(0) += Vector3d(t.sp / t.cp * level_by_roll, -level, level_by_roll / t.cp);
  out.d_rpy.col(1) += level / (t.cp * t.cp) * Vector3d(1.0, 0.0, t.sp);

  const Vector3d x = angles.rolled(angles.pitched({t.cy, -t.sy, 0.0}));
  const Vector3d y = angles.rolled(angles.pitched({t.sy, t.cy, 0.0}));
  const Vector3d z = angles.rolled(angles.pitched({0.0, 0.0, 1.0}));
  out.d_momentum.col(0) = angles.rates(x.cwiseProduct(inverse_inertia));
  out.d_momentum.col(1) = angles.rates(y.cwiseProduct(inverse_inertia));
  out.d_momentum.col(2) = angles.rates(z.cwiseProduct(inverse_inertia));
  return out;
}

}  // namespace

RpyTrig::RpyTrig(const Vector3d& rpy)
    : sr(std::sin(rpy[0])),
      cr(std::cos(rpy[0])),
      sp(std::sin(rpy[1])),
      cp(std::cos(rpy[1])),
      sy(std::sin(rpy[2])),
      cy(std::cos(rpy[2])) {}

RpyTrig RpyTrig::plus(const Vector3d& by) const {
  RpyTrig out = *this;
  add_angle(out.sr, out.cr, by[0]);
  add_angle(out.sp, out.cp, by[1]);
  add_angle(out.sy, out.cy, by[2]);
  return out;
}

Vector3d rpy_rate(const RpyTrig& trig, const Vector3d& momentum_W, const Vector3d& inertia) {
  return rate_of(trig, momentum_W, inertia.cwiseInverse());
}

Vector3d base_momentum_W(const Vector3d& rpy, const Vector3d& rate, const Vector3d& inertia) {
  const RpyTrig trig(rpy);
  const Matrix3d r_WB = trig.rotation();
  return r_WB * inertia.cwiseProduct(r_WB.transpose() * trig.angular_velocity_W(rate));
}

Vector3d rpy_rate(const Vector3d& rpy, const Vector3d& momentum_W, const Vector3d& inertia) {
  return rpy_rate(RpyTrig(rpy), momentum_W, inertia);
}

RpyRate rpy_rate_derivatives(const Vector3d& rpy, const Vector3d& momentum_W, const Vector3d& inertia) {
  return differentiated(RpyTrig(rpy), momentum_W, inertia.cwiseInverse());
}

BaseRotation::BaseRotation(const Vector3d& rpy, const Vector3d& begin_W, const Vector3d& inertia)
    : rpy_(rpy), begin_W_(begin_W), inverse_inertia_(inertia.cwiseInverse()), trig_(rpy) {
  begin_rate_ = rate_of(trig_, begin_W, inverse_inertia_);
}

Vector3d BaseRotation::rpy(const Vector3d& middle_W, const Vector3d& end_W, double h) const {
  const Vector3d b = rate_of(trig_.plus(0.5 * h * begin_rate_), middle_W, inverse_inertia_);
  const Vector3d c = rate_of(trig_.plus(0.5 * h * b), middle_W, inverse_inertia_);
  const Vector3d d = rate_of(trig_.plus(h * c), end_W, inverse_inertia_);
  return rpy_ + h / 6.0 * (begin_rate_ + 2.0 * b + 2.0 * c + d);
}

void BaseRotation::differentiate(const Vector3d& middle_W, const Vector3d& end_W, double h, Derivatives& out) const {
  // Columns: theta, momentum at the begin, in the middle, at the end, h.
  using Columns = Eigen::Matrix<double, 3, 13>;
  const auto stage = [&](const Vector3d& slope, const Columns& d_slope, double step, double d_step, const Vector3d& l,
                         int column, Vector3d& rate, Columns& d_rate) {
    const RpyRate g = differentiated(trig_.plus(step * slope), l, inverse_inertia_);
    Columns at = step * d_slope;
    at.leftCols<3>() += Matrix3d::Identity();
    at.col(12) += d_step * slope;
    rate = g.rate;
    d_rate.noalias() = g.d_rpy * at;
    d_rate.middleCols<3>(column) += g.d_momentum;
  };
  Vector3d a, b, c, d;
  Columns da, db, dc, dd;
  stage(Vector3d::Zero(), Columns::Zero(), 0.0, 0.0, begin_W_, 3, a, da);
  stage(a, da, 0.5 * h, 0.5, middle_W, 6, b, db);
  stage(b, db, 0.5 * h, 0.5, middle_W, 6, c, dc);
  stage(c, dc, h, 1.0, end_W, 9, d, dd);
  const Vector3d sum = a + 2.0 * b + 2.0 * c + d;
  const Columns d_sum = da + 2.0 * db + 2.0 * dc + dd;
  out.rpy = rpy_ + h / 6.0 * sum;
  out.d_rpy = Matrix3d::Identity() + h / 6.0 * d_sum.leftCols<3>();
  out.d_begin = h / 6.0 * d_sum.middleCols<3>(3);
  out.d_middle = h / 6.0 * d_sum.middleCols<3>(6);
  out.d_end = h / 6.0 * d_sum.middleCols<3>(9);
  out.d_duration = sum / 6.0 + h / 6.0 * d_sum.col(12);
}

}  // namespace mcplan
