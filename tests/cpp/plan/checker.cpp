#include "mcplan/plan/checker.hpp"

#include <doctest/doctest.h>

#include "mcplan/base/error.hpp"
#include "plan/checker_case.hpp"
#include "plan/swings.hpp"

using namespace checker_case;

TEST_CASE("checker accepts a walk made by hand and reports every constraint once") {
  const CheckResult result = Case().check();
  INFO(result.to_string());
  CHECK(result.ok());
  CHECK(result.violations().empty());
  CHECK(result.to_string() == "ok");
  CHECK(result.constraints.size() == 30);
  CHECK(find(result, "dynamics").value < 1e-11);
  CHECK(find(result, "at_consistency").value < 1e-11);
  CHECK(find(result, "friction").value < -0.3);
  CHECK(find(result, "contact_distance").value == doctest::Approx(0.0).epsilon(1e-12));
  CHECK(find(result, "goal").value < 1e-6);
  CHECK(find(result, "force_cap").end_effector == "right_foot");
}

TEST_CASE("checker rejects a number that is not finite") {
  CHECK(broken([](Case& c) { c.plan.knots[3].com_W.y() = std::nan(""); }) == Names{"finite"});
  CHECK(broken([](Case& c) { c.plan.phases[2].contacts[1].stiffness = INFINITY; }) == Names{"finite"});
  CHECK(broken([](Case& c) { c.plan.phases[2].duration = std::nan(""); }) == Names{"finite"});
  CHECK(broken([](Case& c) { c.plan.swings[0].height = std::nan(""); }) == Names{"finite"});
}

TEST_CASE("checker rejects a phase that takes no time") {
  CHECK(broken([](Case& c) { c.plan.phases[4].duration = 0.0; }) == Names{"phase_duration"});
  CHECK(broken([](Case& c) { c.plan.phases[4].duration = -0.4; }) == Names{"phase_duration"});
}

TEST_CASE("checker rejects a CoM that jumps by a tenth of a micrometre at a knot") {
  CHECK(broken([](Case& c) { c.plan.knots[5].com_W.x() += 1e-7; }) == Names{"dynamics"});
}

TEST_CASE("checker rejects a velocity that jumps at a knot") {
  CHECK(broken([](Case& c) { c.plan.knots[5].com_velocity_W.z() += 1e-7; }) == Names{"dynamics"});
}

TEST_CASE("checker rejects a force larger by a part in a million") {
  CHECK(broken([](Case& c) { c.plan.phases[6].contacts[left_foot].stiffness *= 1 + 1e-6; }) == Names{"dynamics"});
}

TEST_CASE("checker rejects a contact moment that the base does not follow") {
  CHECK(broken([](Case& c) { c.plan.phases[5].contacts[right_foot].moment_W.y() = 1e-4; }) == Names{"dynamics"});
}

TEST_CASE("checker rejects a phase that lasts a microsecond longer than its motion") {
  CHECK(broken([](Case& c) { c.plan.phases[7].duration += 1e-6; }) == Names{"dynamics"});
}

TEST_CASE("checker rejects a plan made for another gravity") {
  CHECK(broken([](Case& c) { c.plan.scene.gravity = 9.80; }) == Names{"at_consistency"});
  CHECK(broken([](Case& c) { c.scene.gravity = 1.62; }).count("dynamics") == 1);
}

TEST_CASE("checker rejects a plan that carries a lighter robot") {
  CHECK(broken([](Case& c) { c.plan.robot.mass = 39.0; }) == Names{"at_consistency"});
}

TEST_CASE("checker survives numbers that overflow") {
  CHECK(broken([](Case& c) { c.plan.phases[2].contacts[left_foot].stiffness = 1e300; }).count("dynamics") == 1);
  CHECK(broken([](Case& c) { c.plan.knots[2].com_W.z() = 1e308; }).count("dynamics") == 1);
  CHECK(broken([](Case& c) { c.plan.knots[4].end_effectors_W[left_hand].y() = -1e308; }).count("reach") == 1);
}

TEST_CASE("checker throws on arrays that do not fit together") {
  const auto throws = [](const std::function<void(Case&)>& mutate) {
    Case c;
    mutate(c);
    CHECK_THROWS_AS(c.check(), mcplan::InvalidPlan);
  };
  throws([](Case& c) { c.plan.knots.pop_back(); });
  throws([](Case& c) { c.plan = Plan(); });
  throws([](Case& c) { c.plan.phases[3].contacts.pop_back(); });
  throws([](Case& c) { c.plan.knots[2].end_effectors_W.pop_back(); });
  throws([](Case& c) { c.plan.knots[2].end_effector_velocities_W.clear(); });
  throws([](Case& c) { c.plan.final_contacts.clear(); });
  throws([](Case& c) { c.plan.final_contacts[0] = 5; });
  throws([](Case& c) { c.plan.phases[0].contacts[0].surface = -2; });
  throws([](Case& c) { c.plan.swings[0].end_phase = 13; });
  throws([](Case& c) { c.plan.robot.end_effectors.pop_back(); });
  throws([](Case& c) { c.robot.end_effectors.pop_back(); });
}

TEST_CASE("checker throws on a robot whose end-effectors have other names") {
  Case c;
  c.robot.end_effectors[left_foot].name = "lf_foot";
  CHECK_THROWS_WITH_AS(c.check(), doctest::Contains("must be that of the plan's robot"), mcplan::InvalidRobot);
}

TEST_CASE("checker throws on a sampling that is no sampling") {
  const Case c;
  for (double sample_s : {0.0, -1.0, 1e-7, std::nan("")}) {
    mcplan::Tolerances tolerances;
    tolerances.sample_s = sample_s;
    CHECK_THROWS_AS(mcplan::check(c.plan, c.scene, c.robot, tolerances), mcplan::InvalidOptions);
  }
}

TEST_CASE("a tolerance may be infinite or negative, but is a number") {
  const Case c;
  mcplan::Tolerances tolerances;
  tolerances.reach = std::numeric_limits<double>::infinity(), tolerances.friction = -1.0;
  tolerances.validate();
  CHECK_FALSE(mcplan::check(c.plan, c.scene, c.robot, tolerances).ok());
  tolerances.slip = std::nan("");
  CHECK_THROWS_WITH_AS(mcplan::check(c.plan, c.scene, c.robot, tolerances),
                       "tolerances.slip: must be a number, got nan", mcplan::InvalidOptions);
  CHECK_THROWS_WITH_AS(tolerances.validate(), "slip: must be a number, got nan", mcplan::InvalidOptions);
}

TEST_CASE("an empty result is worst nowhere") { CHECK(CheckResult().worst().name.empty()); }

TEST_CASE("a check that is stopped asks about once a millisecond, keeps what it found and never says ok") {
  const Case made;
  int asked = 0;
  const CheckResult whole = mcplan::check(made.plan, made.scene, made.robot, {}, [&] {
    ++asked;
    return false;
  });
  CHECK(whole.complete);
  CHECK(whole.ok());
  const double samples = made.plan.duration() / mcplan::Tolerances().sample_s;
  CHECK(asked >= samples / 1000.0);
  CHECK(asked <= samples / 100.0 + 1.0);
  for (int last : {1, asked / 2 + 1}) {
    int count = 0;
    const CheckResult part = mcplan::check(made.plan, made.scene, made.robot, {}, [&] { return ++count >= last; });
    CHECK(count == last);
    CHECK_FALSE(part.complete);
    CHECK_FALSE(part.ok());
    CHECK(part.constraints.size() == whole.constraints.size());
    CHECK(part.to_string() == "stopped before the end: the rest is not checked");
  }
}
