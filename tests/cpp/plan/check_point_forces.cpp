#include <doctest/doctest.h>

#include <functional>
#include <set>

#include "mcplan/base/error.hpp"
#include "mcplan/plan/checker.hpp"
#include "plan/name_sets.hpp"
#include "plan/point_fixtures.hpp"

namespace {

using namespace fixtures;
using mcplan::CheckResult;
using mcplan::Plan;

using Names = std::set<std::string>;

CheckResult check(const Plan& plan) { return mcplan::check(plan, plan.scene, plan.robot); }

/// What a change violates when the knots follow the changed forces (`replay`) or stay as they are.
Names broken(const std::function<void(Plan&)>& mutate, bool replay = true) {
  Plan plan = step_on_corners();
  mutate(plan);
  if (replay) replay_knots(plan);
  const CheckResult result = check(plan);
  CHECK_FALSE(result.ok());
  Names out;
  for (const auto& violation : result.violations()) out.insert(violation.name);
  return out;
}

double value(const CheckResult& result, const std::string& name) {
  for (const auto& violation : result.constraints)
    if (violation.name == name) return violation.value;
  throw std::out_of_range(name);
}

/// A x <= b with rows +-x, +-y, +-z.
mcplan::Polytope box(const Vector3d& low, const Vector3d& high) {
  mcplan::Polytope out;
  out.A.resize(6, 3);
  out.A << Eigen::Matrix3d::Identity(), -Eigen::Matrix3d::Identity();
  out.b.resize(6);
  out.b << high, -low;
  return out;
}

}  // namespace

TEST_CASE("checker accepts a step with forces at the corners of the feet") {
  const CheckResult result = check(step_on_corners());
  INFO(result.to_string());
  CHECK(result.ok());
  CHECK(result.constraints.size() == 30);
  CHECK(value(result, "dynamics") < 1e-12);
  CHECK(value(result, "at_consistency") < 1e-12);
  CHECK(value(result, "anchor") < 1e-12);
  CHECK(value(result, "pull") < -40.0);
}

TEST_CASE("checker replays forces at points without error, however far between samples") {
  const Plan plan = step_on_corners();
  mcplan::Tolerances tolerances;
  tolerances.sample_s = 0.3;
  const CheckResult result = mcplan::check(plan, plan.scene, plan.robot, tolerances);
  CHECK(value(result, "dynamics") < 1e-12);
}

TEST_CASE("checker rejects a force at a point that the knots do not follow") {
  CHECK(broken([](Plan& p) { p.phases[1].contacts[right_foot].point_forces_W[9].y() += 1e-3; }, false) ==
        Names{"dynamics"});
  CHECK(broken([](Plan& p) { p.knots[2].com_W.x() += 1e-7; }, false) == Names{"dynamics"});
  CHECK(broken([](Plan& p) { p.knots[2].angular_momentum_W.x() += 1e-7; }, false) == Names{"dynamics"});
  CHECK(broken(
            [](Plan& p) {
              p.phases[0].law = mcplan::laws::Held();
              p.phases[0].intervals = 5;
            },
            false) == Names{"dynamics"});
}

TEST_CASE("checker rejects a force at a point beside the sole, or above it") {
  CHECK(broken([](Plan& p) { p.phases[0].contacts[left_foot].points_W[0].x() += 0.002; }) == Names{"anchor"});
  CHECK(broken([](Plan& p) { p.phases[0].contacts[left_foot].points_W[0].z() += 0.002; }) == Names{"anchor"});
}

TEST_CASE("checker turns the sole with the slope and the heading") {
  Plan plan = step_on_corners();
  plan.scene.surfaces[ground].vertices_W = {{-1, -1, -0.1}, {2, -1, -0.1}, {2, 1, 0.1}, {-1, 1, 0.1}};
  const Vector3d normal = Vector3d(0, -0.1, 1).normalized();
  for (auto& knot : plan.knots)
    for (int foot : {left_foot, right_foot}) {
      Vector3d& p = knot.end_effectors_W[foot];
      p.z() = 0.1 * p.y();
    }
  for (auto& phase : plan.phases)
    for (int foot : {left_foot, right_foot})
      if (phase.contacts[foot].surface >= 0) {
        const int k = static_cast<int>(&phase - plan.phases.data());
        phase.contacts[foot].points_W =
            corners(plan.robot.end_effectors[foot], plan.knots[k].end_effectors_W[foot], normal);
      }
  CHECK(value(check(plan), "anchor") < 1e-12);
  for (auto& knot : plan.knots) knot.base_rpy.z() += 0.1;
  CHECK(value(check(plan), "anchor") > 0.001);
}

TEST_CASE("checker rejects a single corner that pulls, slides or carries too much, whatever the others do") {
  const auto corner = [](Plan& p, double x, double z) {
    auto& forces = p.phases[0].contacts[left_foot].point_forces_W;
    forces[4] = {x, 0.0, z};
  };
  CHECK(broken([](Plan& p) {
          for (int j = 0; j <= 4; ++j) p.phases[0].contacts[left_foot].point_forces_W[4 * j] = {0.0, 0.0, -1.0};
        }) == Names{"pull"});
  CHECK(broken([&](Plan& p) { corner(p, 40.0, 50.0); }) == Names{"friction"});
  CHECK(broken([&](Plan& p) { corner(p, 0.5, 0.1); }) == Names{"friction"});
  CHECK(broken([](Plan& p) { p.robot.end_effectors[right_foot].max_force = 300.0; }) == Names{"force_cap"});
  Plan light = step_on_corners();  // a corner that hardly touches may lean on rounding
  corner(light, 2e-4, 1e-4);
  replay_knots(light);
  CHECK(check(light).ok());
}

TEST_CASE("checker looks at a held force that lasts one interval") {
  CHECK(broken([](Plan& p) { p.phases[2].contacts[left_foot].point_forces_W[8] = {0, 0, -1}; }) == Names{"pull"});
}

TEST_CASE("checker rejects points of a free end-effector, and a pendulum's force beside forces at points") {
  CHECK(broken([](Plan& p) {
          auto& hand = p.phases[0].contacts[left_hand];
          hand.points_W = {{0, 0.3, 0.7}};
          hand.point_forces_W.assign(5, Vector3d::Zero());
        }) == Names{"free_force"});
  CHECK(broken([](Plan& p) { p.phases[0].contacts[left_foot].stiffness = 1e-9; }) == Names{"free_force"});
  CHECK(broken([](Plan& p) { p.phases[0].contacts[left_foot].moment_W.z() = 1e-9; }) == Names{"free_force"});
}

TEST_CASE("checker asks for the goal where the end is not open") {
  CHECK(broken([](Plan& p) { p.open_end = false; }) == Names{"goal"});
}

TEST_CASE("checker rejects a number that is not finite in forces at points") {
  CHECK(broken([](Plan& p) { p.phases[0].contacts[0].point_forces_W[3].x() = NAN; }, false) == Names{"finite"});
  CHECK(broken([](Plan& p) { p.phases[0].contacts[0].points_W[3].x() = INFINITY; }, false) == Names{"finite"});
  CHECK(broken([](Plan& p) { p.knots[1].angular_momentum_W.x() = NAN; }, false) == Names{"finite"});
}

TEST_CASE("a reach polytope takes the place of the box in contact, and of nothing else") {
  // The right foot stands 0.1 m right of the CoM, in a box without room.
  const auto limits = [](double room) {
    return [=](Plan& p) {
      auto& foot = p.robot.end_effectors[right_foot];
      foot.reach_min_B.y() = -0.1 - 1e-6;
      foot.reach_max_B.y() = -0.1 + 1e-6;
      if (room > 0.0) foot.com_reach = box({-0.3, 0.1 - room, 0.5}, {0.3, 0.1 + room, 0.8});
    };
  };
  Plan plan = step_on_corners();
  limits(0.1)(plan);
  CHECK(check(plan).ok());
  CHECK(broken(limits(1e-6)) == Names{"reach"});
  CHECK(broken(limits(0.0)) == Names{"reach"});
}

TEST_CASE("reach polytopes turn with the heading, not with roll and pitch") {
  Plan plan = step_on_corners();
  for (auto& knot : plan.knots) knot.base_rpy = {0.5, 0.5, 0.0};
  auto& foot = plan.robot.end_effectors[right_foot];
  foot.com_reach = box({-0.2, 0.05, 0.6}, {0.2, 0.2, 0.75});
  CHECK(value(check(plan), "reach") > 0.1);  // the hands and the left foot, in their boxes
  for (auto& end : plan.robot.end_effectors) end.com_reach = box({-1, -1, -1}, {1, 1, 1});
  foot.com_reach = box({-0.2, 0.05, 0.6}, {0.2, 0.2, 0.75});
  for (int l : {left_foot, left_hand, right_hand}) {
    plan.robot.end_effectors[l].reach_min_B.setConstant(-1);
    plan.robot.end_effectors[l].reach_max_B.setConstant(1);
  }
  CHECK(value(check(plan), "reach") < 0.0);
  for (auto& knot : plan.knots) knot.base_rpy = {0.0, 0.0, M_PI / 2};
  CHECK(value(check(plan), "reach") == doctest::Approx(0.05).epsilon(0.1));  // 0.1 m left has become 0.1 m behind
}

TEST_CASE("feet that stand too far apart break the partner's polytope while both stand") {
  const auto forward = [](double most) {
    return [=](Plan& p) {
      p.robot.end_effectors[right_foot].partner_reach["left_foot"] = box({-0.3, 0.1, -0.1}, {most, 0.4, 0.1});
    };
  };
  Plan plan = step_on_corners();
  forward(0.11)(plan);
  CHECK(check(plan).ok());
  CHECK(broken(forward(0.08)) == Names{"reach"});
}

TEST_CASE("a swinging foot whose polytope admits its footholds may go from one to the other") {
  // It lands 0.1 m ahead of the CoM, outside the box.
  Plan plan = step_on_corners();
  auto& foot = plan.robot.end_effectors[left_foot];
  foot.reach_max_B.x() = 0.05;
  CHECK(value(check(plan), "reach") > 0.02);
  foot.com_reach = box({-0.3, -0.3, 0.5}, {0.3, 0.3, 0.8});
  CHECK(check(plan).ok());
}

TEST_CASE("checker throws on points and forces that do not fit together") {
  const auto throws = [](const std::function<void(Plan&)>& mutate) {
    Plan plan = step_on_corners();
    mutate(plan);
    CHECK_THROWS_AS(check(plan), mcplan::InvalidPlan);
  };
  throws([](Plan& p) { p.phases[0].intervals = 0; });
  throws([](Plan& p) { p.phases[0].intervals = -1; });
  throws([](Plan& p) { p.phases[0].intervals = 6; });
  throws([](Plan& p) { p.phases[0].law = mcplan::laws::Pendulum(); });
  throws([](Plan& p) { p.phases[0].contacts[0].points_W.pop_back(); });
  throws([](Plan& p) { p.phases[0].contacts[0].point_forces_W.pop_back(); });
}
