#include "base/cubic_spline.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

using mcplan::cubic_spline_basis;
using mcplan::spacing_about;

namespace {

constexpr int kIntervals = 9;

std::vector<double> random_lengths(std::mt19937& random) {
  std::uniform_real_distribution<double> log_length(std::log(0.02), std::log(2.0));
  std::vector<double> lengths(kIntervals);
  for (double& length : lengths) length = std::exp(log_length(random));
  return lengths;
}

/// Value, first and second derivative in time at s of interval k.
Eigen::Vector3d derivatives(const std::vector<double>& lengths, const Eigen::VectorXd& control, int k, double s) {
  const Eigen::Vector4d c = cubic_spline_basis<double>(spacing_about(lengths, k)) * control.segment<4>(k);
  const double rate = 2.0 / lengths[k];
  return {c[0] + s * (c[1] + s * (c[2] + s * c[3])), rate * (c[1] + s * (2.0 * c[2] + s * 3.0 * c[3])),
          rate * rate * (2.0 * c[2] + s * 6.0 * c[3])};
}

}  // namespace

TEST_CASE("a spline and its first two derivatives are continuous at knots of any spacing") {
  std::mt19937 random(1);
  for (int draw = 0; draw < 200; ++draw) {
    CAPTURE(draw);
    const std::vector<double> lengths = random_lengths(random);
    Eigen::VectorXd control(kIntervals + 3);
    for (double& c : control) c = std::uniform_real_distribution<double>(-1.0, 1.0)(random);
    for (int k = 0; k + 1 < kIntervals; ++k) {
      const Eigen::Vector3d before = derivatives(lengths, control, k, 1.0);
      const Eigen::Vector3d after = derivatives(lengths, control, k + 1, -1.0);
      const double h = std::min(lengths[k], lengths[k + 1]);
      CHECK(std::abs(before[0] - after[0]) < 1e-13);
      CHECK(std::abs(before[1] - after[1]) * h < 1e-12);
      CHECK(std::abs(before[2] - after[2]) * h * h < 1e-12);
    }
  }
}

TEST_CASE("the four splines of an interval are not negative and sum to one") {
  std::mt19937 random(2);
  for (int draw = 0; draw < 50; ++draw) {
    const std::vector<double> lengths = random_lengths(random);
    for (int k = 0; k < kIntervals; ++k) {
      const Eigen::Matrix4d basis = cubic_spline_basis<double>(spacing_about(lengths, k));
      for (double s : {-1.0, -0.6, 0.0, 0.3, 1.0}) {
        const Eigen::RowVector4d values = Eigen::RowVector4d(1.0, s, s * s, s * s * s) * basis;
        CHECK(values.sum() == doctest::Approx(1.0).epsilon(1e-13));
        CHECK(values.minCoeff() > -1e-14);
      }
    }
  }
}

TEST_CASE("three equal control points at each end are rest, whatever the lengths") {
  std::mt19937 random(3);
  const std::vector<double> lengths = random_lengths(random);
  Eigen::VectorXd control(kIntervals + 3);
  for (double& c : control) c = std::uniform_real_distribution<double>(-1.0, 1.0)(random);
  control.head<3>().setConstant(0.7);
  control.tail<3>().setConstant(-0.4);
  const Eigen::Vector3d begin = derivatives(lengths, control, 0, -1.0);
  const Eigen::Vector3d end = derivatives(lengths, control, kIntervals - 1, 1.0);
  CHECK(begin[0] == doctest::Approx(0.7).epsilon(1e-14));
  CHECK(end[0] == doctest::Approx(-0.4).epsilon(1e-14));
  for (int order : {1, 2}) {
    CHECK(std::abs(begin[order]) < 1e-10);
    CHECK(std::abs(end[order]) < 1e-10);
  }
}

TEST_CASE("equal lengths give the uniform cubic B-spline") {
  const Eigen::Matrix4d basis = cubic_spline_basis<double>({0.3, 0.3, 0.3, 0.3, 0.3});
  const Eigen::RowVector4d begin = Eigen::RowVector4d(1.0, -1.0, 1.0, -1.0) * basis;
  const Eigen::RowVector4d middle = Eigen::RowVector4d(1.0, 0.0, 0.0, 0.0) * basis;
  CHECK((begin - Eigen::RowVector4d(1.0, 4.0, 1.0, 0.0) / 6.0).norm() < 1e-14);
  CHECK((middle - Eigen::RowVector4d(1.0, 23.0, 23.0, 1.0) / 48.0).norm() < 1e-14);
}

TEST_CASE("beyond its ends the end spacing repeats") {
  const std::vector<double> lengths{1.0, 2.0, 3.0};
  CHECK(spacing_about(lengths, 0) == std::array<double, 5>{1.0, 1.0, 1.0, 2.0, 3.0});
  CHECK(spacing_about(lengths, 1) == std::array<double, 5>{1.0, 1.0, 2.0, 3.0, 3.0});
  CHECK(spacing_about(lengths, 2) == std::array<double, 5>{1.0, 2.0, 3.0, 3.0, 3.0});
}
