#include "planar/sip/jet.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "base/cubic_spline.hpp"

using mcplan::sip::Jet;

namespace {

/// A formula with every operation, for jets and numbers.
template <class Scalar>
Scalar formula(const std::array<Scalar, 3>& x) {
  Scalar out = x[0] * x[1] / (x[2] + Scalar(2.0)) - x[0];
  out += x[2] * x[2] * x[0];
  out -= -x[1] / x[0];
  return out * out + Scalar(1.0) / out;
}

}  // namespace

TEST_CASE("derivatives of a fraction are those of its closed form") {
  // f = a^2 b / (a + b)
  const double a = 1.3, b = -0.4, sum = a + b;
  const Jet x = Jet::variable(a, 0), y = Jet::variable(b, 3);
  const Jet f = x * x * y / (x + y);
  CHECK(f.value == doctest::Approx(a * a * b / sum));
  CHECK(f.gradient[0] == doctest::Approx((a * a * b + 2.0 * a * b * b) / (sum * sum)));
  CHECK(f.gradient[3] == doctest::Approx(a * a * a / (sum * sum)));
  CHECK(f.hessian(0, 0) == doctest::Approx(2.0 * b * b * b / std::pow(sum, 3)));
  CHECK(f.hessian(3, 3) == doctest::Approx(-2.0 * a * a * a / std::pow(sum, 3)));
  CHECK(f.hessian(0, 3) == doctest::Approx((a * a * a + 3.0 * a * a * b) / std::pow(sum, 3)));
  CHECK(f.hessian(3, 0) == doctest::Approx(f.hessian(0, 3)));
  CHECK(f.gradient[1] == 0.0);
}

TEST_CASE("a scaled variable has its scale in all derivatives") {
  const Jet x = Jet::variable(2.0, 1, 0.25);
  CHECK(x.value == 0.5);
  const Jet square = x * x;
  CHECK(square.gradient[1] == doctest::Approx(2.0 * 2.0 / 16.0));
  CHECK(square.hessian(1, 1) == doctest::Approx(2.0 / 16.0));
}

TEST_CASE("derivatives of random arguments agree with central differences") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> draw(0.5, 2.0);
  for (int trial = 0; trial < 50; ++trial) {
    const std::array<double, 3> at{draw(random), draw(random), draw(random)};
    const auto jets = [&](const std::array<double, 3>& x) {
      return formula<Jet>({Jet::variable(x[0], 0), Jet::variable(x[1], 1), Jet::variable(x[2], 2)});
    };
    const Jet f = jets(at);
    CHECK(f.value == doctest::Approx(formula<double>(at)));
    for (int i = 0; i < 3; ++i) {
      const double step = 1e-5;
      std::array<double, 3> above = at, below = at;
      above[i] += step;
      below[i] -= step;
      CAPTURE(trial);
      const double slope = (formula(above) - formula(below)) / (2.0 * step);
      CHECK(f.gradient[i] == doctest::Approx(slope).epsilon(1e-7));
      const Jet::Gradient bend = (jets(above).gradient - jets(below).gradient) / (2.0 * step);
      CHECK((f.hessian.col(i) - bend).norm() <= 1e-6 * (1.0 + bend.norm()));
    }
  }
}

TEST_CASE("a spline's basis changes with the lengths about it as its differences do") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> draw(0.1, 0.5);
  std::array<double, 5> at{};
  for (double& length : at) length = draw(random);
  const auto basis = [](const std::array<double, 5>& lengths) { return mcplan::cubic_spline_basis(lengths); };
  std::array<Jet, 5> jets;
  for (int d = 0; d < 5; ++d) jets[d] = Jet::variable(at[d], d);
  const Eigen::Matrix<Jet, 4, 4> exact = mcplan::cubic_spline_basis(jets);
  const double step = 1e-4;
  for (int d = 0; d < 5; ++d)
    for (int e = 0; e < 5; ++e) {
      const auto moved = [&](double by_d, double by_e) {
        std::array<double, 5> lengths = at;
        lengths[d] += by_d * step;
        lengths[e] += by_e * step;
        return basis(lengths);
      };
      const Eigen::Matrix4d mixed = (moved(1, 1) - moved(1, -1) - moved(-1, 1) + moved(-1, -1)) / (4.0 * step * step);
      const Eigen::Matrix4d slope = (moved(1, 0) - moved(-1, 0)) / (2.0 * step);
      for (int m = 0; m < 4; ++m)
        for (int i = 0; i < 4; ++i) {
          CHECK(exact(m, i).gradient[d] == doctest::Approx(slope(m, i)).epsilon(1e-5));
          CHECK(exact(m, i).hessian(d, e) == doctest::Approx(mixed(m, i)).epsilon(1e-4));
        }
    }
}
