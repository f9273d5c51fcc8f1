#include "plan/clearance.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <random>

#include "mcplan/base/rotation.hpp"
#include "plan/depths.hpp"
#include "plan/fixtures.hpp"

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace fixtures;
using mcplan::clearance_depth;

std::vector<mcplan::Solid> table() {
  mcplan::Scene scene;
  scene.surfaces = {rectangle("table", 0, 1, 0, 2, 0.5)};
  scene.surfaces[0].thickness = 0.1;
  return mcplan::solids_of(scene);
}

}  // namespace

TEST_CASE("a point is inside the prism below the surface and nowhere else") {
  const auto solids = table();
  CHECK(clearance_depth(solids, {0.5, 1.0, 0.47}) == doctest::Approx(0.03));
  CHECK(clearance_depth(solids, {0.5, 1.0, 0.51}) == 0.0);
  CHECK(clearance_depth(solids, {0.5, 1.0, 0.39}) == 0.0);
  CHECK(clearance_depth(solids, {1.01, 1.0, 0.47}) == 0.0);
  CHECK(clearance_depth(solids, {0.5, -0.01, 0.47}) == 0.0);
}

TEST_CASE("depth turns with the surface") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const auto level = table();
  for (int i = 0; i < 200; ++i) {
    const Matrix3d r = mcplan::rotation_from_rpy({3 * u(random), 1.5 * u(random), 3 * u(random)});
    const Vector3d shift(u(random), u(random), u(random));
    std::vector<Vector3d> vertices;
    for (const Vector3d& v : level[0].polygon.vertices_W()) vertices.push_back(r * v + shift);
    const std::vector<mcplan::Solid> turned{{mcplan::Polygon(vertices), 0.1}};
    const Vector3d point(0.5 + u(random), 1.0 + 1.5 * u(random), 0.45 + 0.1 * u(random));
    CAPTURE(i);
    CHECK(clearance_depth(turned, r * point + shift) == doctest::Approx(clearance_depth(level, point)).epsilon(1e-9));
  }
}

TEST_CASE("the deepest of several solids counts") {
  auto solids = table();
  solids.push_back({mcplan::Polygon(rectangle("higher", 0, 1, 0, 2, 0.55).vertices_W), 0.2});
  CHECK(clearance_depth(solids, {0.5, 1.0, 0.47}) == doctest::Approx(0.08));
}

TEST_CASE("the sole's frame is right-handed, lies on the plane and heads with the base") {
  for (double yaw : {0.0, 0.7, 3.0})
    for (const Vector3d& n :
         {Vector3d(0, 0, 1), Vector3d(0.2, -0.3, 0.9).normalized(), Vector3d(0, 1, 0), Vector3d(-1, 0, 0)}) {
      const Matrix3d frame = mcplan::sole_frame(n, yaw);
      CHECK((frame.transpose() * frame).isIdentity(1e-12));
      CHECK(frame.determinant() == doctest::Approx(1.0));
      CHECK(frame.col(2) == n);
    }
  CHECK(mcplan::sole_frame({0, 0, 1}, 0.7).col(0).isApprox(Vector3d(std::cos(0.7), std::sin(0.7), 0), 1e-12));
  CHECK(mcplan::sole_frame({1, 0, 0}, 0.0).col(0).isApprox(Vector3d(0, 0, 1), 1e-12));
}

TEST_CASE("a sole's corner hits what its middle misses, as far as it is turned there") {
  mcplan::EndEffector foot = biped().end_effectors[left_foot];  // half size 0.10 x 0.05
  const Vector3d beside(1.07, 1.0, 0.48);
  const auto depth = [&](double yaw, bool whole) {
    return clearance_depth(table(), foot, beside, mcplan::sole_frame({0, 0, 1}, yaw), whole);
  };
  CHECK(depth(0.0, true) == doctest::Approx(0.02));
  CHECK(depth(0.0, false) == 0.0);
  CHECK(depth(M_PI / 2, true) == 0.0);
  foot.half_size.setZero();
  CHECK(depth(0.0, true) == 0.0);
}

TEST_CASE("corners count in the middle of a swing only") {
  const mcplan::EndEffector foot = biped().end_effectors[left_foot];
  mcplan::FreeStretch stretch;
  const Vector3d beside(1.07, 1.0, 0.48);
  CHECK(clearance_depth(table(), foot, stretch, 0.05, beside, 0.0) == 0.0);
  CHECK(clearance_depth(table(), foot, stretch, 0.50, beside, 0.0) == doctest::Approx(0.02));
  CHECK(clearance_depth(table(), foot, stretch, 0.95, beside, 0.0) == 0.0);
  CHECK(clearance_depth(table(), foot, stretch, 0.05, {0.5, 1.0, 0.48}, 0.0) == doctest::Approx(0.02));
}

TEST_CASE("a sole lies flat on the slope that it leaves") {
  const double slope = 0.35;
  const Matrix3d r = mcplan::rotation_from_rpy({0, slope, 0});
  mcplan::Scene scene;
  scene.surfaces = {rectangle("slope", -1, 1, -1, 1, 0)};
  for (Vector3d& v : scene.surfaces[0].vertices_W) v = r * v;
  const auto solids = mcplan::solids_of(scene);
  mcplan::FreeStretch stretch;
  stretch.lift_normal_W = stretch.land_normal_W = solids[0].polygon.normal_W();
  const Vector3d one_centimetre_up = 0.01 * stretch.lift_normal_W;
  CHECK(clearance_depth(solids, biped().end_effectors[left_foot], stretch, 0.5, one_centimetre_up, 0.0) == 0.0);
}

TEST_CASE("half way between facing walls the point alone counts") {
  mcplan::FreeStretch stretch;
  stretch.lift_normal_W = Vector3d::UnitX();
  stretch.land_normal_W = -Vector3d::UnitX();
  CHECK(clearance_depth(table(), biped().end_effectors[left_foot], stretch, 0.5, {0.5, 1.0, 0.48}, 0.0) ==
        doctest::Approx(0.02));
}

TEST_CASE("free stretches are read from the contact sequence") {
  const mcplan::Plan plan = walk();
  const auto solids = mcplan::solids_of(plan.scene);
  const auto foot = mcplan::free_stretches(plan, solids, left_foot);
  REQUIRE(foot.size() == 2);
  CHECK(foot[0].first_phase == 3);
  CHECK(foot[0].end_phase == 4);
  CHECK(foot[0].start_s == doctest::Approx(1.2));
  CHECK(foot[0].duration_s == doctest::Approx(0.4));
  const auto hand = mcplan::free_stretches(plan, solids, left_hand);
  REQUIRE(hand.size() == 2);
  CHECK(hand[0].end_phase == 1);
  CHECK(hand[1].first_phase == 2);
  CHECK(hand[1].end_phase == 12);
  CHECK(hand[1].duration_s == doctest::Approx(4.0));
  CHECK(mcplan::free_stretches(plan, solids, right_hand).size() == 1);
}

TEST_CASE("free stretches take the normals of what they leave and reach") {
  mcplan::Plan plan = walk();
  for (Vector3d& v : plan.scene.surfaces[rail].vertices_W) v = Vector3d(v.x(), v.z(), -v.y());  // stood up: a wall
  const auto solids = mcplan::solids_of(plan.scene);
  const Vector3d wall = solids[rail].polygon.normal_W();
  const auto hand = mcplan::free_stretches(plan, solids, left_hand);
  CHECK(hand[0].lift_normal_W == Vector3d::UnitZ());
  CHECK(hand[0].land_normal_W == wall);
  CHECK(hand[1].lift_normal_W == wall);
  CHECK(hand[1].land_normal_W == Vector3d::UnitZ());
}

TEST_CASE("a swing that is high enough clears the block, a low one meets it") {
  mcplan::Plan plan = walk();
  const auto solids = mcplan::solids_of(plan.scene);
  const auto stretch = mcplan::free_stretches(plan, solids, left_foot)[0];
  CHECK(fixtures::deepest(plan, solids, left_foot, stretch, 1e-3) == 0.0);
  plan.swings[0].height = 0.01;
  // Above the middle of the block the path is close to its apex: 0.02 - 0.01.
  CHECK(fixtures::deepest(plan, solids, left_foot, stretch, 1e-3) == doctest::Approx(0.01).epsilon(0.1));
}
