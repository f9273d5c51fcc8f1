#include "ddp/leg_lines.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "ddp/support.hpp"

namespace {

using namespace support;
using ddp::LegLines;
using Eigen::Vector3d;

mcplan::LimbLimits random_leg(Random& random) {
  mcplan::LimbLimits limb;
  limb.upper = uniform(random, 0.3, 0.5);
  limb.lower = uniform(random, 0.3, 0.5);
  limb.bends_backward = random() % 2 == 0;
  limb.beside = uniform(random, -0.1, 0.1);
  return limb;
}

struct Place {
  explicit Place(Random& random)
      : ankle(uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0), uniform(random, 0.0, 0.2)),
        u(uniform(random, -0.2, 0.2), uniform(random, -0.2, 0.2), uniform(random, 0.35, 0.5)),
        heading(Vector3d(1.0, uniform(random, -0.5, 0.5), uniform(random, -0.3, 0.3)).normalized()) {}
  Vector3d ankle, u, heading;
};

}  // namespace

TEST_CASE("lines about a leg: they join hip, knee and the middle of the shank, beside them by a given length") {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    mcplan::LimbLimits limb = random_leg(random);
    const Place at(random);
    const LegLines beside(limb, at.ankle, at.u, at.heading);
    const double by = limb.beside;
    limb.beside = 0.0;
    const LegLines lines(limb, at.ankle, at.u, at.heading);
    const Vector3d hip = lines.from(LegLines::thigh), knee = hip + lines.along(LegLines::thigh);
    CHECK((hip - at.ankle - at.u).norm() < 1e-12);
    CHECK((knee - lines.from(LegLines::shank)).norm() < 1e-12);
    CHECK((knee - hip).norm() == doctest::Approx(limb.upper));
    CHECK((knee - at.ankle).norm() == doctest::Approx(limb.lower));
    CHECK((knee + lines.along(LegLines::shank) - 0.5 * (knee + at.ankle)).norm() < 1e-12);
    for (const auto part : {LegLines::thigh, LegLines::shank}) {
      const Vector3d moved = beside.from(part) - lines.from(part);
      CHECK(moved.norm() == doctest::Approx(std::abs(by)));
      CHECK(std::abs(moved.dot(at.u)) < 1e-12);
      CHECK(moved.dot(Vector3d::UnitZ().cross(at.heading)) * by >= 0.0);  // to the left
      CHECK((beside.along(part) - lines.along(part)).norm() < 1e-12);
    }
  }
}

TEST_CASE("lines about a leg: derivatives") {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const mcplan::LimbLimits limb = random_leg(random);
    const Place at(random);
    const Vector3d n = Vector3d(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)).normalized();
    const double s = uniform(random, 0.0, 1.0);
    LegLines lines(limb, at.ankle, at.u, at.heading);
    for (const auto part : {LegLines::thigh, LegLines::shank}) {
      const auto along_n = [&](const VectorXd& z) {
        const LegLines moved(limb, at.ankle, z.head<3>(), z.tail<3>());
        return VectorXd::Constant(1, n.dot(moved.from(part) + s * moved.along(part)));
      };
      VectorXd z(6);
      z << at.u, at.heading;
      const MatrixXd expected = differences(along_n, z, 1e-4);
      const LegLines::Slopes by = lines.slopes(part, s, n);
      CHECK((by.u - expected.leftCols<3>().transpose()).cwiseAbs().maxCoeff() < 1e-8);
      CHECK((by.heading - expected.rightCols<3>().transpose()).cwiseAbs().maxCoeff() < 1e-8);
    }
  }
}
