#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "mcplan/plan/checker.hpp"
#include "plan/fixtures.hpp"

namespace {

using namespace fixtures;
using mcplan::CheckResult;
using mcplan::Plan;
using mcplan::Scene;

/// A fence across the way: high enough for feet to swing below its top, low enough for the CoM to pass above it.
Plan walk_through_fence(double x) {
  Plan plan = walk();
  mcplan::Surface fence = rectangle("fence", x, x + 0.02, -1, 1, 0.60);
  fence.thickness = 0.35;
  fence.end_effectors = {"hand"};
  plan.scene.surfaces.push_back(fence);
  return plan;
}

/// The part of the straight line between two points that lies in the fence, from points along it.
double counted(const Vector3d& from, const Vector3d& to, double x) {
  constexpr int kPoints = 4000;
  int inside = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Vector3d p = from + (i + 0.5) / kPoints * (to - from);
    inside += p.x() > x && p.x() < x + 0.02 && p.z() > 0.25 && p.z() < 0.60 && std::abs(p.y()) < 1.0;
  }
  return (to - from).norm() * inside / kPoints;
}

}  // namespace

TEST_CASE("a straight limb that passes through a solid is a warning with its place and time, and no violation") {
  constexpr double kFence = 0.11;
  const Plan plan = walk_through_fence(kFence);
  const CheckResult result = mcplan::check(plan, plan.scene, plan.robot);
  CHECK(result.ok());
  CHECK(result.violations().empty());
  REQUIRE(result.warnings.size() == 1);
  const mcplan::Violation& warning = result.warnings.front();
  CHECK(warning.name == "limb");
  CHECK(warning.surface == "fence");
  const int l = plan.robot.end_effector_index(warning.end_effector);
  REQUIRE(l >= 0);
  CHECK(plan.robot.end_effectors[l].kind == "foot");
  const mcplan::PlanState at = plan.at(warning.time_s);
  CHECK(at.phase == warning.phase);
  CHECK(counted(at.com_W, at.end_effectors[l].position_W, kFence) == doctest::Approx(warning.value).epsilon(0.02));
  double longest = 0.0;
  for (double t = 0.0; t < plan.duration(); t += 0.01) {
    const mcplan::PlanState state = plan.at(t);
    for (const auto& end : state.end_effectors)
      longest = std::max(longest, counted(state.com_W, end.position_W, kFence));
  }
  CHECK(warning.value == doctest::Approx(longest).epsilon(0.05));
  CHECK(result.to_string().rfind("ok\nwarning: limb at " + warning.end_effector + " in phase ", 0) == 0);
  CHECK(result.to_string().find("in the solid of 'fence'") != std::string::npos);
}

TEST_CASE("solids beside the way, and what an end-effector touches, warn of nothing") {
  for (const Plan& plan : {walk(), walk_through_fence(1.5)}) {
    const CheckResult result = mcplan::check(plan, plan.scene, plan.robot);
    CHECK(result.warnings.empty());
    CHECK(result.to_string() == "ok");
  }
  // The rail that the hand holds is thick enough for the arm to lie in it.
  Plan held = stand_at_rails(kHeight + 0.1, 0.0);
  for (mcplan::Surface& surface : held.scene.surfaces)
    if (surface.grasp) surface.thickness = 0.3;
  for (const mcplan::Violation& warning : mcplan::check(held, held.scene, held.robot).warnings)
    CHECK(held.robot.end_effectors[held.robot.end_effector_index(warning.end_effector)].kind == "foot");
}

TEST_CASE("a tolerance that asks for a distance to spare warns of no limb that is in no solid") {
  const Plan plan = walk();
  mcplan::Tolerances tolerances;
  tolerances.clearance = -1.0;
  CHECK(mcplan::check(plan, plan.scene, plan.robot, tolerances).warnings.empty());
}
