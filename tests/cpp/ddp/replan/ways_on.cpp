#include "ddp/replan/ways_on.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "ddp/replan/footsteps.hpp"
#include "mcplan/ddp/plan.hpp"
#include "mcplan/ddp/replan.hpp"
#include "mcplan/mcplan.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/scene/polygon.hpp"
#include "scenes.hpp"

namespace {

using namespace mcplan;
using namespace mcplan::ddp;
using Eigen::Vector3d;

Scene without(Scene scene, const std::string& name) {
  scene.surfaces[scene.surface_index(name)].end_effectors = {"nobody"};
  return scene;
}

/// From the scene's start to its goal.
Walk over(const Scene& scene, const Robot& robot) {
  const ResolvedStance start = resolve_stance(scene, robot, scene.start, "start");
  const ResolvedStance goal = resolve_stance(scene, robot, scene.goal, "goal");
  Walk walk;
  int i = 0;
  for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e) {
    if (!is_foot(robot, e)) continue;
    walk.feet[i] = e;
    walk.from[i] = {start.contacts[e], start.end_effectors_W[e], start.yaw};
    walk.to[i++] = {goal.contacts[e], goal.end_effectors_W[e], goal.yaw};
  }
  return walk;
}

/// Whether some place of a CoM that looks ahead has both feet in their boxes, on the level.
bool within_reach_of_a_body(const Robot& robot, const Walk& walk, const std::array<Foothold, 2>& feet) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(-1e9), high = -low;
  for (int i = 0; i < 2; ++i) {
    const EndEffector& end = robot.end_effectors[walk.feet[i]];
    low = low.cwiseMax((feet[i].place_W - end.reach_max_B).head<2>());
    high = high.cwiseMin((feet[i].place_W - end.reach_min_B).head<2>());
  }
  return (high - low).minCoeff() >= 0.0;
}

/// A plan that leads nowhere, from where a walk has both feet on the ground after a time: of a step on the spot at
/// most.
Plan stand_after(const Plan& walk, double t) {
  const std::vector<double> times = walk.knot_times();
  std::size_t k = 0;
  const auto all_stand = [&](const Phase& phase) {
    return std::all_of(phase.contacts.begin(), phase.contacts.begin() + 2,
                       [](const Contact& c) { return c.surface != kFree; });
  };
  while (times[k] < t || !all_stand(walk.phases[k])) ++k;
  Measured measured;
  measured.state = walk.knots[k];
  measured.state.com_velocity_W.setZero();
  measured.state.base_rpy_rate.setZero();
  measured.state.angular_momentum_W.setZero();
  measured.state.com_W.head<2>() =
      0.5 * (measured.state.end_effectors_W[0] + measured.state.end_effectors_W[1]).head<2>();
  for (const Contact& contact : walk.phases[k].contacts) measured.contacts.push_back(contact.surface);
  ReplanOptions options;
  options.command = VelocityCommand{};
  options.horizon = 3;
  PlanResult stand = ddp::replan(walk, times[k] + 1e-3, measured, options);
  INFO(stand.report.message);
  REQUIRE(stand.report.status == Status::solved);
  return std::move(stand.plan);
}

}  // namespace

TEST_CASE("steps lead over stones in turn, on ground that is there, within the reach of a body over them") {
  const Scene stones = load_scene("stepping_stones");
  for (const char* name : {"talos", "g1"})
    for (const char* missing : {"right_1", "left_2", "right_3", "left_4", "right_5", "left_6"}) {
      CAPTURE(name);
      CAPTURE(missing);
      const Robot robot = load_robot(name);
      const Scene scene = without(stones, missing);
      Walk walk = over(scene, robot);
      for (int first : {0, 1}) {
        walk.first = first;
        const std::vector<Footstep> steps = footsteps(walk, scene, robot, 0.85);
        REQUIRE(!steps.empty());
        std::array<Foothold, 2> feet = walk.from;
        for (std::size_t n = 0; n < steps.size(); ++n) {
          const std::size_t i = (first + n) % 2;
          CHECK(steps[n].foot == walk.feet[i]);
          const Surface& ground = scene.surfaces[steps[n].onto.surface];
          CHECK(may_touch(ground, robot.end_effectors[steps[n].foot]));
          const Polygon polygon(ground.vertices_W);
          CHECK((polygon.nearest(steps[n].onto.place_W) - steps[n].onto.place_W).norm() < 1e-9);
          feet[i] = steps[n].onto;
          CHECK(within_reach_of_a_body(robot, walk, feet));
        }
        for (int i : {0, 1}) CHECK((feet[i].place_W - walk.to[i].place_W).norm() < 1e-6);
      }
    }
}

TEST_CASE("no steps lead over a gap that is wider than legs reach") {
  Scene scene = load_scene("stepping_stones");
  for (const char* name : {"right_3", "left_3", "right_4", "left_4"}) scene = without(scene, name);
  const Robot robot = load_robot("talos");
  CHECK(footsteps(over(scene, robot), scene, robot, 0.85).empty());
}

TEST_CASE("where the plan under way leads nowhere a replan leads to the goal, and the checker accepts it") {
  const Scene scene = load_scene("stepping_stones");
  for (const char* name : {"humanoid44", "talos"}) {
    CAPTURE(name);
    const Plan walk = ddp::plan(scene, load_robot(name)).plan;
    for (const double t : {3.0, 4.5}) {
      CAPTURE(t);
      const Plan stand = stand_after(walk, t);
      REQUIRE(ends_elsewhere(rest_of(stand, 0.5), scene, stand.robot));
      Measured measured;
      measured.state = rest_of(stand, 0.5).plan.knots.front();
      const PlanResult result = ddp::replan(stand, 0.5, measured, scene, stand.robot);
      INFO(result.report.message);
      REQUIRE(result.report.status == Status::solved);
      CHECK(result.report.plan_from != PlanFrom::stop);
      CHECK(check(result.plan, scene, stand.robot).ok());
      const ResolvedStance goal = resolve_stance(scene, stand.robot, scene.goal, "goal");
      CHECK((result.plan.knots.back().com_W - goal.com_W).head<2>().norm() < 0.05);
      for (int e : {0, 1}) CHECK(result.plan.final_contacts[e] == goal.contacts[e]);
    }
  }
}

TEST_CASE("a replan leads on round a fence that a robot with hands has come to stand before") {
  Scene scene = scenes::flat();
  scene.goal.position_W = {2.0, 0.0, 0.0};
  for (const auto& [name, y0, y1] : {std::tuple("right", -1.5, 0.1), {"left", 0.9, 1.5}}) {
    scene.surfaces.push_back(scenes::rectangle(name, 0.9, 1.0, y0, y1, 0.6));
    scene.surfaces.back().thickness = 0.6;
    scene.surfaces.back().end_effectors = {};  // hands reach its top
  }
  const Robot robot = load_robot("talos");
  Scene here = scene;
  here.start.position_W = here.goal.position_W = {0.62, 0.1, 0.0};
  const Plan stand = ddp::plan(here, robot).plan;
  const double t = 0.5 * stand.duration();
  Measured measured;
  measured.state = rest_of(stand, t).plan.knots.front();
  const PlanResult result = ddp::replan(stand, t, measured, scene, robot);
  INFO(result.report.message);
  REQUIRE(result.report.status == Status::solved);
  CHECK(result.report.plan_from == PlanFrom::other_sequence);
  CHECK(check(result.plan, scene, robot).ok());
  CHECK(!ends_elsewhere(rest_of(result.plan, 0.0), scene, robot));
}
