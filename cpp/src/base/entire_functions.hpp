#pragma once

#include <array>

namespace mcplan {

/// Entire functions that carry a linear pendulum from flight (z = 0) to stiff contact without a case distinction:
///
///     F_n(z) = sum_i z^i / (2i + n)!,    z = stiffness [1/s^2] x duration^2 [s^2],    n = 0..5
///
/// F_0 = cosh(sqrt z), F_1 = sinh(sqrt z) / sqrt z, F_2 = (F_0 - 1) / z, ...; for z < 0 they are the cosine family.
/// Tazaki's eqs. (8)-(9) divide by the stiffness and are singular in flight; these are the same functions without it.
/// Theory: docs/theory/ddp.md, "Closed form".
class EntireFunctions {
 public:
  explicit EntireFunctions(double z);

  /// F_n(z) [-], n = 0..5.
  double operator()(int n) const { return values_[n]; }

  /// dF_n/dz = (F_{n+1} - n F_{n+2}) / 2, n = 0..3: no division by z.
  double derivative(int n) const { return 0.5 * (values_[n + 1] - n * values_[n + 2]); }

 private:
  std::array<double, 6> values_;
};

}  // namespace mcplan
