#include "base/base_rotation.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <functional>
#include <random>

#include "mcplan/base/rotation.hpp"

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const Vector3d kInertia(2.0, 3.5, 1.2);

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  Vector3d vector(double scale) { return {scale * unit_(engine_), scale * unit_(engine_), scale * unit_(engine_)}; }

 private:
  std::mt19937 engine_;
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

/// Any roll and yaw, a pitch below 80 degrees.
Vector3d any_angles(Random& random) { return random.vector(1.0).cwiseProduct(Vector3d(3.0, 1.4, 3.0)); }

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d out;
  out << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return out;
}

/// R' = [R I^-1 R^T L(t)]x R for a time h, in `steps` midpoint steps of the exponential map.
Matrix3d turned_finely(const Vector3d& rpy, const std::function<Vector3d(double)>& momentum, double h, int steps) {
  Matrix3d r = mcplan::rotation_from_rpy(rpy);
  const double dt = h / steps;
  const auto by = [&](const Matrix3d& at, const Vector3d& l, double time) {
    const Vector3d turn = time * (at * (at.transpose() * l).cwiseQuotient(kInertia));
    return Matrix3d(Eigen::AngleAxisd(turn.norm(), turn.norm() > 0 ? Vector3d(turn.normalized()) : Vector3d::UnitX()));
  };
  for (int i = 0; i < steps; ++i) {
    const Matrix3d middle = by(r, momentum(i * dt), 0.5 * dt) * r;
    r = by(middle, momentum((i + 0.5) * dt), dt) * r;
  }
  return r;
}

double angle_between(const Matrix3d& a, const Matrix3d& b) {
  return std::abs(Eigen::AngleAxisd(a.transpose() * b).angle());
}

/// Largest difference of a Jacobian's columns from central differences of f.
double difference_error(const Matrix3d& jacobian, const Vector3d& x,
                        const std::function<Vector3d(const Vector3d&)>& f) {
  const double h = 1e-6;
  double worst = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Vector3d difference = (f(x + h * Vector3d::Unit(i)) - f(x - h * Vector3d::Unit(i))) / (2 * h);
    worst = std::max(worst, (difference - jacobian.col(i)).cwiseAbs().maxCoeff() / std::max(1.0, difference.norm()));
  }
  return worst;
}

Vector3d turned_rpy(const Vector3d& rpy, const Vector3d& begin, const Vector3d& middle, const Vector3d& end,
                    const Vector3d& inertia, double h) {
  return mcplan::BaseRotation(rpy, begin, inertia).rpy(middle, end, h);
}

}  // namespace

TEST_CASE("rates of the angles turn the rotation as the momentum asks") {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    const Vector3d rpy = any_angles(random), momentum = random.vector(5.0);
    const Vector3d rate = mcplan::rpy_rate(rpy, momentum, kInertia);
    const Matrix3d r = mcplan::rotation_from_rpy(rpy);
    Matrix3d r_rate = Matrix3d::Zero();
    for (int k = 0; k < 3; ++k) r_rate += rate[k] * mcplan::rotation_derivative(rpy, k);
    const Vector3d omega = r * (r.transpose() * momentum).cwiseQuotient(kInertia);
    CHECK((r_rate - cross_matrix(omega) * r).norm() < 1e-12 * std::max(1.0, rate.norm()));
    CHECK(mcplan::rpy_rate_derivatives(rpy, momentum, kInertia).rate == rate);
  }
}

TEST_CASE("the momentum of rates is what has these rates, whichever way the base heads") {
  Random random(6);
  for (int i = 0; i < 50; ++i) {
    const Vector3d rpy = any_angles(random), rate = random.vector(2.0);
    const Vector3d momentum_W = mcplan::base_momentum_W(rpy, rate, kInertia);
    CHECK((mcplan::rpy_rate(rpy, momentum_W, kInertia) - rate).norm() < 1e-11);
  }
  // A base that heads to the left and rolls turns about the world's y.
  const Vector3d rolls_W = mcplan::base_momentum_W({0.0, 0.0, M_PI_2}, {1.0, 0.0, 0.0}, kInertia);
  CHECK((rolls_W - Vector3d(0.0, kInertia.x(), 0.0)).norm() < 1e-12);
}

TEST_CASE("derivatives of the rates are their differences") {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    const Vector3d rpy = any_angles(random), momentum = random.vector(5.0);
    const auto out = mcplan::rpy_rate_derivatives(rpy, momentum, kInertia);
    CHECK(difference_error(out.d_rpy, rpy, [&](const Vector3d& x) { return mcplan::rpy_rate(x, momentum, kInertia); }) <
          1e-7);
    CHECK(difference_error(out.d_momentum, momentum,
                           [&](const Vector3d& x) { return mcplan::rpy_rate(rpy, x, kInertia); }) < 1e-8);
  }
}

TEST_CASE("derivatives of a turn are its differences, of all that it depends on") {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    CAPTURE(i);
    const Vector3d rpy = random.vector(1.0), begin = random.vector(3.0), middle = random.vector(3.0),
                   end = random.vector(3.0);
    const double h = 0.1 + 0.004 * i;
    mcplan::BaseRotation::Derivatives out;
    mcplan::BaseRotation(rpy, begin, kInertia).differentiate(middle, end, h, out);
    CHECK(out.rpy == turned_rpy(rpy, begin, middle, end, kInertia, h));
    CHECK(difference_error(out.d_rpy, rpy,
                           [&](const Vector3d& x) { return turned_rpy(x, begin, middle, end, kInertia, h); }) < 1e-8);
    CHECK(difference_error(out.d_begin, begin,
                           [&](const Vector3d& x) { return turned_rpy(rpy, x, middle, end, kInertia, h); }) < 1e-8);
    CHECK(difference_error(out.d_middle, middle,
                           [&](const Vector3d& x) { return turned_rpy(rpy, begin, x, end, kInertia, h); }) < 1e-8);
    CHECK(difference_error(out.d_end, end,
                           [&](const Vector3d& x) { return turned_rpy(rpy, begin, middle, x, kInertia, h); }) < 1e-8);
    const double dt = 1e-6;
    const Vector3d by_time = (turned_rpy(rpy, begin, middle, end, kInertia, h + dt) -
                              turned_rpy(rpy, begin, middle, end, kInertia, h - dt)) /
                             (2 * dt);
    CHECK((out.d_duration - by_time).norm() < 1e-8);
  }
}

TEST_CASE("a turn about one principal axis is L t / I, however far") {
  for (int axis : {0, 2}) {
    const Vector3d momentum = 20.0 * Vector3d::Unit(axis);
    const Vector3d turned = turned_rpy(Vector3d::Zero(), momentum, momentum, momentum, kInertia, 0.5);
    CHECK((turned - 0.5 * momentum.cwiseQuotient(kInertia)).norm() < 1e-13);
  }
}

TEST_CASE("a turn of a radian a second is that of a fine integration on the rotations, to 0.3 mrad in half a second") {
  Random random(4);
  double of_half_a_second = 0.0, of_a_quarter = 0.0;
  for (int i = 0; i < 20; ++i) {
    CAPTURE(i);
    const Vector3d rpy = random.vector(0.3), offset = random.vector(0.5), slope = random.vector(1.0),
                   bend = random.vector(1.0);
    const auto momentum = [&](double t) -> Vector3d { return offset + t * slope + t * t * bend; };
    const auto error = [&](double h) {
      const Vector3d turned = turned_rpy(rpy, momentum(0), momentum(h / 2), momentum(h), kInertia, h);
      return angle_between(turned_finely(rpy, momentum, h, 4000), mcplan::rotation_from_rpy(turned));
    };
    CHECK(error(0.5) < 3e-4);
    of_half_a_second += error(0.5);
    of_a_quarter += error(0.25);
  }
  CHECK(of_half_a_second > 1e-5);
  CHECK(of_a_quarter < of_half_a_second / 16.0);  // of order 4: a 32nd a step
}

TEST_CASE("a body that tumbles freely keeps its energy") {
  const Vector3d momentum(1.0, 1.5, -0.8);
  const auto energy = [&](const Vector3d& rpy) {
    const Vector3d in_base = mcplan::rotation_from_rpy(rpy).transpose() * momentum;
    return 0.5 * in_base.dot(in_base.cwiseQuotient(kInertia));
  };
  Vector3d rpy(0.2, -0.1, 0.4);
  const double before = energy(rpy);
  for (int i = 0; i < 10; ++i) {
    rpy = turned_rpy(rpy, momentum, momentum, momentum, kInertia, 0.1);
    CHECK(energy(rpy) == doctest::Approx(before).epsilon(1e-5));
  }
  CHECK(rpy.norm() > 0.5);
}
