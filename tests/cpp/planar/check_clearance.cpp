#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "mcplan/planar/checker.hpp"
#include "planar/robots.hpp"

using mcplan::check;
using mcplan::CheckResult;
using mcplan::PlanarPlan;
using mcplan::PlanarSurface;
using mcplan::SolidDepth;
using planar::hand;

namespace {

const mcplan::Violation& clearance(const CheckResult& result) {
  for (const auto& violation : result.constraints)
    if (violation.name == "clearance") return violation;
  throw std::out_of_range("clearance");
}

const SolidDepth& depth(const std::vector<SolidDepth>& depths, int end_effector, int surface) {
  for (const SolidDepth& found : depths)
    if (found.end_effector == end_effector && found.surface == surface) return found;
  throw std::out_of_range("depth");
}

/// The hand of the robot that stands is a sole of 0.1 m that is level, this high.
constexpr double kHalfHand = 0.05;
double hand_height() { return planar::hip_height() + 0.2; }

/// The plan in which it stands still, with another surface; nothing is asked of the hand but to stay out of solids.
PlanarPlan beside(const Eigen::Vector2d& origin_W, double angle, double from, double to) {
  PlanarPlan plan = planar::standing_plan();
  for (auto& phase : plan.task.phases) phase.clearances.clear();
  plan.task.robot.end_effectors[hand].points = {-kHalfHand, kHalfHand};
  PlanarSurface surface;
  surface.name = "block";
  surface.origin_W = origin_W;
  surface.angle = angle;
  surface.from = from;
  surface.to = to;
  plan.task.surfaces.push_back(surface);
  return plan;
}

}  // namespace

TEST_CASE("a swinging end-effector in a solid of which the task says nothing is refused") {
  const PlanarPlan plan = beside({0.0, hand_height() + 0.014}, 0.0, -INFINITY, INFINITY);
  const CheckResult result = check(plan);
  REQUIRE(result.violations().size() == 1);
  CHECK(result.worst().name == "clearance");
  CHECK(result.worst().end_effector == "hand and block");
  CHECK(result.worst().value == doctest::Approx(0.014));
  CHECK(result.worst().phase == 0);
  CHECK(check(beside({0.0, hand_height() + 0.0014}, 0.0, -INFINITY, INFINITY)).ok());
}

TEST_CASE("the place and the time of the worst depth are those of the sample") {
  PlanarPlan plan = beside({0.0, 2.0}, M_PI, -INFINITY, INFINITY);  // a ceiling
  plan.control_points(planar::arm - 1, 7) = 1.2;                    // the arm swings up and back
  double highest = 0.0, when_s = 0.0;
  std::vector<double> heights;
  for (int i = 0; i <= 4000; ++i) {
    const double time_s = plan.duration() * i / 4000.0;
    const auto frames = mcplan::planar_kinematics(plan.task.robot, plan.at(time_s).configuration);
    const auto sole = planar_point(frames[planar::arm], {0.0, -0.2}, 0.0);
    heights.push_back(0.0);
    for (double end : {-kHalfHand, kHalfHand}) {
      const double height = planar_point(sole, {end, 0.0}).position_W.y();
      heights.back() = std::max(heights.back(), height);
      if (height <= highest) continue;
      highest = height;
      when_s = time_s;
    }
  }
  plan.task.surfaces.back().origin_W.y() = highest - 0.02;
  const SolidDepth found = depth(solid_depths(plan), hand, 1);
  CHECK(found.depth_m == doctest::Approx(0.02).epsilon(1e-4));
  CHECK(std::abs(found.time_s - when_s) < 2e-3);
  CHECK(found.phase == 1);
  CHECK(clearance(check(plan)).value == found.depth_m);
  CHECK(clearance(check(plan)).time_s == found.time_s);

  // The plan is kept until the hand first goes in, before it is deepest.
  mcplan::PlanarTolerances others;  // moving the arm so needs torques and forces that the standing plan has not
  others.limit = others.balance = others.moment = others.friction = others.pull = INFINITY;
  const double tolerance = others.clearance;
  const auto first =
      std::find_if(heights.begin(), heights.end(), [&](double height) { return height > highest - 0.02 + tolerance; });
  const double first_s = plan.duration() * (first - heights.begin()) / 4000.0;
  CHECK(first_s < when_s - 0.02);
  const CheckResult kept = check(plan, others);
  REQUIRE(kept.violations().size() == 1);
  CHECK(std::abs(kept.kept_until_s - first_s) < 2e-3);
  CHECK(kept.checked_until_s == plan.duration());
}

TEST_CASE("a solid ends where its surface does") {
  const double top = hand_height() + 0.03;
  CHECK(clearance(check(beside({0.0, top}, 0.0, kHalfHand + 1e-4, 1.0))).value == doctest::Approx(-1e-4));  // beside it
  CHECK(clearance(check(beside({0.0, top}, 0.0, kHalfHand - 0.01, 1.0))).value == doctest::Approx(0.01));   // its begin
  CHECK(clearance(check(beside({0.0, top}, 0.0, -1.0, 0.01 - kHalfHand))).value == doctest::Approx(0.01));  // its end
  CHECK(clearance(check(beside({0.0, top}, 0.0, -1.0, 1.0))).value == doctest::Approx(0.03));               // its front
}

TEST_CASE("an edge between the outermost points of an end-effector is in it, though neither of them is in the solid") {
  // A surface that slopes up at 45 degrees and ends above the middle of the hand: its solid is the strip below that, to
  // the right, and neither end of the hand is in it.
  const double over = 0.01;
  const PlanarPlan plan = beside({0.0, hand_height() + over}, 0.25 * M_PI, -1.0, 0.0);
  const PlanarSurface& block = plan.task.surfaces.back();
  for (double end : {-kHalfHand, kHalfHand}) {
    const Eigen::Vector2d from_corner(end, -over);
    CHECK((from_corner.dot(block.normal_W()) > 0.0 || from_corner.dot(block.tangent_W()) > 0.0));
  }
  CHECK(clearance(check(plan)).value == doctest::Approx(over));
  CHECK(clearance(check(beside({0.0, hand_height() - over}, 0.25 * M_PI, -1.0, 0.0))).value == doctest::Approx(-over));
}

TEST_CASE("pairs in no_clearance are not asked for, and their depth is told all the same") {
  PlanarPlan plan = beside({0.0, hand_height() + 0.014}, 0.0, -INFINITY, INFINITY);
  plan.task.no_clearance = {{hand, 1}};
  CHECK(check(plan).ok());
  const SolidDepth found = depth(solid_depths(plan), hand, 1);
  CHECK(found.depth_m == doctest::Approx(0.014));
  CHECK_FALSE(found.asked);
  CHECK(depth(solid_depths(plan), hand, 0).asked);
  CHECK(depth(solid_depths(plan), hand, 0).depth_m == doctest::Approx(-hand_height()));
}

TEST_CASE("end-effectors that stand are left to their drift") {
  const auto depths = solid_depths(planar::standing_plan());
  REQUIRE(depths.size() == 1);
  CHECK(depths[0].end_effector == hand);
}
