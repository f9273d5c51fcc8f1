#include "mcplan/base/rotation.hpp"

#include <doctest/doctest.h>

#include <random>

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

Matrix3d by_eigen(const Vector3d& rpy) {
  return (AngleAxisd(rpy[2], Vector3d::UnitZ()) * AngleAxisd(rpy[1], Vector3d::UnitY()) *
          AngleAxisd(rpy[0], Vector3d::UnitX()))
      .toRotationMatrix();
}

template <typename Visit>
void for_random_angles(Visit visit) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-3.2, 3.2);
  for (int i = 0; i < 200; ++i) {
    const Vector3d rpy(angle(random), angle(random), angle(random));
    CAPTURE(i);
    CAPTURE(rpy.transpose());
    visit(rpy);
  }
}

}  // namespace

TEST_CASE("roll, pitch and yaw turn like Eigen's Rz Ry Rx") {
  for_random_angles([](const Vector3d& rpy) { CHECK(mcplan::rotation_from_rpy(rpy).isApprox(by_eigen(rpy), 1e-14)); });
}

TEST_CASE("rotation derivatives agree with central differences") {
  for_random_angles([](const Vector3d& rpy) {
    const double h = 1e-6;
    for (int i = 0; i < 3; ++i) {
      const Matrix3d difference =
          (by_eigen(rpy + h * Vector3d::Unit(i)) - by_eigen(rpy - h * Vector3d::Unit(i))) / (2 * h);
      CHECK((mcplan::rotation_derivative(rpy, i) - difference).cwiseAbs().maxCoeff() < 1e-9);
    }
  });
}

TEST_CASE("the quaternion is a unit one with w >= 0 and turns the same way") {
  for_random_angles([](const Vector3d& rpy) {
    const Eigen::Vector4d wxyz = mcplan::quat_wxyz_from_rpy(rpy);
    CHECK(wxyz[0] >= 0.0);
    CHECK(wxyz.norm() == doctest::Approx(1.0).epsilon(1e-14));
    CHECK(Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).toRotationMatrix().isApprox(by_eigen(rpy), 1e-13));
  });
}
