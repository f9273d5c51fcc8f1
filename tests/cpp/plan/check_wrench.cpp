#include <doctest/doctest.h>

#include <functional>
#include <set>

#include "mcplan/base/error.hpp"
#include "mcplan/base/rotation.hpp"
#include "mcplan/plan/checker.hpp"
#include "plan/name_sets.hpp"
#include "plan/wrench_fixtures.hpp"

namespace {

using namespace fixtures;
using mcplan::CheckResult;
using mcplan::Plan;

using Names = std::set<std::string>;

CheckResult check(const Plan& plan) { return mcplan::check(plan, plan.scene, plan.robot); }

Names names(const CheckResult& result) {
  Names out;
  for (const auto& violation : result.violations()) out.insert(violation.name);
  return out;
}

/// What a change to the valid walk (or another plan) violates.
Names broken(const std::function<void(Plan&)>& mutate, Plan plan = wrench_walk()) {
  mutate(plan);
  const CheckResult result = check(plan);
  INFO(result.to_string());
  CHECK_FALSE(result.ok());
  return names(result);
}

/// A change to the walk's last phase, whose end follows the changed forces, is not asked to be the goal, and may tilt
/// the base as far as it likes.
Plan with_another_end(const std::function<void(Plan&, mcplan::Phase&)>& mutate) {
  Plan plan = wrench_walk();
  mutate(plan, plan.phases.back());
  plan.open_end = true;
  for (auto& end : plan.robot.end_effectors) {
    end.reach_min_B.setConstant(-2.0);
    end.reach_max_B.setConstant(2.0);
  }
  replay_wrench_knots(plan, static_cast<int>(plan.phases.size()) - 1);
  return plan;
}

Names broken_end(const std::function<void(Plan&, mcplan::Phase&)>& mutate) {
  return broken([](Plan&) {}, with_another_end(mutate));
}

const mcplan::Violation& find(const CheckResult& result, const std::string& name) {
  for (const auto& violation : result.constraints)
    if (violation.name == name) return violation;
  throw std::out_of_range(name);
}

double degrees(double angle) { return angle * M_PI / 180.0; }

}  // namespace

TEST_CASE("checker accepts a walk whose feet turn the base, and replays it to 1e-9") {
  const CheckResult result = check(wrench_walk());
  INFO(result.to_string());
  CHECK(result.ok());
  CHECK(result.constraints.size() == 30);
  CHECK(find(result, "dynamics").value < 1e-11);
  CHECK(find(result, "at_consistency").value < 1e-11);
  CHECK(find(result, "orientation").value < 1e-5);
  CHECK(find(result, "center_of_pressure").value < 1e-12);
  CHECK(find(result, "anchor").phase == -1);   // nothing to look at
  CHECK(find(result, "moment").value == 0.0);  // the rail's hand, which has no moment and may have none
  CHECK(wrench_walk().knots[1].angular_momentum_W.z() == doctest::Approx(0.4 * 2.0).epsilon(1e-2));  // 1.5 + 0.5 N m
}

TEST_CASE("checker accepts vertical forces whose line passes 0.1 m beside the foot") {
  const CheckResult result = check(stand_on_wrenches());
  INFO(result.to_string());
  CHECK(result.ok());
  CHECK(find(result, "dynamics").value < 1e-12);
  CHECK(find(result, "friction").value == doctest::Approx(-0.7));
  CHECK(find(result, "anchor").phase == -1);
  // Of the paper's law the same anchors are wrong.
  CHECK(broken(
            [](Plan& p) {
              for (auto& phase : p.phases) phase.law = mcplan::laws::Pendulum();
            },
            stand_on_wrenches())
            .count("anchor") == 1);
}

TEST_CASE("checker accepts a jump with a turn by 45 degrees in flight, which is L t / I about one axis") {
  const Vector3d inertia(2.0, 2.5, 3.0);
  const Plan plan = spinning_flight({0.0, 0.0, 3.0 * M_PI / 4 / kPhase}, inertia);
  CHECK(plan.knots[1].base_rpy.z() == doctest::Approx(M_PI / 4));
  const CheckResult result = check(plan);
  INFO(result.to_string());
  CHECK(result.ok());
  CHECK(find(result, "orientation").value < 1e-9);
  CHECK(find(result, "dynamics").value < 1e-11);
}

TEST_CASE("checker follows a tumbling body within a degree, and rejects one that one step cannot follow") {
  const Vector3d inertia(1.0, 3.0, 2.0);
  const CheckResult slow = check(spinning_flight({0.6, 0.9, 0.4}, inertia));
  CHECK(find(slow, "orientation").value < degrees(0.01));
  CHECK(find(slow, "orientation").value > 0.0);
  CHECK(find(slow, "dynamics").value < 1e-11);
  const CheckResult fast = check(spinning_flight({6.0, 9.0, 4.0}, inertia));
  CHECK(names(fast).count("orientation") == 1);
  CHECK(names(fast).count("dynamics") == 0);  // the knots are those of a fine integration
}

TEST_CASE("checker rejects a centre of pressure off the sole") {
  CHECK(broken_end([](Plan& p, auto& phase) {
          phase.contacts[left_foot].center_of_pressure_W = p.knots.back().end_effectors_W[left_foot];
          phase.contacts[left_foot].center_of_pressure_W.y() += 0.052;
        }) == Names{"center_of_pressure"});
  CHECK(broken_end([](Plan& p, auto& phase) {
          phase.contacts[left_foot].center_of_pressure_W = p.knots.back().end_effectors_W[left_foot];
          phase.contacts[left_foot].center_of_pressure_W.x() -= 0.102;
        }) == Names{"center_of_pressure"});
}

TEST_CASE("checker turns the sole by its own heading") {
  const auto long_way = [](double yaw) {
    return [yaw](Plan& p, mcplan::Phase& phase) {
      for (auto& knot : p.knots) knot.end_effector_yaw[right_foot] = yaw;
      phase.contacts[right_foot].center_of_pressure_W = p.knots.back().end_effectors_W[right_foot];
      phase.contacts[right_foot].center_of_pressure_W.y() -= 0.09;
    };
  };
  CHECK(broken_end(long_way(0.0)) == Names{"center_of_pressure"});
  CHECK(check(with_another_end(long_way(M_PI / 2))).ok());
}

TEST_CASE("checker rejects a centre of pressure off the surface, under a sole that overhangs") {
  const auto at_the_edge = [](double beyond) {
    return [beyond](Plan& p, mcplan::Phase& phase) {
      for (int i : {1, 2}) p.scene.surfaces[ground].vertices_W[i].x() = 0.31;
      phase.contacts[left_foot].center_of_pressure_W = p.knots.back().end_effectors_W[left_foot];
      phase.contacts[left_foot].center_of_pressure_W.x() = 0.31 + beyond;
    };
  };
  CHECK(broken_end(at_the_edge(0.002)) == Names{"center_of_pressure"});
  CHECK(check(with_another_end(at_the_edge(-0.002))).ok());
}

TEST_CASE("checker rejects a centre of pressure off the plane, or off a point contact") {
  CHECK(broken_end([](Plan&, auto& phase) { phase.contacts[left_foot].center_of_pressure_W.z() = 0.002; }) ==
        Names{"center_of_pressure"});
  CHECK(broken([](Plan& p) { p.phases[1].contacts[left_hand].center_of_pressure_W.x() += 0.002; }) ==
        Names{"center_of_pressure"});
}

TEST_CASE("checker rejects an angular momentum that the forces do not give, by a ten-millionth") {
  CHECK(broken([](Plan& p) { p.knots[5].angular_momentum_W.x() += 1e-7; }) == Names{"dynamics"});
  CHECK(broken([](Plan& p) { p.phases[4].contacts[left_foot].center_of_pressure_W.x() += 1e-6; }) == Names{"dynamics"});
  CHECK(broken([](Plan& p) { p.phases[4].contacts[left_foot].anchor_W.z() += 1e-6; }) == Names{"dynamics"});
  CHECK(broken([](Plan& p) { p.phases[4].contacts[left_foot].moment_W.z() += 1e-6; }) == Names{"dynamics"});
}

TEST_CASE("checker rejects rates of the angles that are not those of the momentum") {
  CHECK(broken([](Plan& p) { p.knots[1].base_rpy_rate.y() += 1e-7; }) == Names{"dynamics"});
  CHECK(broken([](Plan& p) { p.knots[12].base_rpy_rate.z() += 1e-7; }) == Names{"dynamics"});
}

TEST_CASE("checker rejects a base two degrees off where its momentum turns it, about any axis") {
  for (int axis : {0, 1, 2}) {
    CAPTURE(axis);
    const auto turn = [axis](double by) {
      return [axis, by](Plan& p) {
        p.knots[5].base_rpy[axis] += by;
        set_base_rate(p.knots[5], p.robot.inertia);
      };
    };
    CHECK(broken(turn(degrees(2.0))) == Names{"orientation"});
    Plan little = wrench_walk();
    turn(degrees(0.9))(little);
    CHECK(check(little).ok());
  }
}

TEST_CASE("checker rejects a moment about the normal beyond the cap, or beyond what friction under the sole gives") {
  const auto torsion = [](double moment) {
    return [moment](Plan&, mcplan::Phase& phase) { phase.contacts[right_foot].moment_W.z() = moment; };
  };
  CHECK(broken_end(torsion(1.01)) == Names{"moment"});
  CHECK(broken_end(torsion(-1.01)) == Names{"moment"});
  // Half of 392 N on 0.05 m with friction 0.7: some 7 N m.
  const auto of_a_strong_ankle = [&](double moment) {
    return [=](Plan& p, mcplan::Phase& phase) {
      p.robot.end_effectors[right_foot].max_moment = {0, 0, 60};
      torsion(moment)(p, phase);
    };
  };
  CHECK(broken_end(of_a_strong_ankle(12.0)) == Names{"moment"});
  CHECK(check(with_another_end(of_a_strong_ankle(3.0))).ok());
}

TEST_CASE("checker rejects a moment along the surface, whatever the joints could give") {
  for (int axis : {0, 1})
    CHECK(broken_end([axis](Plan&, auto& phase) { phase.contacts[right_foot].moment_W[axis] = 1e-5; }) ==
          Names{"moment"});
}

TEST_CASE("checker rejects a sole that turns on its surface") {
  // 0.02 rad on half a diagonal of 0.112 m.
  CHECK(broken([](Plan& p) { p.knots[12].end_effector_yaw[left_foot] = 0.02; }) == Names{"slip"});
  CHECK(find(check([] {
               Plan p = wrench_walk();
               p.knots[12].end_effector_yaw[left_foot] = 0.02;
               return p;
             }()),
             "slip")
            .value == doctest::Approx(0.02 * std::hypot(0.1, 0.05)));
  // Through the air it may turn, and by a whole turn it has not turned.
  Plan plan = wrench_walk();
  for (int k = 10; k <= 12; ++k) plan.knots[k].end_effector_yaw[left_foot] = 0.2;
  CHECK(check(plan).ok());
  // Without headings of their own the soles turn with the base.
  CHECK(broken([](Plan& p) {
          for (auto& knot : p.knots) knot.end_effector_yaw.clear();
        }) == Names{"slip"});
}

TEST_CASE("checker rejects a sole in contact that is turned against the base beyond its range, and no free one") {
  const auto turned = [](double yaw, double right, double left) {
    return [=](Plan& p) {
      for (int k = 10; k <= 12; ++k) p.knots[k].end_effector_yaw[left_foot] = yaw;
      p.robot.end_effectors[left_foot].yaw_range = {right, left};
    };
  };
  const auto accepted = [&](double yaw, double right, double left) {
    Plan plan = wrench_walk();
    turned(yaw, right, left)(plan);
    return check(plan).ok();
  };
  CHECK(broken(turned(0.2, -0.5, 0.1)) == Names{"reach"});
  CHECK(broken(turned(-0.2, -0.1, 0.5)) == Names{"reach"});
  CHECK(accepted(0.2, -0.2, 0.3));
  CHECK(accepted(2 * M_PI + 0.2, -0.2, 0.3));
  Plan plan = wrench_walk();
  turned(0.3, -0.2, 0.1)(plan);
  const auto worst = find(check(plan), "reach");
  CHECK(worst.unit == "rad");
  CHECK(worst.end_effector == "left_foot");
  CHECK(worst.phase >= 10);
}

TEST_CASE("a walk is accepted wherever in the world it is") {
  Plan plan = wrench_walk();
  const Eigen::Vector3d away(4000.0, -3000.0, 0.0);
  for (auto& surface : plan.scene.surfaces)
    for (Eigen::Vector3d& corner : surface.vertices_W) corner += away;
  plan.scene.start.position_W += away;
  plan.scene.goal.position_W += away;
  for (auto& knot : plan.knots) {
    knot.com_W += away;
    for (Eigen::Vector3d& position : knot.end_effectors_W) position += away;
  }
  for (auto& phase : plan.phases)
    for (auto& contact : phase.contacts) {
      contact.anchor_W += away;
      contact.center_of_pressure_W += away;
    }
  INFO(check(plan).to_string());
  CHECK(check(plan).ok());
}

TEST_CASE("a heading on its limit lends its tolerance to no reach that is measured after it") {
  Plan plan = wrench_walk();
  double first = 0.0, farthest = -1.0, turned = 0.0;
  for (int i = 0; i <= 4000; ++i) {
    const mcplan::PlanState at = plan.at(plan.duration() * i / 4000);
    const Eigen::Vector3d relative =
        mcplan::rotation_from_rpy(at.base_rpy).transpose() * (at.end_effectors[right_foot].position_W - at.com_W);
    if (i == 0) first = relative.x();
    farthest = std::max(farthest, relative.x());
    turned = std::max(turned, std::abs(at.end_effectors[left_foot].yaw - at.base_rpy.z()));
  }
  REQUIRE(first < farthest - 0.01);
  plan.robot.end_effectors[left_foot].yaw_range = {-turned, turned};  // on its limit, which it may be
  plan.robot.end_effectors[right_foot].reach_max_B.x() = farthest - 0.005;
  const CheckResult result = check(plan);
  CHECK_FALSE(result.ok());
  const auto worst = find(result, "reach");
  CHECK(worst.end_effector == "right_foot");
  CHECK(worst.unit == "m");
  CHECK(worst.tolerance == mcplan::Tolerances().reach);
  CHECK(worst.value == doctest::Approx(0.005).epsilon(1e-2));
}

TEST_CASE("checker holds forces of contact wrenches to cone, cap and sign") {
  CHECK(broken([](Plan& p) { p.scene.surfaces[ground].friction = 0.15; }) == Names{"friction"});
  CHECK(broken([](Plan& p) { p.robot.end_effectors[right_foot].max_force = 390.0; }) == Names{"force_cap"});
  Plan rails = stand_at_rails(0.8, 2.0);
  give_wrenches(rails);
  CHECK(check(rails).ok());
  CHECK(broken([](Plan& p) { p.scene.surfaces[1].grasp = false; }, rails) == Names{"pull"});
  CHECK(broken([](Plan& p) { p.phases[3].contacts[left_foot].stiffness = 1e-14; }) == Names{"free_force"});
  CHECK(broken([](Plan& p) { p.phases[3].contacts[left_foot].moment_W.x() = 1e-14; }) == Names{"free_force"});
}

TEST_CASE("checker holds a hand that grasps to its largest moment alone") {
  Plan rails = stand_at_rails(0.8, 2.0);
  give_wrenches(rails);
  const auto twist = [](double moment) {
    return [moment](Plan& p) {
      for (int hand : {left_hand, right_hand}) {
        p.robot.end_effectors[hand].half_size = {0.001, 0.001};
        p.robot.end_effectors[hand].max_moment = {0, 0, 2.0};
        for (auto& phase : p.phases) phase.contacts[hand].moment_W.z() = hand == left_hand ? moment : -moment;
      }
    };
  };
  CHECK(broken(twist(2.1), rails) == Names{"moment"});
  twist(1.9)(rails);
  CHECK(check(rails).ok());
}

TEST_CASE("checker lets a swinging sole turn by its own heading past an obstacle") {
  // A kerb beside the path, 0.19 m to the left: a foot that swings across its heading reaches 0.2 m.
  const auto kerb = [](double yaw) {
    Plan plan = wrench_walk();
    plan.scene.surfaces.push_back(rectangle("kerb", -0.5, 1, 0.19, 0.22, 0.2));
    plan.scene.surfaces.back().thickness = 0.19;
    for (auto& knot : plan.knots) knot.end_effector_yaw[left_foot] = yaw;
    return names(check(plan)).count("clearance");
  };
  CHECK(kerb(0.0) == 0);
  CHECK(kerb(M_PI / 2) == 1);
}

TEST_CASE("checker asks for no momentum at start and goal") {
  CHECK(broken([](Plan& p) { p.knots[12].angular_momentum_W.z() += 0.1; }) == Names{"dynamics", "goal"});
  CHECK(broken([](Plan& p) { p.knots[0].angular_momentum_W.z() += 0.1; }) == Names{"dynamics", "start"});
}

TEST_CASE("checker rejects numbers of contact wrenches that are not finite, and headings that are not one per sole") {
  CHECK(broken([](Plan& p) { p.phases[0].contacts[0].center_of_pressure_W.x() = NAN; }) == Names{"finite"});
  CHECK(broken([](Plan& p) { p.knots[3].end_effector_yaw[2] = INFINITY; }) == Names{"finite"});
  const auto throws = [](const std::function<void(Plan&)>& mutate) {
    Plan plan = wrench_walk();
    mutate(plan);
    CHECK_THROWS_AS(check(plan), mcplan::InvalidPlan);
  };
  throws([](Plan& p) { p.knots[3].end_effector_yaw.pop_back(); });
  throws([](Plan& p) { p.knots[3].end_effector_yaw.clear(); });
  throws([](Plan& p) { p.knots[0].end_effector_yaw.clear(); });
}

TEST_CASE("checker accepts a walk whose phases have different laws") {
  Plan plan = walk();
  for (auto& phase : plan.phases)
    for (auto& contact : phase.contacts) contact.moment_W.setZero();
  give_wrenches(plan);
  replay_wrench_knots(plan);
  for (std::size_t k = 0; k < plan.phases.size(); k += 3) {
    plan.phases[k].law = mcplan::laws::Pendulum();
    for (auto& contact : plan.phases[k].contacts) contact.center_of_pressure_W.setZero();
  }
  const CheckResult result = check(plan);
  INFO(result.to_string());
  CHECK(result.ok());
}

TEST_CASE("checker survives contact wrenches that overflow") {
  CHECK(broken([](Plan& p) { p.phases[2].contacts[left_foot].stiffness = 1e300; }).count("dynamics") == 1);
  CHECK(broken([](Plan& p) { p.knots[2].angular_momentum_W.x() = 1e300; }).count("dynamics") == 1);
}
