#include "mcplan/plan/checker.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <set>

#include "mcplan/base/error.hpp"
#include "plan/depths.hpp"
#include "plan/fixtures.hpp"
#include "plan/name_sets.hpp"
#include "plan/swings.hpp"

namespace {

using namespace fixtures;
using Eigen::Vector3d;
using mcplan::CheckResult;
using mcplan::Plan;
using mcplan::Robot;
using mcplan::Scene;

struct Case {
  Plan plan = walk();
  Scene scene = plan.scene;
  Robot robot = plan.robot;

  CheckResult check() const { return mcplan::check(plan, scene, robot); }
};

using Names = std::set<std::string>;

Names names(const CheckResult& result) {
  Names out;
  for (const auto& violation : result.violations()) out.insert(violation.name);
  return out;
}

/// Names of what a change to the valid walk (or another case) violates.
Names broken(const std::function<void(Case&)>& mutate, Case walk_case = {}) {
  mutate(walk_case);
  const CheckResult result = walk_case.check();
  REQUIRE_FALSE(result.ok());
  CHECK(result.worst().name == result.violations().front().name);
  return names(result);
}

const mcplan::Violation& find(const CheckResult& result, const std::string& name) {
  for (const auto& violation : result.constraints)
    if (violation.name == name) return violation;
  throw std::out_of_range(name);
}

void shift_foothold(Plan& plan, int foot, int first_knot, int last_knot, const Vector3d& by) {
  for (int k = first_knot; k <= last_knot; ++k) plan.knots[k].end_effectors_W[foot] += by;
}

Case at_rails(double height, double hold) {
  Case c;
  c.plan = stand_at_rails(height, hold);
  c.scene = c.plan.scene;
  return c;
}

}  // namespace

TEST_CASE("checker accepts a walk made by hand and reports every constraint once") {
  const CheckResult result = Case().check();
  INFO(result.to_string());
  CHECK(result.ok());
  CHECK(result.violations().empty());
  CHECK(result.to_string() == "ok");
  CHECK(result.constraints.size() == 25);
  CHECK(find(result, "dynamics").value < 1e-11);
  CHECK(find(result, "at_consistency").value < 1e-11);
  CHECK(find(result, "friction").value < -0.3);
  CHECK(find(result, "contact_distance").value == doctest::Approx(0.0).epsilon(1e-12));
  CHECK(find(result, "goal").value < 1e-6);
  CHECK(find(result, "force_cap").end_effector == "right_foot");
}

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

TEST_CASE("checker rejects a foot two millimetres above the ground") {
  CHECK(broken([](Case& c) { shift_foothold(c.plan, left_foot, 4, 9, {0, 0, 0.002}); }).count("contact_distance") == 1);
  CHECK(broken([](Case& c) {
          shift_foothold(c.plan, left_foot, 12, 12, {0, 0, 0.002});
        }).count("contact_distance") == 1);
}

TEST_CASE("checker looks at what touches down at the very end") {
  // The plan ends in the middle of the first swing's landing: its last phase is free, the final contact is not.
  const auto ends_with_landing = [](Case& c) {
    c.plan.knots.resize(5);
    c.plan.phases.resize(4);
    c.plan.swings.resize(1);
    c.plan.knots[4].end_effectors_W[left_foot].z() = 0.01;
  };
  CHECK(broken(ends_with_landing).count("contact_distance") == 1);
}

TEST_CASE("checker rejects a foot beyond the edge of its surface") {
  CHECK(broken([](Case& c) {
          for (int i : {1, 2}) c.scene.surfaces[ground].vertices_W[i].x() = 0.2;
        }) == Names{"contact_polygon"});
}

TEST_CASE("checker rejects a foot on a surface for hands") {
  CHECK(broken([](Case& c) {
          for (int k = 4; k <= 8; ++k) c.plan.phases[k].contacts[left_foot].surface = hand_patch;
        }) == Names{"contact_permission"});
}

TEST_CASE("checker rejects a foot that slips by two millimetres") {
  const auto names_found = broken([](Case& c) { shift_foothold(c.plan, left_foot, 8, 9, {0.002, 0, 0}); });
  CHECK(names_found.count("slip") == 1);
  CHECK(names_found.count("path_continuity") == 0);
}

TEST_CASE("checker adds up a slip over the phases of one contact") {
  const auto creep = [](double each) {
    return [each](Case& c) {
      for (int k = 5; k <= 9; ++k) shift_foothold(c.plan, left_foot, k, 9, {each, 0, 0});
    };
  };
  CHECK(broken(creep(0.0003)) == Names{"slip"});
  Case little;
  creep(0.0001)(little);
  CHECK(little.check().ok());
}

TEST_CASE("checker adds up a slip when only the name of the surface changes") {
  // Ground and patch lie in one plane; a foot may not glide from one to the other in mid-stance.
  const auto names_found = broken([](Case& c) {
    for (int k = 6; k <= 8; ++k) c.plan.phases[k].contacts[left_foot].surface = patch;
    shift_foothold(c.plan, left_foot, 6, 9, {0.002, 0, 0});
  });
  CHECK(names_found == Names{"sequence_switch", "slip"});
}

TEST_CASE("checker rejects a force that acts beside the contact") {
  CHECK(broken([](Case& c) { c.plan.phases[1].contacts[left_hand].anchor_W.x() += 0.002; }) == Names{"anchor"});
  // The foot stands 0.12 m behind where its force acts, the sole reaches 0.10 m.
  CHECK(broken([](Case& c) { shift_foothold(c.plan, left_foot, 4, 9, {-0.12, 0, 0}); }).count("anchor") == 1);
  Case on_the_sole;
  shift_foothold(on_the_sole.plan, left_foot, 4, 9, {-0.03, 0, 0});
  CHECK(on_the_sole.check().ok());
}

TEST_CASE("checker rejects a path that jumps at a knot") {
  // Two swings that hold the hand in different boxes: the one that ends outside the reach box widens its own.
  CHECK(broken([](Case& c) {
          c.plan.knots[6].end_effectors_W[right_hand].z() += 0.5;
          c.plan.swings.push_back({right_hand, 4, 6, 2.0, Vector3d::UnitZ(), Vector3d::UnitZ()});
          c.plan.swings.push_back({right_hand, 5, 8, 0.0, Vector3d::UnitZ(), Vector3d::UnitZ()});
        }).count("path_continuity") == 1);
}

TEST_CASE("checker rejects a path that jumps within a phase") {
  // Held in the reach box, a velocity beyond all bounds throws the hand from side to side.
  for (double velocity : {1e3, 1e21, 1e308}) {
    CAPTURE(velocity);
    CHECK(broken([velocity](Case& c) {
            mcplan::choose_swings(c.plan);
            c.plan.knots[6].end_effector_velocities_W[right_hand].y() = velocity;
          }).count("path_continuity") == 1);
  }
}

TEST_CASE("checker tells a path that bends between rare samples from one that jumps") {
  Case c;
  mcplan::choose_swings(c.plan);
  c.plan.knots[6].end_effector_velocities_W[right_hand].y() = 3.0;
  for (double sample_s : {1e-3, 1e-2, 0.1, 1.0}) {
    CAPTURE(sample_s);
    mcplan::Tolerances tolerances;
    tolerances.sample_s = sample_s;
    CHECK(mcplan::check(c.plan, c.scene, c.robot, tolerances).ok());
    c.plan.knots[6].end_effector_velocities_W[right_hand].y() = 1e6;
    CHECK(names(mcplan::check(c.plan, c.scene, c.robot, tolerances)).count("path_continuity") == 1);
    c.plan.knots[6].end_effector_velocities_W[right_hand].y() = 3.0;
  }
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

TEST_CASE("checker rejects a hand out of reach") {
  CHECK(broken([](Case& c) { c.plan.knots[6].end_effectors_W[right_hand].y() -= 0.25; }) == Names{"reach"});
}

TEST_CASE("checker rejects a free hand out of reach at a knot, though the path bends into the reach box") {
  for (const Vector3d& by : {Vector3d(0, -0.25, 0), Vector3d(-1e9, 5, 1e9), Vector3d(0, 0, 1.18e21)}) {
    CAPTURE(by.transpose());
    CHECK(broken([&](Case& c) {
            mcplan::choose_swings(c.plan);
            c.plan.knots[6].end_effectors_W[right_hand] += by;
          }).count("reach") == 1);
  }
}

TEST_CASE("checker rejects a swing that leaves the reach box between the knots") {
  // Feet hang 0.70 m below the CoM at the knots and 0.62 m half way through a swing.
  CHECK(broken([](Case& c) { c.robot.end_effectors[left_foot].reach_max_B.z() = -0.63; }) == Names{"reach"});
}

TEST_CASE("checker measures reach in the base's frame") {
  // A quarter turn puts the feet before and behind the base, where they may not be.
  CHECK(broken([](Case& c) {
          for (auto& knot : c.plan.knots) knot.base_rpy.z() += M_PI / 2;
        }).count("reach") == 1);
}

TEST_CASE("checker rejects a swing through a block") {
  CHECK(broken([](Case& c) { c.plan.swings[0].height = 0.0; }) == Names{"clearance"});
}

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

TEST_CASE("solids that are set aside while they are out of reach are found again: a wall anywhere on the way is hit") {
  const Case made;
  int hit = 0;
  for (int n = 0; n < 40; ++n) {
    Case blocked = made;
    // A thin plate across the way, as high as feet swing, whose prism reaches down to the ground.
    const double x = -0.2 + 0.05 * n;
    mcplan::Surface plate;
    plate.name = "plate";
    plate.vertices_W = {{x, -2.0, 0.5}, {x + 0.02, -2.0, 0.5}, {x + 0.02, 2.0, 0.5}, {x, 2.0, 0.5}};
    plate.thickness = 0.499;
    blocked.scene.surfaces.push_back(plate);
    double deepest = 0.0;  // by looking everywhere
    const auto solids = mcplan::solids_of(blocked.scene);
    for (int l = 0; l < made.plan.end_effector_count(); ++l)
      for (const auto& stretch : mcplan::free_stretches(made.plan, solids, l))
        deepest = std::max(deepest, fixtures::deepest(made.plan, solids, l, stretch, 1e-3));
    double checked = 0.0;
    for (const auto& violation : blocked.check().constraints)
      if (violation.name == "clearance") checked = violation.value;
    CHECK(checked == doctest::Approx(deepest).epsilon(1e-6));
    hit += deepest > 0.0;
  }
  CHECK(hit > 5);
}
