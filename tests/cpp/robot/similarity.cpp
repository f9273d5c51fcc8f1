#include "mcplan/robot/similarity.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using mcplan::Robot;
using mcplan::Similarity;
using mcplan::similarity_of;

namespace {

Robot robot(double com_height, double mass) {
  Robot out;
  out.com_height = com_height;
  out.mass = mass;
  return out;
}

}  // namespace

TEST_CASE("robots of human size on earth have factors of one") {
  for (double height : {0.41, 0.458, 0.645, 0.7, 0.877, 1.0, 1.59})
    for (double mass : {20.0, 44.0, 95.0, 159.0})
      for (double gravity : {9.78, 9.8, 9.81}) {
        const Similarity s = similarity_of(robot(height, mass), gravity);
        CHECK(s.length == 1.0);
        CHECK(s.time == 1.0);
        CHECK(s.mass == 1.0);
      }
}

TEST_CASE("factors are powers of two within a factor of two of the exact ratios") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-12.0, 12.0);
  for (int i = 0; i < 2000; ++i) {
    const double height = std::exp2(exponent(random)), mass = std::exp2(2.0 * exponent(random)),
                 gravity = std::exp2(exponent(random));
    CAPTURE(height);
    CAPTURE(mass);
    CAPTURE(gravity);
    const Similarity s = similarity_of(robot(height, mass), gravity);
    int ignored = 0;
    for (double factor : {s.length, s.time, s.mass}) CHECK(std::frexp(factor, &ignored) == 0.5);
    const double length = height / 0.8 / s.length, time = std::sqrt(height / gravity * 9.81 / 0.8) / s.time;
    CHECK(length >= 0.5);
    CHECK(length < 2.0);
    CHECK(time > 0.707);
    CHECK(time < 1.415);
    CHECK(mass / 40.0 / s.mass >= 0.5);
    CHECK(mass / 40.0 / s.mass < 4.0);
  }
}

TEST_CASE("a robot larger by powers of 4, 2 and 8 has factors larger by the same") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> size(0.3, 2.0);
  std::uniform_int_distribution<int> power(-6, 6);
  for (int i = 0; i < 2000; ++i) {
    const double height = size(random), mass = 50.0 * size(random), gravity = 9.0 * size(random);
    const double length = std::ldexp(1.0, 2 * power(random)), time = std::ldexp(1.0, power(random)),
                 heavier = std::ldexp(1.0, 3 * power(random));
    const Similarity a = similarity_of(robot(height, mass), gravity);
    const Similarity b = similarity_of(robot(height * length, mass * heavier), gravity * length / (time * time));
    CHECK(b.length == a.length * length);
    CHECK(b.time == a.time * time);
    CHECK(b.mass == a.mass * heavier);
    CHECK(b.angular_momentum() == a.angular_momentum() * heavier * length * length / time);
  }
}

TEST_CASE("factors are finite and positive whatever the numbers") {
  const double huge = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::denorm_min();
  for (double height : {tiny, 1e-300, 1.0, 1e300, huge, 0.0, std::nan("")})
    for (double gravity : {tiny, 1.0, huge, 0.0, -9.81, std::nan("")}) {
      const Similarity s = similarity_of(robot(height, gravity), gravity);
      for (double factor : {s.length, s.time, s.mass, s.force(), s.moment(), s.angular_momentum(), s.rate()}) {
        CHECK(std::isfinite(factor));
        CHECK(factor > 0.0);
      }
    }
}

TEST_CASE("swing heights and durations go with the size where nobody has set them") {
  const Similarity s{16.0, 4.0, 4096.0};
  Robot giant;
  CHECK(swing_height_of(giant, s) == 16.0 * 0.10);
  CHECK(phase_duration_of(giant, s) == Eigen::Vector2d(4.0 * 0.15, 4.0 * 0.50));
  giant.swing_height = 1.2;
  giant.phase_duration = {0.9, 2.5};
  CHECK(swing_height_of(giant, s) == 1.2);
  CHECK(phase_duration_of(giant, s) == Eigen::Vector2d(0.9, 2.5));
}
