#include "ddp/virtual_leg.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "ddp/support.hpp"

namespace {

using namespace support;
using ddp::VirtualLeg;
using Eigen::Vector3d;

/// Hip above an ankle, far enough from the ends of what the links reach.
struct Case {
  explicit Case(Random& random)
      : links{uniform(random, 0.3, 0.5), uniform(random, 0.3, 0.5), random() % 2 ? 1.0 : -1.0},
        u(uniform(random, -0.2, 0.2), uniform(random, -0.2, 0.2), uniform(random, 0.35, 0.5)),
        heading(Vector3d(1.0, uniform(random, -0.5, 0.5), uniform(random, -0.3, 0.3)).normalized()) {}
  VirtualLeg::Links links;
  Vector3d u, heading;
};

}  // namespace

TEST_CASE("a virtual leg: the knee has the links' distances from hip and ankle and bends where the sole heads") {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Case c(random);
    const VirtualLeg leg(c.links, c.u, c.heading, 0.0);
    CHECK(leg.length() == doctest::Approx(c.u.norm()));
    CHECK(leg.from_ankle().norm() == doctest::Approx(c.links.lower));
    CHECK((c.u - leg.from_ankle()).norm() == doctest::Approx(c.links.upper));
    CHECK(std::abs(leg.axis().dot(c.u)) < 1e-12);
    CHECK(std::abs(leg.axis().dot(c.heading)) < 1e-12);
    CHECK(std::abs(leg.axis().dot(leg.from_ankle())) < 1e-12);
    CHECK(c.links.bend * leg.from_ankle().dot(c.heading - c.heading.dot(leg.direction()) * leg.direction()) > 0.0);
    CHECK((leg.from_ankle() - leg.from_ankle().dot(leg.direction()) * leg.direction()).norm() ==
          doctest::Approx(leg.lever()));
  }
}

TEST_CASE("a virtual leg: a turn of the knee lengthens the leg by its lever") {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Case c(random);
    const VirtualLeg leg(c.links, c.u, c.heading, 0.0);
    const double a = c.links.upper, b = c.links.lower, d = leg.length();
    const auto knee_angle = [&](double length) { return std::acos((a * a + b * b - length * length) / (2 * a * b)); };
    const double slope = (knee_angle(d + 1e-6) - knee_angle(d - 1e-6)) / 2e-6;
    CHECK(slope * leg.lever() == doctest::Approx(1.0).epsilon(1e-6));
  }
}

TEST_CASE("a virtual leg: a margin shortens it for its lever, and a stretched leg keeps the least lever") {
  const VirtualLeg::Links links{0.4, 0.3};
  const Vector3d u(0.0, 0.0, 0.55), ahead = Vector3d::UnitX();
  CHECK(VirtualLeg(links, u, ahead, -0.05).lever() ==
        doctest::Approx(VirtualLeg(links, 0.5 / 0.55 * u, ahead, 0).lever()));
  for (double length : {0.699, 0.7, 0.9}) {
    const VirtualLeg leg(links, length * Vector3d::UnitZ(), ahead, 0.0);
    CHECK(leg.lever() == VirtualLeg::min_lever(links));
    CHECK(leg.from_ankle().allFinite());
  }
  const double longest = VirtualLeg::max_length(links);
  CHECK(VirtualLeg(links, longest * Vector3d::UnitZ(), ahead, 0.0).lever() ==
        doctest::Approx(VirtualLeg::min_lever(links)).epsilon(1e-6));
}

TEST_CASE("a virtual leg: derivatives against differences") {
  Random random(3);
  for (int i = 0; i < 40; ++i) {
    const Case c(random);
    const double longer = uniform(random, -0.03, 0.03);
    VirtualLeg leg(c.links, c.u, c.heading, longer);
    leg.differentiate();
    const auto check = [&](const MatrixXd& derivative, const std::function<VectorXd(const VirtualLeg&)>& of,
                           bool by_u) {
      const MatrixXd expected = differences(
          [&](const VectorXd& at) {
            // Headings of any length: derivatives are those of u x heading, made of unit length.
            return of(by_u ? VirtualLeg(c.links, at, c.heading, longer) : VirtualLeg(c.links, c.u, at, longer));
          },
          by_u ? VectorXd(c.u) : VectorXd(c.heading), 1e-4);
      CHECK((derivative - expected).cwiseAbs().maxCoeff() < 1e-7);
    };
    const auto axis = [](const VirtualLeg& l) { return VectorXd(l.axis()); };
    const auto knee = [](const VirtualLeg& l) { return VectorXd(l.from_ankle()); };
    check(leg.axis_by_u(), axis, true);
    check(leg.axis_by_heading(), axis, false);
    check(leg.knee_by_u(), knee, true);
    check(leg.knee_by_heading(), knee, false);
    check(
        leg.direction_by_u(), [](const VirtualLeg& l) { return VectorXd(l.direction()); }, true);
    const MatrixXd lever = differences(
        [&](const VectorXd& at) {
          return VectorXd::Constant(1, VirtualLeg(c.links, at[0] * leg.direction(), c.heading, longer).lever());
        },
        VectorXd::Constant(1, leg.length()), 1e-4);
    CHECK(leg.lever_by_length() == doctest::Approx(lever(0, 0)).epsilon(1e-7));
  }
}
