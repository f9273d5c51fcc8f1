#include "rhp/walker.hpp"

#include <doctest/doctest.h>

#include <functional>

#include "mcplan/base/error.hpp"
#include "rhp/walkers.hpp"

namespace mcplan::rhp::tests {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using walkers::field_of;
using walkers::Random;

Walker walker_on(const Scene& scene) { return {scene, walkers::robot(), walkers::quick()}; }

/// By how much the worst corner of a sole is over an edge, from the vertices.
double overhang(const Walker& walker, int surface, const Vector3d& centre) {
  const auto& v = walker.scene.surfaces[surface].vertices_W;
  const Eigen::Matrix3d frame = walker.frame_W(surface);
  double worst = -1e9;
  for (double s1 : {1.0, -1.0})
    for (double s2 : {1.0, -1.0})
      for (std::size_t j = 0; j < v.size(); ++j) {
        const Vector3d corner = centre + 0.11 * s1 * frame.col(0) + 0.06 * s2 * frame.col(1);
        const Vector3d edge = (v[(j + 1) % v.size()] - v[j]).normalized();
        worst = std::max(worst, -edge.cross(corner - v[j]).dot(frame.col(2)));
      }
  return worst;
}

}  // namespace

TEST_CASE("steps go on in turn on the last surface, unless the sequence end_effectors") {
  const Footsteps steps({{0, 3}, {1, 4}, {0, 7}}, false);
  CHECK_FALSE(steps.ends());
  for (int i = 3; i < 9; ++i) {
    CHECK(steps[i].foot == i % 2);
    CHECK(steps[i].surface == 7);
  }
  CHECK(steps[1].surface == 4);
}

TEST_CASE("the frame of a foot has the heading for its first axis, projected on the surface") {
  const double yaw = 0.8;
  const Walker walker = walker_on(walkers::moved(walkers::uneven(), yaw, {1.0, 2.0, 3.0}));
  const Vector3d heading(std::cos(yaw), std::sin(yaw), 0.0);
  for (std::size_t i = 0; i < walker.surfaces.size(); ++i) {
    const Eigen::Matrix3d frame = walker.frame_W(static_cast<int>(i));
    const auto& v = walker.scene.surfaces[i].vertices_W;
    const Vector3d normal = (v[1] - v[0]).cross(v[2] - v[0]).normalized();
    CHECK((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm() < 1e-12);
    CHECK(frame.determinant() == doctest::Approx(1.0));
    CHECK((frame.col(2) - normal).norm() < 1e-12);
    CHECK(std::abs(heading.cross(normal).dot(frame.col(0))) < 1e-12);  // in the plane of heading and normal
    CHECK(frame.col(0).dot(heading) > 0.0);
  }
}

TEST_CASE("on a wall square to the heading a foot's first axis goes up") {
  Scene scene = walkers::uneven();
  scene.surfaces[1].vertices_W = {{1, -1, 0}, {1, -1, 1}, {1, 1, 1}, {1, 1, 0}};  // normal -x
  const Eigen::Matrix3d frame = walker_on(scene).frame_W(1);
  CHECK((frame.col(0) - Vector3d::UnitZ()).norm() < 1e-12);
}

TEST_CASE("a foothold near any point has the whole sole and a margin on its surface, and stays where it fits already") {
  const Walker walker = walker_on(walkers::moved(walkers::uneven(), 0.3, {0.0, 0.0, 1.0}));
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const int surface = 1 + trial % 4;
    const Vector3d desired = walker.surfaces[surface].centroid_W() + random.three();
    const Vector3d foothold = walker.nearest_foothold_W(0, surface, desired);
    CHECK(overhang(walker, surface, foothold) < -walker.options.foothold_margin_m + 1e-6);
    CHECK(std::abs(walker.surfaces[surface].height(foothold)) < 1e-12);
    CHECK((walker.nearest_foothold_W(0, surface, foothold) - foothold).norm() < 1e-6);
  }
}

TEST_CASE("reach is turned with the heading, faces that cannot matter are gone unless all are desired") {
  Options options = walkers::quick();
  options.all_faces = true;
  const double yaw = 1.1;
  const Walker all(walkers::moved(walkers::uneven(), yaw, Vector3d::Zero()), walkers::robot(), options);
  options.all_faces = false;
  const Walker fewer(walkers::moved(walkers::uneven(), yaw, Vector3d::Zero()), walkers::robot(), options);
  const Eigen::AngleAxisd R(yaw, Vector3d::UnitZ());
  Random random(2);
  int in = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const double height = random.in(fewer.com_height_m.min, fewer.com_height_m.max);
    const Vector3d com(random.in(-1.0, 1.0), random.in(-0.6, 0.2), height);
    const Polytope given = walkers::com_over_left();
    const bool inside = (given.A * com - given.b).maxCoeff() <= 0.0;
    in += inside;
    for (const Walker* walker : {&all, &fewer}) {
      const Polytope& reach = walker->feet[walkers::left].com_reach_W;
      CHECK(((reach.A * (R * com) - reach.b).maxCoeff() <= 1e-12) == inside);
    }
  }
  CHECK(in > 300);
  CHECK(all.feet[0].com_reach_W.A.rows() == walkers::com_over_left().A.rows());
  CHECK(fewer.feet[0].com_reach_W.A.rows() < all.feet[0].com_reach_W.A.rows());
}

TEST_CASE("a scene's steps and a plan's touch-downs are the same sequence") {
  Options options = walkers::quick();
  options.cycles = 2;
  const Walk walk = RecedingHorizon(walkers::uneven(), walkers::robot(), options).walk();
  REQUIRE(walk.success);
  const Walker walker = walker_on(walkers::uneven());
  const Footsteps listed = footsteps_of(walker), found = footsteps_of(walker, walk.plan);
  CHECK(found.ends());
  REQUIRE(found.count() == 2);
  for (int i = 0; i < 2; ++i) {
    CHECK(found[i].foot == listed[i].foot);
    CHECK(found[i].surface == listed[i].surface);
  }
  const State start = start_of(walker, walk.plan), expected = walker.start();
  CHECK(start.com_W == expected.com_W);
  CHECK(start.feet_W == expected.feet_W);
  CHECK(start.surfaces == expected.surfaces);
}

TEST_CASE("sequences that no walk on two feet has are refused") {
  Options options = walkers::quick();
  options.cycles = 1;
  const Plan plan = RecedingHorizon(walkers::uneven(), walkers::robot(), options).walk().plan;
  REQUIRE(plan.phases.size() == 3);
  const Walker walker = walker_on(walkers::uneven());
  const auto field = [&](const std::function<void(Plan&)>& spoil) {
    Plan spoilt = plan;
    spoil(spoilt);
    return field_of<InvalidPlan>([&] { footsteps_of(walker, spoilt); });
  };
  CHECK(field([](Plan& p) { p.phases[1].contacts[walkers::right] = {}; }) == "phases[1]");
  CHECK(field([](Plan& p) { p.scene.surfaces[0].name = "elsewhere"; }) == "scene.surfaces");
  CHECK(field([](Plan& p) { p.robot.end_effectors[0].name = "paw"; }) == "robot.end_effectors");
  CHECK(field([](Plan& p) {
          p.phases.resize(1);
          p.knots.resize(2);
          p.swings.clear();
          p.final_contacts = {0, 0};
        }) == "phases");
}

TEST_CASE("a start on one foot is refused") {
  Scene scene = walkers::uneven();
  scene.start.contacts = {{"right_foot", "start"}};
  const Walker walker = walker_on(scene);
  CHECK(field_of<InvalidScene>([&] { walker.start(); }) == "start.contacts");
}

}  // namespace mcplan::rhp::tests
