#include "ddp/replan/walk_on.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "mcplan/ddp/plan.hpp"
#include "mcplan/ddp/replan.hpp"
#include "mcplan/robot/robot_files.hpp"
#include "mcplan/scene/scene_files.hpp"
#include "scenes.hpp"

namespace {

using namespace mcplan;
using namespace mcplan::ddp;

struct Ahead {
  explicit Ahead(const VelocityCommand& command, int phases = 12, double t = 1.0) {
    plan = ddp::plan(scenes::flat(), scenes::humanoid44()).plan;
    scene = plan.scene;
    rest = rest_of(plan, t);
    ratio = walk_on(rest, scene, plan.robot, command, phases);
  }
  Plan plan;
  Scene scene;
  Rest rest;
  double ratio = 0.0;
};

}  // namespace

TEST_CASE("a command fills the horizon with steps in turn, and its goal is a stance at rest on ground that is there") {
  for (const int phases : {8, 12, 20}) {
    CAPTURE(phases);
    const Ahead ahead({{0.2, 0.0}, 0.0}, phases);
    CHECK(ahead.ratio == 1.0);
    CHECK(ahead.rest.size() <= phases);
    CHECK(ahead.rest.size() >= phases - 3);
    ahead.scene.validate();
    const ResolvedStance goal = resolve_stance(ahead.scene, ahead.plan.robot, ahead.scene.goal, "goal");
    for (int e : {0, 1}) CHECK(goal.contacts[e] == ahead.rest.plan.final_contacts[e]);
    int last = -1;
    for (int k = 1; k < ahead.rest.size(); ++k)
      for (int e : {0, 1})
        if (ahead.rest.surface(k, e) < 0 && ahead.rest.surface(k - 1, e) >= 0) {
          CHECK(e != last);
          last = e;
        }
    CHECK(ahead.rest.desired.back().com_velocity_W.norm() < 1e-9);
  }
}

TEST_CASE("the way of a command is that of its velocity") {
  const double speed = 0.2;
  const Ahead straight({{speed, 0.0}, 0.0}), turning({{0.0, 0.0}, 0.3}), sideways({{0.0, 0.05}, 0.0});
  const auto times = straight.rest.plan.knot_times();
  const auto& desired = straight.rest.desired;
  const Eigen::Vector3d moved = desired[6].com_W - desired[3].com_W;
  CHECK(moved.head<2>().norm() == doctest::Approx(speed * (times[6] - times[3])).epsilon(1e-9));
  CHECK(std::abs(moved.y()) < 1e-3);  // the soles head where the base went, by a thousandth
  const auto turning_times = turning.rest.plan.knot_times();
  CHECK(turning.rest.desired[6].base_rpy.z() - turning.rest.desired[3].base_rpy.z() ==
        doctest::Approx(0.3 * (turning_times[6] - turning_times[3])).epsilon(1e-9));
  CHECK(sideways.rest.desired[6].com_velocity_W.y() == doctest::Approx(0.05));
}

TEST_CASE("a command is slowed down to strides that the legs reach, and by the ground's end") {
  const Ahead fast({{2.0, 0.0}, 0.0});
  CHECK(fast.ratio < 0.5);
  CHECK(fast.ratio > 0.1);
  Scene small = scenes::flat();
  for (Eigen::Vector3d& v : small.surfaces.front().vertices_W) v.x() = std::min(v.x(), 2.2);
  const Plan plan = ddp::plan(small, scenes::humanoid44()).plan;
  Rest rest = rest_of(plan, plan.duration() - 0.2);
  Scene scene = small;
  CHECK(walk_on(rest, scene, plan.robot, {{0.4, 0.0}, 0.0}, 12) < 1.0);
  CHECK(scene.goal.position_W.x() < 2.2 + 0.15 * 0.7);
}

TEST_CASE("each of four feet has its turn in a horizon of less steps than feet, those of a side one after the other") {
  const Robot robot = load_robot("go2");
  Scene scene = load_scene("flat");
  const Plan plan = ddp::plan(scene, robot).plan;
  Rest rest = rest_of(plan, plan.duration() - 0.01);
  std::vector<int> steps;
  while (steps.size() < 12) {
    REQUIRE(walk_on(rest, scene, robot, {{0.05, 0.0}, 0.0}, 6) == 1.0);
    const auto swings = [&rest](int k) {
      for (int e = 0; e < 4; ++e)
        if (rest.surface(k, e) == kFree) return e;
      return -1;
    };
    int k = 0;
    while (k < rest.size() && swings(k) < 0) ++k;
    REQUIRE(k < rest.size());
    steps.push_back(swings(k));
    rest.drop(k + 1);
  }
  const auto is_left = [&](int e) { return robot.end_effectors[e].nominal_B.y() > 0.0; };
  for (std::size_t i = 4; i < steps.size(); ++i) {
    CHECK(steps[i] == steps[i - 4]);
    for (std::size_t j = i - 3; j < i; ++j) CHECK(steps[i] != steps[j]);
    const bool rear = robot.end_effectors[steps[i]].nominal_B.x() < 0.0;
    if (rear && i + 1 < steps.size()) CHECK(is_left(steps[i + 1]) == is_left(steps[i]));
  }
}

TEST_CASE("a command that is too fast for legs is followed at a lower velocity, not at none") {
  Scene scene = load_scene("flat");
  for (const char* name : {"go2", "humanoid44"}) {
    CAPTURE(name);
    const Robot robot = load_robot(name);
    const Plan plan = ddp::plan(scene, robot).plan;
    ReplanOptions options;
    const Measured measured{rest_of(plan, 0.3).plan.knots.front(), {}};
    double slow = 0.0;
    for (const double speed : {0.5, 2.0}) {
      options.command = VelocityCommand{{speed, 0.0}, 0.0};
      const PlanResult found = replan(plan, 0.3, measured, options);
      const double went = found.plan.knots.back().com_W.x() - measured.state.com_W.x();
      CHECK(found.report.status == Status::solved);
      CHECK(went > 0.05);
      if (slow > 0.0) CHECK(went == doctest::Approx(slow).epsilon(0.05));
      slow = went;
    }
  }
}

TEST_CASE("a stride that is aslant is as long as the ellipsoid in the reach box allows") {
  const Ahead ahead({{2.0, 0.0}, 0.0}), aside({{0.0, 2.0}, 0.0}), both({{2.0, 2.0}, 0.0});
  const double x = 1.0 / ahead.ratio, y = 1.0 / aside.ratio;
  CHECK(both.ratio == doctest::Approx(1.0 / std::sqrt(x * x + y * y)));
  const Ahead turning({{2.0, 0.0}, 0.5});
  CHECK(turning.ratio < ahead.ratio);
}

TEST_CASE("a robot on points goes on in its heading, however its base sways, and turns at the command's rate") {
  const Robot robot = load_robot("go2");
  const Scene flat = load_scene("flat");
  const Plan plan = ddp::plan(flat, robot).plan;
  const auto goal_yaw = [&](double base_yaw, double yaw_rate) {
    Rest rest = rest_of(plan, plan.duration() - 0.01);
    rest.plan.knots.front().base_rpy.z() = base_yaw;
    Scene scene = flat;
    CHECK(walk_on(rest, scene, robot, {{0.05, 0.0}, yaw_rate}, 6) == 1.0);
    return scene.goal.yaw;
  };
  CHECK(goal_yaw(0.2, 0.0) == doctest::Approx(0.0));
  CHECK(goal_yaw(-1.2, 0.0) == doctest::Approx(-1.2));  // it was turned
  const double turned = goal_yaw(0.2, 0.15);
  CHECK(turned > 0.2 + 0.15 * 0.5);
  CHECK(turned < 0.2 + 0.15 * 2.0);
}
