#include "mcplan/online/following.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <utility>

#include "mcplan/base/error.hpp"
#include "mcplan/ddp/plan.hpp"
#include "mcplan/plan/checker.hpp"
#include "scenes.hpp"

using namespace mcplan;
using namespace mcplan::online;
using Eigen::Vector3d;

namespace {

Report reported(Status status, PlanFrom from, double kept_s) {
  Report out;
  out.status = status;
  out.plan_from = from;
  out.kept_until_s = kept_s;
  return out;
}

/// A walk whose right foot has that long [s] to go until it lands, and is raised by so much [m].
Plan landing(double left_s, double height) {
  Plan plan = ddp::plan(scenes::flat(), scenes::humanoid44()).plan;
  for (Swing& swing : plan.swings)
    if (swing.end_effector == 0 && swing.first_phase > 0) {
      const int first = swing.first_phase, end = swing.end_phase;
      plan.phases.erase(plan.phases.begin(), plan.phases.begin() + first);
      plan.knots.erase(plan.knots.begin(), plan.knots.begin() + first);
      plan.swings = {swing};
      plan.swings.front().first_phase = 0;
      plan.swings.front().end_phase = end - first;
      break;
    }
  double whole_s = 0.0;
  for (int k = 0; k < plan.swings.front().end_phase; ++k) whole_s += plan.phases[k].duration;
  for (int k = 0; k < plan.swings.front().end_phase; ++k) plan.phases[k].duration *= left_s / whole_s;
  plan.swings.front().height = height;
  return plan;
}

double fastest_rise(const Plan& plan, double until_s) {
  double out = 0.0;
  for (double t = 0.0; t < until_s; t += 1e-3) out = std::max(out, plan.at(t).end_effectors[0].velocity_W.z());
  return out;
}

}  // namespace

TEST_CASE("plans are followed as their status says") {
  const double period_s = 0.1;
  CHECK(follows(reported(Status::solved, PlanFrom::same_sequence, 0.0), period_s));
  CHECK(follows(reported(Status::acceptable, PlanFrom::other_sequence, 0.0), period_s));
  CHECK_FALSE(follows(reported(Status::solved, PlanFrom::previous_plan, 9.0), period_s));
  CHECK_FALSE(follows(reported(Status::infeasible, PlanFrom::same_sequence, 0.1), period_s));
  CHECK(follows(reported(Status::infeasible, PlanFrom::same_sequence, 0.3), period_s));
  CHECK(follows(reported(Status::time_limit, PlanFrom::same_sequence, 0.3), period_s));
  CHECK_FALSE(follows(reported(Status::time_limit, PlanFrom::previous_plan, 9.0), period_s));
  CHECK_FALSE(follows(reported(Status::no_sequence, PlanFrom::search, 9.0), period_s));
}

TEST_CASE("a foot that is about to land is not kicked up") {
  const Plan kicked = landing(0.05, 0.1), calm = with_feet_kept_up(kicked);
  CHECK(fastest_rise(kicked, 0.05) > 3.0);
  CHECK(fastest_rise(calm, 0.05) < 0.5 + 0.6);
  CHECK(calm.swings.front().height < 0.01);
}

TEST_CASE("a foot that is lifted over an edge is not let down onto it") {
  Plan over = landing(0.2, 0.15);
  Surface edge;
  edge.name = "edge";
  edge.thickness = 0.09;
  const Vector3d middle = over.at(0.1).end_effectors[0].position_W;
  for (const auto& [x, y] : {std::pair{-0.02, -0.2}, {0.02, -0.2}, {0.02, 0.2}, {-0.02, 0.2}})
    edge.vertices_W.push_back({middle.x() + x, middle.y() + y, 0.1});
  over.scene.surfaces.push_back(edge);
  const auto kept_s = [](const Plan& plan) { return check(plan, plan.scene, plan.robot, {}, {}, 0.2).kept_until_s; };
  const double before_s = kept_s(over);
  CHECK(kept_s(with_feet_kept_up(over)) >= before_s);
  over.scene.surfaces.pop_back();
  CHECK(with_feet_kept_up(over).swings.front().height < 0.15);  // without the edge it is
}

TEST_CASE("a foot in the air is raised to half its usual height half way to its landing") {
  const Robot robot = scenes::humanoid44();
  const double usual_s = 0.5 * robot.phase_duration.sum();
  const Plan low = landing(usual_s, 0.0), kept = with_feet_kept_up(low);
  const double landed = kept.at(usual_s).end_effectors[0].position_W.z();
  CHECK(kept.at(0.5 * usual_s).end_effectors[0].position_W.z() - landed ==
        doctest::Approx(0.5 * robot.swing_height).epsilon(0.01));
  CHECK(with_feet_kept_up(kept).swings.front().height == doctest::Approx(kept.swings.front().height));
}

TEST_CASE("swings that begin later, and hands, stay as they are") {
  const Plan plan = ddp::plan(scenes::flat(), scenes::humanoid44()).plan, same = with_feet_kept_up(plan);
  REQUIRE(!plan.swings.empty());
  for (std::size_t i = 0; i < plan.swings.size(); ++i) CHECK(same.swings[i].height == plan.swings[i].height);
}

TEST_CASE("a plan whose sizes or indices do not fit is refused before its feet are looked at") {
  CHECK_THROWS_AS(with_feet_kept_up(Plan{}), InvalidPlan);
  Plan elsewhere = landing(0.05, 0.1);
  elsewhere.swings.front().end_effector = 99;
  CHECK_THROWS_AS(with_feet_kept_up(elsewhere), InvalidPlan);
}
