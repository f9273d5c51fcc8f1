#include "robot/ground_plane.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "mcplan/base/rotation.hpp"

TEST_CASE("a base on three feet and more has their plane's normal for its z, whatever its yaw") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int trial = 0; trial < 100; ++trial) {
    CAPTURE(trial);
    const double a = 0.4 * number(random), b = 0.4 * number(random), yaw = 3.0 * number(random);
    std::vector<Eigen::Vector3d> feet;
    for (const auto& [x, y] : {std::pair(0.3, 0.2), std::pair(0.3, -0.2), std::pair(-0.3, 0.2), std::pair(-0.2, -0.3)})
      if (trial % 2 == 0 || feet.size() < 3) feet.emplace_back(x, y, a * x + b * y + 0.7);
    const Eigen::Vector3d rpy = mcplan::rpy_along_ground(feet, yaw);
    CHECK(rpy.z() == yaw);
    const Eigen::Vector3d normal = Eigen::Vector3d(-a, -b, 1.0).normalized();
    CHECK((mcplan::rotation_from_rpy(rpy).col(2) - normal).norm() < 1e-12);
  }
}

TEST_CASE("a base on two feet, or on feet in a row, is upright") {
  const std::vector<Eigen::Vector3d> two{{0.0, 0.1, 0.0}, {0.0, -0.1, 0.2}};
  CHECK(mcplan::rpy_along_ground(two, 0.3) == Eigen::Vector3d(0.0, 0.0, 0.3));
  const std::vector<Eigen::Vector3d> row{{0.0, 0.1, 0.0}, {0.0, -0.1, 0.2}, {0.0, 0.3, 0.4}};
  CHECK(mcplan::rpy_along_ground(row, 0.3) == Eigen::Vector3d(0.0, 0.0, 0.3));
}
