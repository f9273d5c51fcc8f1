#pragma once

#include <Eigen/Geometry>

#include "rhp/pieces/linear_force_step.hpp"

namespace mcplan::rhp::tests {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// The integral of |L|^2 over an interval of length h, by Simpson's rule in small steps: the rate of L is what linear
/// forces have, of whose moment about the CoM at the begin R0 is one end, and the CoM moves on.
inline double momentum_cost(const LinearForceInterval& i, const VectorXd& x, double h) {
  const auto three = [&](int first) -> Vector3d { return x.segment<3>(first); };
  const Vector3d a0 = three(i.acceleration0), a1 = three(i.acceleration1), gravity(0.0, 0.0, 9.80665);
  const auto moved = [&](double t) -> Vector3d {
    return t * three(i.velocity0) + t * t / 2.0 * a0 + t * t * t / (6.0 * h) * (a1 - a0);
  };
  const auto force = [&](double t) -> Vector3d { return 95.0 * (a0 + t / h * (a1 - a0) + gravity); };
  const auto rate = [&](double t) -> Vector3d {
    const Vector3d moment = (1.0 - t / h) * three(i.rate0) + t / h * (three(i.rate1) + moved(h).cross(force(h)));
    return moment - moved(t).cross(force(t));
  };
  constexpr int kSteps = 100;
  const double dt = h / kSteps;
  const auto rise = [&](double from, double step) -> Vector3d {
    return step / 6.0 * (rate(from) + 4.0 * rate(from + step / 2.0) + rate(from + step));
  };
  Vector3d L = three(i.momentum0);
  double cost = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const Vector3d middle = L + rise(k * dt, dt / 2.0), end = L + rise(k * dt, dt);
    cost += dt / 6.0 * (L.squaredNorm() + 4.0 * middle.squaredNorm() + end.squaredNorm());
    L = end;
  }
  return cost;
}

}  // namespace mcplan::rhp::tests
