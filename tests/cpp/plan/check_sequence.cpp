#include <doctest/doctest.h>

#include "plan/checker_case.hpp"

using namespace checker_case;

TEST_CASE("checker rejects two switches in one step") {
  const auto lets_go_as_the_foot_lifts = [](Case& c) {
    c.plan.phases[2].contacts[left_hand] = c.plan.phases[1].contacts[left_hand];
    c.plan.knots[3].end_effectors_W[left_hand] = c.plan.knots[2].end_effectors_W[left_hand];
  };
  CHECK(broken(lets_go_as_the_foot_lifts) == Names{"sequence_switch"});
  Case free_choice;
  lets_go_as_the_foot_lifts(free_choice);
  mcplan::Tolerances two;
  two.switches = 2;
  CHECK(mcplan::check(free_choice.plan, free_choice.scene, free_choice.robot, two).ok());
}

TEST_CASE("checker rejects a step from surface to surface") {
  CHECK(broken([](Case& c) {
          for (int k = 6; k <= 8; ++k) c.plan.phases[k].contacts[left_foot].surface = patch;
        }) == Names{"sequence_switch"});
}

TEST_CASE("checker counts the step to the final contacts") {
  CHECK(broken([](Case& c) { c.plan.final_contacts[left_foot] = patch; }).count("sequence_switch") == 1);
}

TEST_CASE("checker rejects a contact sequence against the scene's rule") {
  CHECK(broken([](Case& c) { c.scene.rules = {{{"left_foot"}, {"right_hand"}}}; }) == Names{"sequence_rule"});
  CHECK(broken([](Case& c) { c.scene.rules = {{{"left_foot"}, {"tail"}}}; }) == Names{"sequence_rule"});
  Case satisfied;
  satisfied.scene.rules = {{{"foot"}, {"hand"}}, {{"left_foot"}, {"right_foot"}}, {{"tail"}, {"hand"}}};
  CHECK(satisfied.check().ok());
}

TEST_CASE("checker rejects another start") {
  CHECK(broken([](Case& c) { c.scene.start.position_W.x() = 0.015; }) == Names{"start"});
  CHECK(broken([](Case& c) { c.scene.start.yaw = 0.02; }) == Names{"start"});
  CHECK(broken([](Case& c) { c.scene.start.contacts["left_foot"] = "patch"; }) == Names{"start"});
  CHECK(broken([](Case& c) { c.scene.start.contacts["right_hand"] = "hand_patch"; }) == Names{"start"});
}

TEST_CASE("checker rejects a start with a foot beside the nominal stance") {
  const auto result = broken([](Case& c) {
    shift_foothold(c.plan, right_foot, 0, 6, {0, -0.03, 0});
    for (int k = 0; k < 6; ++k) c.plan.phases[k].contacts[right_foot].anchor_W.y() -= 0.03;
  });
  CHECK(result.count("start") == 1);
}

TEST_CASE("checker rejects another goal") {
  CHECK(broken([](Case& c) { c.scene.goal.position_W.y() = 0.015; }) == Names{"goal"});
  CHECK(broken([](Case& c) { c.scene.goal.yaw = 0.02; }) == Names{"goal"});
  CHECK(broken([](Case& c) { c.scene.goal.contacts["right_foot"] = "patch"; }) == Names{"goal"});
}

TEST_CASE("checker rejects a plan that end_effectors in motion") {
  CHECK(broken([](Case& c) {
          c.plan.knots.pop_back();
          c.plan.phases.pop_back();
          c.scene.goal.position_W.head<2>() = c.plan.knots.back().com_W.head<2>();
        }) == Names{"goal"});
}

TEST_CASE("checker takes a heading modulo a full turn") {
  Case turned;
  turned.scene.goal.yaw = 2 * M_PI;
  CHECK(turned.check().ok());
}
