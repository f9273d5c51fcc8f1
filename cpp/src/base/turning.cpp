#include "mcplan/base/turning.hpp"

#include <cmath>

namespace mcplan {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Sines and cosines of the angles, and the momentum turned into the base step by step.
struct Turns {
  double sr, cr, sp, cp, sy, cy;
  Vector3d after_yaw, after_pitch, in_base;

  Turns(const Vector3d& rpy, const Vector3d& l)
      : sr(std::sin(rpy[0])),
        cr(std::cos(rpy[0])),
        sp(std::sin(rpy[1])),
        cp(std::cos(rpy[1])),
        sy(std::sin(rpy[2])),
        cy(std::cos(rpy[2])),
        after_yaw(cy * l[0] + sy * l[1], cy * l[1] - sy * l[0], l[2]),
        after_pitch(pitched(after_yaw)),
        in_base(rolled(after_pitch)) {}

  Vector3d pitched(const Vector3d& l) const { return {cp * l[0] - sp * l[2], l[1], sp * l[0] + cp * l[2]}; }
  Vector3d rolled(const Vector3d& l) const { return {l[0], cr * l[1] + sr * l[2], cr * l[2] - sr * l[1]}; }

  /// Rates of the angles of an angular velocity in the axes of the base.
  Vector3d rates(const Vector3d& omega) const {
    const double level = sr * omega[1] + cr * omega[2];
    return {omega[0] + sp / cp * level, cr * omega[1] - sr * omega[2], level / cp};
  }
};

}  // namespace

Vector3d rpy_rate(const Vector3d& rpy, const Vector3d& momentum_W, const Vector3d& inertia) {
  const Turns t(rpy, momentum_W);
  return t.rates(t.in_base.cwiseQuotient(inertia));
}

TurningRate turning_rate(const Vector3d& rpy, const Vector3d& momentum_W, const Vector3d& inertia) {
  const Turns t(rpy, momentum_W);
  const Vector3d omega = t.in_base.cwiseQuotient(inertia);
  TurningRate out;
  out.rate = t.rates(omega);

  // The momentum seen from the base turns against each angle.
  const Vector3d by_roll(0.0, t.in_base[2], -t.in_base[1]);
  const Vector3d by_pitch = t.rolled({-t.after_pitch[2], 0.0, t.after_pitch[0]});
  const Vector3d by_yaw = t.rolled(t.pitched({t.after_yaw[1], -t.after_yaw[0], 0.0}));
  out.d_rpy.col(0) = t.rates(by_roll.cwiseQuotient(inertia));
  out.d_rpy.col(1) = t.rates(by_pitch.cwiseQuotient(inertia));
  out.d_rpy.col(2) = t.rates(by_yaw.cwiseQuotient(inertia));
  // And the rates' own dependence on roll and pitch.
  const double level = t.sr * omega[1] + t.cr * omega[2], level_by_roll = t.cr * omega[1] - t.sr * omega[2];
  out.d_rpy.col(0) += Vector3d(t.sp / t.cp * level_by_roll, -level, level_by_roll / t.cp);
  out.d_rpy.col(1) += level / (t.cp * t.cp) * Vector3d(1.0, 0.0, t.sp);

  const Vector3d x = t.rolled(t.pitched({t.cy, -t.sy, 0.0})), y = t.rolled(t.pitched({t.sy, t.cy, 0.0}));
  const Vector3d z = t.rolled(t.pitched({0.0, 0.0, 1.0}));
  out.d_momentum.col(0) = t.rates(x.cwiseQuotient(inertia));
  out.d_momentum.col(1) = t.rates(y.cwiseQuotient(inertia));
  out.d_momentum.col(2) = t.rates(z.cwiseQuotient(inertia));
  return out;
}

Vector3d turned_rpy(const Vector3d& rpy, const Vector3d& begin_W, const Vector3d& middle_W, const Vector3d& end_W,
                    const Vector3d& inertia, double h) {
  const Vector3d a = rpy_rate(rpy, begin_W, inertia);
  const Vector3d b = rpy_rate(rpy + 0.5 * h * a, middle_W, inertia);
  const Vector3d c = rpy_rate(rpy + 0.5 * h * b, middle_W, inertia);
  const Vector3d d = rpy_rate(rpy + h * c, end_W, inertia);
  return rpy + h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
}

void turn(const Vector3d& rpy, const Vector3d& begin_W, const Vector3d& middle_W, const Vector3d& end_W,
          const Vector3d& inertia, double h, Turned& out) {
  // Columns: theta, momentum at the begin, in the middle, at the end, h.
  using Columns = Eigen::Matrix<double, 3, 13>;
  const auto stage = [&](const Vector3d& slope, const Columns& d_slope, double step, double d_step, const Vector3d& l,
                         int column, Vector3d& rate, Columns& d_rate) {
    const TurningRate g = turning_rate(rpy + step * slope, l, inertia);
    Columns at = step * d_slope;
    at.leftCols<3>() += Matrix3d::Identity();
    at.col(12) += d_step * slope;
    rate = g.rate;
    d_rate.noalias() = g.d_rpy * at;
    d_rate.middleCols<3>(column) += g.d_momentum;
  };
  Vector3d a, b, c, d;
  Columns da, db, dc, dd;
  stage(Vector3d::Zero(), Columns::Zero(), 0.0, 0.0, begin_W, 3, a, da);
  stage(a, da, 0.5 * h, 0.5, middle_W, 6, b, db);
  stage(b, db, 0.5 * h, 0.5, middle_W, 6, c, dc);
  stage(c, dc, h, 1.0, end_W, 9, d, dd);
  const Vector3d sum = a + 2.0 * b + 2.0 * c + d;
  const Columns d_sum = da + 2.0 * db + 2.0 * dc + dd;
  out.rpy = rpy + h / 6.0 * sum;
  out.d_rpy = Matrix3d::Identity() + h / 6.0 * d_sum.leftCols<3>();
  out.d_begin = h / 6.0 * d_sum.middleCols<3>(3);
  out.d_middle = h / 6.0 * d_sum.middleCols<3>(6);
  out.d_end = h / 6.0 * d_sum.middleCols<3>(9);
  out.d_duration = sum / 6.0 + h / 6.0 * d_sum.col(12);
}

}  // namespace mcplan
