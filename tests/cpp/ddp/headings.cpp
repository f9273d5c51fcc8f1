#include "ddp/headings.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "ddp/problem.hpp"
#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;
using Eigen::Vector2d;

constexpr double kQuarter = 0.5 * M_PI;

}  // namespace

TEST_CASE("headings go evenly from the start's to the goal's, or by way of where the walk leads") {
  const Course plain, facing{{}, true};
  const Headings even(plain, 0.0, 1.0, Vector2d(0, 3)), turned(facing, 0.0, 1.0, Vector2d(0, 3));
  for (int i = 0; i <= 20; ++i) CHECK(even.at(i / 20.0) == doctest::Approx(i / 20.0));
  CHECK(turned.at(0.0) == doctest::Approx(0.0));
  CHECK(turned.at(1.0) == doctest::Approx(1.0));
  for (double share : {0.25, 0.5, 0.75}) CHECK(turned.at(share) == doctest::Approx(kQuarter));
  CHECK(turned.turn_to_way() == doctest::Approx(kQuarter));
  for (double share : {0.05, 0.1, 0.5, 0.9})
    CHECK(turned.rate(share) ==
          doctest::Approx((turned.at(share + 1e-5) - turned.at(share - 1e-5)) / 2e-5).epsilon(1e-3));
}

TEST_CASE("a heading is counted so that the base turns least") {
  CHECK(turning_least(3.0, -3.0) == doctest::Approx(2.0 * M_PI - 3.0));
  CHECK(turning_least(-3.0, 3.0) == doctest::Approx(3.0 - 2.0 * M_PI));
  CHECK(turning_least(0.0, 3.0 * kQuarter) == doctest::Approx(-kQuarter));
  for (double as_it_stands : {-M_PI, -1.0, 0.0, 3.0, M_PI}) CHECK(turning_least(0.0, as_it_stands) == as_it_stands);
}

TEST_CASE("the base walks backwards where it would turn farther to walk ahead") {
  const Course facing{{}, true};
  CHECK(Headings(facing, 0.0, 0.0, Vector2d(-2, 0)).turn_to_way() == doctest::Approx(0.0));
  // Half a turn is due in any case: it comes first, and the walk leads ahead.
  CHECK(Headings(facing, 0.0, M_PI, Vector2d(-2, 0)).at(0.5) == doctest::Approx(M_PI));
  CHECK(Headings(facing, 0.0, -M_PI, Vector2d(-2, 0)).at(0.5) == doctest::Approx(-M_PI));
  // Yaws beyond half a turn are taken as they stand.
  CHECK(Headings(facing, 2.0 * M_PI, 2.0 * M_PI, Vector2d(0, 2)).at(0.5) == doctest::Approx(2.5 * M_PI));
  CHECK(Headings(facing, 0.3, 0.3, Vector2d(0, 0)).at(0.5) == doctest::Approx(0.3));
}

TEST_CASE("a walk to the side takes fewer phases where the base turns to it, and has its reference ahead of it") {
  mcplan::Scene scene = scenes::flat();
  scene.surfaces = {scenes::rectangle("ground", -2, 2, -2, 5, 0)};
  scene.goal.position_W = {0, 3, 0};
  const Problem aside(scene, scenes::humanoid44(), Options{}),
      ahead(scene, scenes::humanoid44(), Options{}, {{}, true});
  CHECK(ahead.steps < 0.5 * aside.steps);
  const Layout& at = ahead.layout;
  const Eigen::VectorXd& middle = ahead.reference.x[ahead.steps / 2];
  CHECK(ahead.rpy(middle).z() == doctest::Approx(kQuarter));
  for (int l = 0; l < 2; ++l) {
    const Eigen::Vector3d foot = middle.segment<3>(at.end(l)) - middle.segment<3>(at.com());
    CHECK(std::abs(foot.x()) > 5.0 * std::abs(foot.y()));  // beside the way, which goes along y
  }
}

TEST_CASE(
    "half a turn on the spot takes four strides of each foot, and more where the yaw of its joints asks for them") {
  mcplan::Scene scene = scenes::flat(0.0);
  scene.goal.yaw = M_PI;
  mcplan::Robot robot = scenes::humanoid44();
  CHECK(Problem(scene, robot, Options{}).steps == 18);
  for (mcplan::EndEffector& end : robot.end_effectors)
    if (end.kind == "foot") end.yaw_range = {-0.2, 0.2};
  CHECK(Problem(scene, robot, Options{}).steps == 2 * 2 * 8 + 2);
}
