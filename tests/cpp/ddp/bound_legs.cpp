#include <doctest/doctest.h>

#include "ddp/impossible.hpp"
#include "mcplan/ddp/plan.hpp"
#include "mcplan/mcplan.hpp"
#include "support.hpp"

namespace {

using namespace mcplan;
using mcplan::ddp::leg_in_solid;

/// A post of 2 cm beside the left leg of a robot at x, from the floor to 0.8 m; at y it stands in or beside its shank.
Scene with_post(double x, double y) {
  Scene scene =
      scenes::made_of("post", {scenes::rectangle("floor", -1, 4, -2, 2, 0, "foot")}, "floor", "floor", {1.5, 0.0, 0.0});
  Surface post = scenes::rectangle("post", x - 0.01, x + 0.01, y - 0.01, y + 0.01, 0.8, "hand");
  post.thickness = 0.79;
  scene.surfaces.push_back(post);
  return scene;
}

}  // namespace

TEST_CASE("legs that stand in a solid at start or goal are told as deep as the checker finds them") {
  const Robot robot = load_robot("talos");
  for (const double x : {0.0, 1.5}) {
    const bool at_goal = x > 0.0;
    for (const double y : {0.16, 0.19, 0.24}) {
      CAPTURE(y);
      const Scene scene = with_post(x, y);
      const auto found = leg_in_solid(scene, robot, at_goal, 1.0);
      CHECK(!leg_in_solid(scene, robot, !at_goal, 1.0));
      // A robot that stands there all the time, looked at by the checker.
      Plan stand = ddp::plan(scenes::flat(), robot).plan;
      const ResolvedStance at = resolve_stance(scene, robot, at_goal ? scene.goal : scene.start, "stance");
      stand.scene = scene;
      stand.scene.surfaces[0].name = stand.scene.start.contacts.at("foot");
      for (Knot& knot : stand.knots) {
        knot.com_W = at.com_W;
        knot.end_effectors_W = at.end_effectors_W;
        knot.base_rpy = at.base_rpy;
      }
      double worst = 0.0;
      for (const Violation& v : check(stand, scene, robot, {}, {}, 1e-3).constraints)
        if (v.name == "limb" && v.value > 0.0) worst = v.value;
      REQUIRE(bool(found) == (worst > Tolerances().clearance));
      if (found) CHECK(found->violation.value == doctest::Approx(worst).epsilon(1e-6));
      if (found) CHECK(found->violation.surface == "post");
    }
  }
}

TEST_CASE("a start in which a leg is deep in a solid is refused at once, a goal is named when no plan is found") {
  const Robot robot = load_robot("talos");
  const PlanResult start = ddp::plan(with_post(0.0, 0.217), robot);
  CHECK(start.report.status == Status::infeasible);
  CHECK(start.report.iterations == 0);
  CHECK(start.report.message.rfind("start: the leg of left_foot would be ", 0) == 0);
  CHECK(start.report.worst_violation.name == "limb");
  ddp::Options options;
  options.max_iterations = 30;
  const PlanResult goal = ddp::plan(with_post(1.5, 0.18), robot, options);
  REQUIRE(goal.report.status != Status::solved);
  CHECK(goal.report.message.find("goal: the leg of left_foot would be ") != std::string::npos);
}
