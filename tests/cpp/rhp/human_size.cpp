#include "rhp/human_size.hpp"

#include <doctest/doctest.h>

#include "mcplan/base/error.hpp"
#include "rhp/walkers.hpp"

namespace mcplan::rhp::tests {
namespace {

const Similarity kLarger{16.0, 4.0, 4096.0};

HumanSize size_of(const Similarity& by, Options options = walkers::quick()) {
  return {mcplan::scaled(walkers::uneven(), by), mcplan::scaled(walkers::robot(), by), options};
}

}  // namespace

TEST_CASE("a robot of human size is taken as it is") {
  const HumanSize size = size_of({});
  const Walker walker = size.walker(), direct(walkers::uneven(), walkers::robot(), walkers::quick());
  CHECK(size.own().length == 1.0);
  CHECK(walker.goal_com_W == direct.goal_com_W);
  CHECK(walker.feet[0].com_reach_W.b == direct.feet[0].com_reach_W.b);
  CHECK(walker.start().com_W == direct.start().com_W);
}

TEST_CASE("a larger robot has the program of one of human size") {
  const Walker small = size_of({}).walker(), large = size_of(kLarger).walker();
  CHECK(large.goal_com_W == small.goal_com_W);
  CHECK(large.robot.mass == small.robot.mass);
  CHECK(large.scene.gravity == small.scene.gravity);
  CHECK(large.com_height_m.min == small.com_height_m.min);
  for (int foot : {0, 1}) {
    CHECK(large.feet[foot].max_force == small.feet[foot].max_force);
    CHECK(large.feet[foot].com_reach_W.b == small.feet[foot].com_reach_W.b);
    CHECK(large.feet[foot].partner_reach_W.b == small.feet[foot].partner_reach_W.b);
  }
  CHECK(large.start().com_W == small.start().com_W);
}

TEST_CASE("options at their default go with the size, others are meant as they stand") {
  Options options = walkers::quick();
  options.single_support_s = {2.0, 6.0};
  options.foothold_margin_m = 0.32;
  options.landing_s = 0.4;
  const Walker large = size_of(kLarger, options).walker();
  CHECK(large.options.single_support_s.max == 1.5);
  CHECK(large.options.foothold_margin_m == 0.02);
  CHECK(large.options.landing_s == 0.1);
  CHECK(large.options.double_support_s.max == Options().double_support_s.max);
  CHECK(large.options.momentum_max == Options().momentum_max);
}

TEST_CASE("states go there and back") {
  const HumanSize size = size_of(kLarger);
  State state = size.walker().start();
  state.com_velocity_W = {0.1, 0.2, 0.3};
  state.angular_momentum_W = {1.0, -2.0, 3.0};
  const State own = size.to_own(state), back = size.to_human(own);
  CHECK(own.com_W == 16.0 * state.com_W);
  CHECK(own.com_velocity_W == 4.0 * state.com_velocity_W);
  CHECK(back.angular_momentum_W == state.angular_momentum_W);
  CHECK(back.feet_W == state.feet_W);
  CHECK(back.surfaces == state.surfaces);
}

TEST_CASE("the paper's boxes are absolute") {
  Options options = walkers::quick();
  options.paper = true;
  CHECK(size_of(kLarger, options).own().length == 1.0);
}

TEST_CASE("bad input is told in its own numbers") {
  Robot robot = mcplan::scaled(walkers::robot(), kLarger);
  robot.end_effectors[0].max_force = -1.0;
  CHECK_THROWS_WITH_AS(HumanSize(walkers::uneven(), robot, walkers::quick()),
                       doctest::Contains("must be a positive number, got -1"), InvalidRobot);
}

}  // namespace mcplan::rhp::tests
