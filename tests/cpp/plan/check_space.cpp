#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "plan/checker_case.hpp"
#include "plan/swings.hpp"

using namespace checker_case;

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

TEST_CASE("checker rejects a foot beyond a face that cuts the reach box, in contact and between the knots of a swing") {
  const auto beyond = [](const Vector3d& normal, double spare) {
    Case c;
    mcplan::EndEffector& limits = c.robot.end_effectors[left_foot];
    limits.reach_cut.A = normal.transpose();
    limits.reach_cut.b = Eigen::VectorXd::Constant(1, normal.dot(limits.nominal_B) + spare);
    const CheckResult result = c.check();
    return result.ok() ? Names{} : names(result);
  };
  // Feet hang 0.70 m below the CoM at the knots and 0.62 m half way through a swing.
  CHECK(beyond(Vector3d::UnitZ(), 0.09).empty());
  CHECK(beyond(Vector3d::UnitZ(), 0.07) == Names{"reach"});
  // The CoM passes over a foot that stands.
  CHECK(beyond(-Vector3d::UnitX(), 0.3).empty());
  CHECK(beyond(-Vector3d::UnitX(), 0.01) == Names{"reach"});
}

TEST_CASE("checker rejects a sole that stands with a bar through it, where neither its middle nor its corners are") {
  // The left foot starts with a sole from y = 0.05 to 0.15; to a side it is out of the bar by 0.15 - y.
  const auto beside_the_middle = [](double from_y, double top) {
    Case c;
    c.scene.surfaces[block] = rectangle("block", -0.06, -0.02, from_y, 0.145, top);
    c.scene.surfaces[block].thickness = top;
    const CheckResult result = c.check();
    return result.ok() ? 0.0 : result.worst().name == "clearance" ? result.worst().value : -1.0;
  };
  CHECK(beside_the_middle(0.105, 0.1) == doctest::Approx(0.045 - 0.03));
  CHECK(beside_the_middle(0.105, 0.04) == doctest::Approx(0.04 - 0.03));
  CHECK(beside_the_middle(0.105, 0.03) == 0.0);  // a bump
  CHECK(beside_the_middle(0.125, 0.1) == 0.0);   // beside
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

TEST_CASE("the CoM is no faster than the robot's, within what its speed at start and goal may be off") {
  mcplan::Plan plan = fixtures::walk();
  double fastest = 0.0;
  for (double t = 0.0; t <= plan.duration(); t += 1e-3) fastest = std::max(fastest, plan.at(t).com_velocity_W.norm());
  const double tolerance = mcplan::Tolerances().boundary;
  for (const double max : {fastest, fastest - 0.9 * tolerance}) {
    plan.robot.max_com_speed = max;
    CHECK(mcplan::check(plan, plan.scene, plan.robot).ok());
  }
  plan.robot.max_com_speed = fastest - 1.1 * tolerance;
  const mcplan::CheckResult result = mcplan::check(plan, plan.scene, plan.robot);
  REQUIRE(result.violations().size() == 1);
  const mcplan::Violation violation = result.violations().front();
  CHECK(violation.name == "com_speed");
  CHECK(violation.unit == "m/s");
  CHECK(violation.value == doctest::Approx(1.1 * tolerance).epsilon(1e-3));
  CHECK(plan.at(violation.time_s).com_velocity_W.norm() == doctest::Approx(fastest).epsilon(1e-3));
}
