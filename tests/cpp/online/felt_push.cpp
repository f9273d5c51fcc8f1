#include "mcplan/online/felt_push.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "mcplan/base/error.hpp"

using namespace mcplan;
using namespace mcplan::online;
using Eigen::Vector2d;

namespace {

constexpr double kStep_s = 0.002;
constexpr double kHeight = 0.9, kGravity = 9.81;
const double kOmega = std::sqrt(kGravity / kHeight);

struct Pendulum {
  double position = 0.0, velocity = 0.0;
  double capture() const { return position + velocity / kOmega; }
};

/// After a time under an acceleration, on a center of pressure at 0: c'' = omega^2 c + a, by small steps.
Pendulum after(Pendulum pendulum, double acceleration, double time_s) {
  constexpr int kSteps = 20000;
  const double dt = time_s / kSteps;
  for (int n = 0; n < kSteps; ++n) {  // the midpoint rule
    const double half = pendulum.velocity + 0.5 * dt * (kOmega * kOmega * pendulum.position + acceleration);
    const double middle = pendulum.position + 0.5 * dt * pendulum.velocity;
    pendulum.velocity += dt * (kOmega * kOmega * middle + acceleration);
    pendulum.position += dt * half;
  }
  return pendulum;
}

FeltPush push(double acceleration, double lasted_s) { return {Vector2d(acceleration, 0.0), lasted_s}; }

/// A robot that accelerates by `unknown` more than is promised.
class Robot {
 public:
  explicit Robot(double noise_m_s = 0.0) : noise_m_s_(noise_m_s) {}

  const FeltPush& go_on(PushObserver& observer, const Vector2d& unknown, int steps) {
    for (int n = 0; n < steps; ++n) {
      const Vector2d promised(std::sin(0.02 * count_), std::cos(0.03 * count_));
      ++count_;
      velocity_ += kStep_s * (promised + unknown);
      observer.update(velocity_ + noise_m_s_ * Vector2d(normal_(random_), normal_(random_)), promised, kStep_s);
    }
    return observer.push();
  }

 private:
  double noise_m_s_;
  int count_ = 0;
  Vector2d velocity_ = Vector2d::Zero();
  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
};

}  // namespace

TEST_CASE("a pendulum that leans against a steady push moves as one beside it that is not pushed") {
  const double acceleration = 1.2, beside = com_shift_W(push(acceleration, 100.0), kHeight, kGravity).x();
  const Pendulum pushed = after({0.01, -0.1}, acceleration, 0.5), free = after({0.01 + beside, -0.1}, 0.0, 0.5);
  CHECK(pushed.position + beside == doctest::Approx(free.position).epsilon(1e-6));
  CHECK(pushed.velocity == doctest::Approx(free.velocity).epsilon(1e-6));
}

TEST_CASE("a push that ends moves the capture point by what is planned for") {
  const double acceleration = -2.7, lasts_s = 0.15;
  const double beside = com_shift_W(push(acceleration, lasts_s / kLastsRatio), kHeight, kGravity).x();
  const Pendulum pushed = after({0.02, 0.3}, acceleration, lasts_s), free = after({0.02 + beside, 0.3}, 0.0, lasts_s);
  CHECK(pushed.capture() == doctest::Approx(free.capture()).epsilon(1e-6));
}

TEST_CASE("the shift lies in the direction of the push, on the level, and is none where nothing pushes") {
  CHECK(com_shift_W({}, kHeight, kGravity).norm() == 0.0);
  const Eigen::Vector3d shift_W = com_shift_W({Vector2d(0.3, -0.4), 0.1}, kHeight, kGravity);
  CHECK(shift_W.z() == 0.0);
  CHECK(shift_W.x() / shift_W.y() == doctest::Approx(-0.75));
  CHECK(shift_W.x() > 0.0);
}

TEST_CASE("a push that is none is refused by name") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(com_shift_W(push(nan, 0.1), kHeight, kGravity),
                       "push.acceleration_W[0]: must lie in [-100, 100], got nan", InvalidInput);
  CHECK_THROWS_WITH_AS(com_shift_W(push(1.0, 0.5), 0.0, kGravity), "com_height: must be positive and finite, got 0.0",
                       InvalidInput);
  PushObserver observer;
  for (const double wrong : {0.0, -0.002, nan})
    CHECK_THROWS_AS(observer.update(Vector2d::Zero(), std::nullopt, wrong), InvalidInput);
  CHECK_THROWS_WITH_AS(com_shift_W(push(1.0, -0.5), kHeight, kGravity), "push.lasted_s: must be at least 0, got -0.5",
                       InvalidInput);
}

TEST_CASE("a push is felt, and for how long, and that it is over") {
  PushObserver observer;
  Robot robot;
  CHECK(robot.go_on(observer, Vector2d::Zero(), 100).acceleration_W.norm() == 0.0);
  const FeltPush felt = robot.go_on(observer, Vector2d(0.0, 2.0), 50);
  CHECK(felt.acceleration_W.y() == doctest::Approx(2.0).epsilon(0.01));
  CHECK(std::abs(felt.acceleration_W.x()) < 1e-3);
  CHECK(felt.lasted_s > 0.08);
  CHECK(felt.lasted_s <= 0.1);
  const FeltPush over = robot.go_on(observer, Vector2d::Zero(), 50);
  CHECK(over.acceleration_W.norm() == 0.0);
  CHECK(over.lasted_s == 0.0);
}

TEST_CASE("what pushes to another side is another push") {
  PushObserver observer;
  Robot robot;
  robot.go_on(observer, Vector2d::Zero(), 50);
  robot.go_on(observer, Vector2d(0.0, -2.4), 100);
  CHECK(observer.push().lasted_s > 0.18);
  SUBCASE("aslant") {
    const FeltPush felt = robot.go_on(observer, Vector2d(0.7, 0.0), 25);
    CHECK(felt.acceleration_W.x() == doctest::Approx(0.7).epsilon(0.05));
    CHECK(felt.lasted_s < 0.06);
  }
  SUBCASE("back") { CHECK(robot.go_on(observer, Vector2d(0.0, 1.0), 25).lasted_s < 0.05); }
  SUBCASE("the same, weaker: for no longer than it has been felt") {
    const FeltPush felt = robot.go_on(observer, Vector2d(0.0, -0.5), 25);
    CHECK(felt.lasted_s > 0.23);
    CHECK(felt.lasted_s <= 0.2501);
  }
}

TEST_CASE("what a landing does to the CoM is no push") {
  PushObserver observer;
  Robot robot;
  robot.go_on(observer, Vector2d::Zero(), 100);
  observer.update(Vector2d(0.3, 0.0), std::nullopt, kStep_s);  // contacts are others
  CHECK(robot.go_on(observer, Vector2d(5.0, 0.0), 14).lasted_s == 0.0);
  CHECK(robot.go_on(observer, Vector2d(5.0, 0.0), 10).lasted_s > 0.0);  // it goes on: that is one
}

TEST_CASE("what the noise of the velocity makes of it is seldom taken for a push") {
  for (const double noise_m_s : {0.001, 0.01, 0.03}) {
    CAPTURE(noise_m_s);
    PushObserver observer;
    Robot robot(noise_m_s);
    int felt = 0;
    double most = 0.0;
    for (int n = 0; n < 7000; ++n) {
      const FeltPush& push = robot.go_on(observer, Vector2d::Zero(), 1);
      felt += push.lasted_s > 0.0;
      most = std::max(most, push.acceleration_W.norm());
    }
    CHECK(felt < 140);  // from the first step on
    CHECK(most < 0.3);
    robot.go_on(observer, Vector2d(0.63, 0.0), 150);  // as by 60 N on 95 kg
    double mean = 0.0;
    int pauses = 0;
    for (int n = 0; n < 500; ++n) {
      const double x = robot.go_on(observer, Vector2d(0.63, 0.0), 1).acceleration_W.x();
      mean += x / 500.0;
      pauses += x <= 0.0;
    }
    CHECK(mean == doctest::Approx(0.58).epsilon(0.1));
    CHECK(pauses == 0);
    CHECK(observer.push().lasted_s > 1.0);
  }
}

TEST_CASE("a blow does not make the observer deaf") {
  PushObserver observer;
  Robot robot;
  robot.go_on(observer, Vector2d::Zero(), 200);
  robot.go_on(observer, Vector2d(10.0, 0.0), 50);
  robot.go_on(observer, Vector2d::Zero(), 100);
  CHECK(robot.go_on(observer, Vector2d(0.0, 1.0), 50).acceleration_W.y() == doctest::Approx(1.0).epsilon(0.05));
}

TEST_CASE("a pause in a push does not end it, a long one does") {
  PushObserver observer;
  Robot robot;
  robot.go_on(observer, Vector2d(0.0, 1.0), 250);
  CHECK(robot.go_on(observer, Vector2d::Zero(), 40).acceleration_W.norm() == 0.0);
  CHECK(observer.push().lasted_s == 0.0);
  const double after_s = robot.go_on(observer, Vector2d(0.0, 1.0), 25).lasted_s;
  CHECK(after_s > 0.45);
  robot.go_on(observer, Vector2d::Zero(), 80);
  CHECK(robot.go_on(observer, Vector2d(0.0, 1.0), 25).lasted_s < 0.06);
}

TEST_CASE("a push is held and then fades while contacts are not those of which the model thought, and is bounded") {
  PushObserver observer;
  Robot robot;
  const double brief_m_s2 = robot.go_on(observer, Vector2d(1.0, 0.0), 100).acceleration_W.x();
  for (int n = 0; n < 14; ++n) observer.update(Vector2d(9.0, 0.0), std::nullopt, kStep_s);
  CHECK(observer.push().acceleration_W.x() == brief_m_s2);
  for (int n = 0; n < 20; ++n) observer.update(Vector2d(9.0, 0.0), std::nullopt, kStep_s);
  CHECK(observer.push().acceleration_W.x() < 0.9 * brief_m_s2);  // it had not been felt for long
  robot = Robot();
  const FeltPush felt = robot.go_on(observer, Vector2d(1.0, 0.0), 1000);
  for (int n = 0; n < 130; ++n) observer.update(Vector2d(9.0 * n, 0.0), std::nullopt, kStep_s);
  CHECK(observer.push().acceleration_W == felt.acceleration_W);
  CHECK(observer.push().lasted_s == doctest::Approx(felt.lasted_s + 0.26));
  for (int n = 0; n < 70; ++n) observer.update(Vector2d(9.0 * n, 0.0), std::nullopt, kStep_s);
  const double faded = std::exp(-1.0);  // over 0.1 s, of what is felt of it the more
  CHECK(observer.push().acceleration_W.x() < 1.1 * faded);
  CHECK(observer.push().acceleration_W.x() > 0.6 * faded);
  CHECK(robot.go_on(observer, Vector2d(0.0, 50.0), 500).acceleration_W.norm() <= 3.0);
}

TEST_CASE("what happens while no velocity is measured is no push") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SUBCASE("the model accelerates") {
    PushObserver observer;
    double velocity = 0.0, most = 0.0;
    for (int n = 0; n < 1000; ++n) {
      const double promised = 0.5 * std::sin(0.0125 * n);
      velocity += kStep_s * promised;
      const double told = n > 200 && n < 325 ? nan : velocity;
      most = std::max(most, observer.update(Vector2d(told, 0.0), Vector2d(promised, 0.0), kStep_s).lasted_s);
    }
    CHECK(most == 0.0);
  }
  SUBCASE("a push ends") {
    PushObserver observer;
    Robot robot;
    const FeltPush before = robot.go_on(observer, Vector2d(1.0, 0.0), 500);
    for (int n = 0; n < 80; ++n) observer.update(Vector2d(nan, 0.0), Vector2d::Zero(), kStep_s);
    CHECK(observer.push().acceleration_W == before.acceleration_W);
    for (int n = 0; n < 200; ++n) observer.update(Vector2d(nan, 0.0), Vector2d::Zero(), kStep_s);
    CHECK(observer.push().lasted_s == 0.0);
    CHECK(robot.go_on(observer, Vector2d::Zero(), 100).lasted_s == 0.0);
  }
}

TEST_CASE("a reading that is no number, or is absurd, does not stay") {
  PushObserver observer;
  Robot robot;
  const FeltPush before = robot.go_on(observer, Vector2d(1.0, 0.0), 100);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double wrong : {nan, inf, 1e300, -1e7}) {
    observer.update(Vector2d(wrong, 0.0), Vector2d::Zero(), kStep_s);
  }
  CHECK(observer.push().acceleration_W == before.acceleration_W);
  CHECK(robot.go_on(observer, Vector2d(1.0, 0.0), 100).acceleration_W.x() == doctest::Approx(1.0).epsilon(0.03));
}
