#include <doctest/doctest.h>

#include "plan/checker_case.hpp"
#include "plan/swings.hpp"

using namespace checker_case;

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

TEST_CASE("checker ends where a phase lasts so long that the instants of its clock are seconds apart") {
  for (const double duration : {1e13, 1e18, 1e300}) {
    CAPTURE(duration);
    Case c;
    mcplan::choose_swings(c.plan);
    c.plan.phases[5].duration = duration;
    c.plan.knots[6].end_effector_velocities_W[right_hand].y() = 1e3;
    mcplan::Tolerances tolerances;
    tolerances.sample_s = duration / 100.0;
    CHECK(names(mcplan::check(c.plan, c.scene, c.robot, tolerances)).count("dynamics") == 1);
  }
}
