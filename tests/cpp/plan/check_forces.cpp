#include <doctest/doctest.h>

#include "plan/checker_case.hpp"

using namespace checker_case;

TEST_CASE("checker accepts hands that hold rails, below the CoM by friction's leave and above it by pulling") {
  CHECK(at_rails(0.5, 2.0).check().ok());
  CHECK(at_rails(0.8, 2.0).check().ok());
}

TEST_CASE("checker rejects a rail that is pulled at without a grasp") {
  CHECK(broken([](Case& c) { c.scene.surfaces[1].grasp = false; }, at_rails(0.8, 2.0)) == Names{"pull"});
}

TEST_CASE("checker rejects a hand that presses a rail sideways beyond friction") {
  CHECK(broken([](Case& c) { c.scene.surfaces[2].grasp = false; }, at_rails(0.5, 2.0)) == Names{"friction"});
}

TEST_CASE("checker rejects feet on ice") {
  CHECK(broken([](Case& c) { c.scene.surfaces[ground].friction = 0.1; }) == Names{"friction"});
}

TEST_CASE("checker rejects any force of a free end-effector") {
  CHECK(broken([](Case& c) { c.plan.phases[3].contacts[left_foot].stiffness = 1e-14; }) == Names{"free_force"});
  CHECK(broken([](Case& c) { c.plan.phases[3].contacts[left_foot].moment_W.x() = 1e-14; }) == Names{"free_force"});
}

TEST_CASE("checker rejects a negative stiffness") {
  CHECK(broken([](Case& c) { c.plan.phases[1].contacts[left_hand].stiffness = -1e-10; }) == Names{"stiffness_sign"});
}

TEST_CASE("checker rejects a force above the cap") {
  CHECK(broken([](Case& c) { c.robot.end_effectors[right_foot].max_force = 390.0; }) == Names{"force_cap"});
}

TEST_CASE("checker rejects a moment above the limit") {
  CHECK(broken([](Case& c) { c.robot.end_effectors[left_foot].max_moment.z() = 0.4; }) == Names{"moment"});
}

TEST_CASE("checker rejects a moment that a narrow sole cannot give") {
  CHECK(broken([](Case& c) { c.robot.end_effectors[left_foot].half_size.y() = 1e-3; }) == Names{"moment"});
  // Two feet that tilt against each other leave the base at rest; 30 N m need a centre of pressure 0.15 m off the foot.
  const auto tilt = [](double moment) {
    return [moment](Case& c) {
      for (auto& phase : c.plan.phases) {
        phase.contacts[left_foot].moment_W.x() = moment;
        phase.contacts[right_foot].moment_W.x() = -moment;
      }
    };
  };
  CHECK(broken(tilt(30.0), at_rails(0.5, 2.0)) == Names{"moment"});
  Case little = at_rails(0.5, 2.0);
  tilt(3.0)(little);
  CHECK(little.check().ok());
}

TEST_CASE("checker holds a plan to the angular momentum, and its rate, that it claims to keep") {
  // The walk made by hand turns its base by 0.5 N m; of linear momentum there is none about the CoM.
  const auto claims = [](double momentum, double rate) {
    return [=](Case& c) {
      c.plan.momentum_max = momentum;
      c.plan.momentum_rate_max = rate;
    };
  };
  Case kept;
  claims(10.0, 0.6)(kept);
  CHECK(kept.check().ok());
  const CheckResult result = kept.check();
  const mcplan::Violation& margin = find(result, "angular_momentum");
  CHECK(margin.value == doctest::Approx(0.5 / 0.6 - 1.0));
  CHECK(broken(claims(10.0, 0.4)) == Names{"angular_momentum"});
  CHECK(broken(claims(1e-3, 10.0)) == Names{"angular_momentum"});
  Case silent;
  CHECK(find(silent.check(), "angular_momentum").value == 0.0);
}
