#include "wb/assembly.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <random>

using namespace mcplan::wb;
using Eigen::Vector3d;

TEST_CASE("the points of two segments that are nearest to each other are nearer than any others") {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  const auto point = [&] { return Vector3d(draw(random), draw(random), draw(random)); };
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d a0 = point(), a1 = trial % 10 == 0 ? a0 : point(), b0 = point();
    const Vector3d b1 = trial % 7 == 0 ? Vector3d(b0 + a1 - a0) : point();  // some are parallel, some are points
    const NearestPoints found = nearest_points(a0, a1, b0, b1);
    const auto apart = [&](double s, double t) { return (a0 + s * (a1 - a0) - b0 - t * (b1 - b0)).norm(); };
    const double least = apart(found.first, found.second);
    CHECK(found.first >= 0.0);
    CHECK(found.first <= 1.0);
    CHECK(found.second >= 0.0);
    CHECK(found.second <= 1.0);
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; j <= 40; ++j) REQUIRE(least <= apart(i / 40.0, j / 40.0) + 1e-9);
  }
}
