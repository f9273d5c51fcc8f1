#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "mcplan/base/rotation.hpp"
#include "mcplan/plan/checker.hpp"
#include "plan/wrench_fixtures.hpp"

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

/// Whether points along a segment, moved, lie in a block that is aligned with the axes.
bool passes(const Eigen::AlignedBox3d& block, const Vector3d& from, const Vector3d& to, const Vector3d& moved) {
  constexpr int kPoints = 400;
  for (int i = 0; i <= kPoints; ++i)
    if (block.contains(from + static_cast<double>(i) / kPoints * (to - from) + moved)) return true;
  return false;
}

/// The least way by which the segment has to be moved to be outside, among many directions.
double least_way_out(const Eigen::AlignedBox3d& block, const Vector3d& from, const Vector3d& to) {
  double least = 1.0;
  constexpr int kDirections = 4000;
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kDirections, turn = 2.399963 * i, r = std::sqrt(1.0 - z * z);
    const Vector3d direction(r * std::cos(turn), r * std::sin(turn), z);
    double low = 0.0, high = least;
    if (passes(block, from, to, high * direction)) continue;
    for (int j = 0; j < 20; ++j) {
      const double middle = 0.5 * (low + high);
      (passes(block, from, to, middle * direction) ? low : high) = middle;
    }
    least = high;
  }
  return least;
}

const mcplan::Violation& found(const CheckResult& result, const std::string& name) {
  for (const mcplan::Violation& violation : result.constraints)
    if (violation.name == name) return violation;
  throw std::out_of_range(name);
}

}  // namespace

TEST_CASE("a limb that would have to move by more than it can bend to be out of a solid is a violation") {
  Plan plan = walk();
  mcplan::Surface wall = rectangle("wall", 0.05, 0.19, -1, 1, 0.60);
  wall.thickness = 0.5;
  wall.end_effectors = {"hand"};
  plan.scene.surfaces.push_back(wall);
  const Eigen::AlignedBox3d block(Vector3d(0.05, -1, 0.10), Vector3d(0.19, 1, 0.60));
  const CheckResult result = mcplan::check(plan, plan.scene, plan.robot);
  const mcplan::Violation& limb = found(result, "limb");
  CHECK(limb.value > limb.tolerance);
  CHECK_FALSE(result.ok());
  const mcplan::PlanState at = plan.at(limb.time_s);
  const Vector3d& end = at.end_effectors[plan.robot.end_effector_index(limb.end_effector)].position_W;
  const auto beyond = [&](const Vector3d& from, const Vector3d& to) {
    if (!passes(block, from, to, Vector3d::Zero())) return 0.0;
    constexpr int kPoints = 4000;
    int inside = 0;
    for (int i = 0; i < kPoints; ++i) inside += block.contains(from + (i + 0.5) / kPoints * (to - from));
    return std::max(least_way_out(block, from, to) - 0.1, (to - from).norm() * inside / kPoints - 0.15);
  };
  CHECK(limb.value == doctest::Approx(beyond(at.com_W, end)).epsilon(0.03));
  double largest = 0.0;
  for (double t = 0.0; t < plan.duration(); t += 0.1) {
    const mcplan::PlanState state = plan.at(t);
    for (const auto& other : state.end_effectors) largest = std::max(largest, beyond(state.com_W, other.position_W));
  }
  CHECK(limb.value >= largest - 0.003);
}

TEST_CASE("a limb on both sides of a thin panel is a violation as well, where it would have to move far") {
  Plan plan = walk();
  mcplan::Surface panel = rectangle("panel", -0.21, 0.45, -1, 1, 0.36);  // lies flat, across the shins and the thighs
  panel.thickness = 0.02;
  panel.end_effectors = {"hand"};
  plan.scene.surfaces.push_back(panel);
  const CheckResult result = mcplan::check(plan, plan.scene, plan.robot);
  const Eigen::AlignedBox3d block(Vector3d(-0.21, -1, 0.34), Vector3d(0.45, 1, 0.36));
  const mcplan::Violation& limb = found(result, "limb");
  const mcplan::PlanState at = plan.at(limb.time_s);
  const Vector3d& end = at.end_effectors[plan.robot.end_effector_index(limb.end_effector)].position_W;
  CHECK(limb.value > 0.1);
  CHECK(limb.value + 0.1 == doctest::Approx(least_way_out(block, at.com_W, end)).epsilon(0.03));
}

TEST_CASE("a CoM that comes nearer to a solid than a tenth of its height is a violation, by the depth of that ball") {
  Plan plan = walk();
  const auto trunk_at = [&](double bottom) {
    plan.scene = hall();
    mcplan::Surface beam = rectangle("beam", 0.1, 0.2, -0.2, 0.2, 2.0);
    beam.thickness = 2.0 - bottom;
    beam.end_effectors = {"hand"};
    plan.scene.surfaces.push_back(beam);
    return found(mcplan::check(plan, plan.scene, plan.robot), "trunk");
  };
  CHECK(trunk_at(kHeight + 0.08).value == 0.0);
  CHECK(trunk_at(kHeight + 0.068).value == doctest::Approx(0.002));  // within the tolerance
  CHECK(trunk_at(kHeight + 0.05).value == doctest::Approx(0.02));
  CHECK(trunk_at(kHeight + 0.05).value > trunk_at(kHeight + 0.05).tolerance);
  CHECK(trunk_at(0.3).value == doctest::Approx(0.07));  // the CoM is in it
}

TEST_CASE("a part of the trunk nearer to a solid than its radius is a violation, by as much, however the base turns") {
  Plan plan = walk();
  const auto trunk_at = [&](double bottom, const Vector3d& from_B, const Vector3d& to_B) {
    plan.scene = hall();
    mcplan::Surface beam = rectangle("beam", -1.0, 2.0, -0.2, 0.2, 2.0);
    beam.thickness = 2.0 - bottom;
    beam.end_effectors = {"hand"};
    plan.scene.surfaces.push_back(beam);
    plan.robot.trunk = {{Vector3d(0, 0, 0.1), Vector3d(0, 0, 0.2), 0.05}, {from_B, to_B, 0.04}};
    return found(mcplan::check(plan, plan.scene, plan.robot), "trunk");
  };
  const Vector3d low(0, 0, -0.1), head(0, 0, 0.5);
  double highest = 0.0;
  for (double t = 0.0; t <= plan.duration(); t += 0.01) highest = std::max(highest, plan.at(t).com_W.z());
  CHECK(trunk_at(highest + 0.55, low, head).value == 0.0);
  const mcplan::Violation touched = trunk_at(highest + 0.52, low, head);
  CHECK(touched.value == doctest::Approx(0.02).epsilon(0.02));
  CHECK(touched.value > touched.tolerance);
  CHECK(trunk_at(highest + 0.52, head, low).value == touched.value);
  // In the middle of the line, and a line that lies in the solid.
  CHECK(trunk_at(highest + 0.52, Vector3d(0, -3, 0.5), Vector3d(0, 3, 0.5)).value ==
        doctest::Approx(touched.value).epsilon(0.02));
  CHECK(trunk_at(highest + 0.3, low, head).value == doctest::Approx(0.04));
  // Ahead of the base, by its angles: of a line through points of the plan, the deepest one.
  const Vector3d ahead(0.4, 0.0, 0.4);
  double nearest = 0.0;
  for (double t = 0.0; t <= plan.duration(); t += 0.001) {
    const mcplan::PlanState at = plan.at(t);
    const double z = (at.com_W + mcplan::rotation_from_rpy(at.base_rpy) * ahead).z();
    nearest = std::max(nearest, z + 0.04 - (highest + 0.42));
  }
  CHECK(trunk_at(highest + 0.42, ahead, ahead).value == doctest::Approx(nearest).epsilon(0.02));
}

namespace {

/// Two links that meet at the knee, as a search over where it may be finds it: `ahead` of the line from hip to ankle.
Vector3d knee_by_search(const Vector3d& hip, const Vector3d& ankle, double upper, double lower) {
  double nearest = 1.0;
  Vector3d found = hip;
  for (double angle = 0.0; angle < M_PI; angle += 1e-5) {  // of the shank, in the plane of the leg and x
    const Vector3d knee = ankle + lower * Vector3d(std::cos(angle), 0.0, std::sin(angle));
    const double miss = std::abs((hip - knee).norm() - upper);
    if (miss < nearest && knee.x() > 0.5 * (hip.x() + ankle.x())) nearest = miss, found = knee;
  }
  return found;
}

}  // namespace

TEST_CASE("a thigh or a knee nearer to a solid than its radius is a violation, by as much") {
  // On both feet at x = -0.015, hips above them: the knees are ahead.
  Plan stand = stand_on_wrenches();
  for (int foot : {left_foot, right_foot}) {
    mcplan::LimbLimits& limb = stand.robot.end_effectors[foot].limb;
    limb.hip_B = {-0.015, foot == left_foot ? 0.1 : -0.1, -0.05};
    limb.upper = limb.lower = 0.4;
    limb.ankle = {0.0, 0.0, 0.06};
    limb.radius = 0.05;
  }
  const Vector3d com = stand.knots[0].com_W, hip = com + Vector3d(-0.015, 0.1, -0.05), ankle(-0.015, 0.1, 0.06);
  const Vector3d knee = knee_by_search(hip, ankle, 0.4, 0.4);
  const auto limb_at = [&](double x0, double y0, double y1, double top, double beside = 0.0) {
    Plan plan = stand;
    plan.robot.end_effectors[left_foot].limb.beside = beside;
    mcplan::Surface post = rectangle("post", x0, x0 + 0.3, y0, y1, top);
    post.thickness = 1e-3 + top;
    post.end_effectors = {"hand"};
    plan.scene.surfaces.push_back(post);
    return found(mcplan::check(plan, plan.scene, plan.robot), "limb");
  };
  CHECK(limb_at(knee.x() + 0.06, 0.0, 0.2, 1.0).value == 0.0);
  const mcplan::Violation before = limb_at(knee.x() + 0.02, 0.0, 0.2, 1.0);
  CHECK(before.value == doctest::Approx(0.03).epsilon(0.01));
  CHECK(before.value > before.tolerance);
  CHECK(before.end_effector == "left_foot");
  // Beside the leg, by its width; what is below the middle of the shank is a matter of soles.
  CHECK(limb_at(0.0, 0.18, 0.3, 1.0).value <= 0.0);
  CHECK(limb_at(0.0, 0.18, 0.3, 1.0, 0.05).value == doctest::Approx(0.02).epsilon(0.01));
  CHECK(limb_at(0.0, 0.18, 0.3, 1.0, -0.05).value <= 0.0);
  CHECK(limb_at(knee.x() - 0.02, 0.0, 0.2, 0.15).value == 0.0);
  // A knee that bends backward is not there.
  for (int foot : {left_foot, right_foot}) stand.robot.end_effectors[foot].limb.bends_backward = true;
  CHECK(limb_at(knee.x() + 0.02, 0.0, 0.2, 1.0).value == 0.0);
  for (int foot : {left_foot, right_foot}) {
    stand.robot.end_effectors[foot].limb.bends_backward = false;
    stand.robot.end_effectors[foot].limb.radius = 0.0;
  }
  CHECK(limb_at(knee.x() + 0.02, 0.0, 0.2, 1.0).value == 0.0);
}

TEST_CASE("a straight limb that passes through a solid is a warning with its place and time") {
  constexpr double kFence = 0.11;
  const Plan plan = walk_through_fence(kFence);
  const CheckResult result = mcplan::check(plan, plan.scene, plan.robot);
  // The legs are on both sides of the fence, by more than they bend.
  REQUIRE(result.violations().size() == 1);
  CHECK(result.violations().front().name == "limb");
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
  CHECK(result.to_string().find("\nwarning: limb at " + warning.end_effector + " in phase ") != std::string::npos);
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
