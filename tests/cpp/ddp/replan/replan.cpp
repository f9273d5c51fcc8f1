#include "mcplan/ddp/replan.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "ddp/replan/rest.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/ddp/plan.hpp"
#include "mcplan/mcplan.hpp"
#include "mcplan/plan/checker.hpp"
#include "scenes.hpp"

namespace {

using namespace mcplan;
using namespace mcplan::ddp;

const Plan& walk() {
  static const Plan plan = ddp::plan(scenes::flat(), scenes::humanoid44()).plan;
  return plan;
}

Measured pushed_at(double t, const Eigen::Vector3d& velocity) {
  Measured out;
  out.state = rest_of(walk(), t).plan.knots.front();
  out.state.com_velocity_W += velocity;
  return out;
}

/// A clock that goes on by so much at every look: the deadline falls at the same instruction everywhere.
Clock ticking(double tick_s) {
  return [now_s = 0.0, tick_s]() mutable { return now_s += tick_s; };
}

/// On from the planned state with a push, and what is told of the trials.
PlanResult told_replan(const Plan& plan, double t, const Eigen::Vector3d& push_m_s, std::vector<std::string>& trials) {
  ReplanOptions options;
  options.search.logger = [&](LogLevel, const std::string& line) {
    if (line.rfind("replan, ", 0) == 0) trials.push_back(line);
  };
  Measured measured{rest_of(plan, t).plan.knots.front(), {}};
  measured.state.com_velocity_W += push_m_s;
  return ddp::replan(plan, t, measured, options);
}

}  // namespace

TEST_CASE("a replan is what the checker accepts, and begins at the measured state") {
  for (const double t : {0.5, 1.2, 2.4, 4.0}) {
    CAPTURE(t);
    const Measured measured = pushed_at(t, {0.05, 0.05, 0.0});
    const PlanResult result = ddp::replan(walk(), t, measured);
    INFO(result.report.message);
    CHECK(result.report.status == Status::solved);
    CHECK(check(result.plan, result.plan.scene, result.plan.robot).ok());
    CHECK(result.report.kept_until_s == result.plan.duration());
    CHECK((result.plan.at(0.0).com_velocity_W - measured.state.com_velocity_W).norm() < 1e-9);
    CHECK(result.plan.measured_start);
  }
}

TEST_CASE("feet in the air go on as they were planned, whichever replan of a swing it is") {
  int in_air = 0;
  double begin = 0.0;
  for (const Phase& phase : walk().phases) {
    for (const int e : {0, 1}) {
      if (phase.contacts[e].surface >= 0) continue;
      for (const double ratio : {0.25, 0.5, 0.75}) {
        const double t = begin + ratio * phase.duration;
        CAPTURE(t);
        const PlanResult first = ddp::replan(walk(), t, pushed_at(t, Eigen::Vector3d::Zero()));
        Measured measured;
        measured.state = rest_of(first.plan, 0.03).plan.knots.front();
        const PlanResult second = ddp::replan(first.plan, 0.03, measured);
        for (const auto& [plan, later] : {std::pair{&first.plan, 0.0}, std::pair{&second.plan, 0.03}}) {
          double elapsed_s = 0.0;
          for (const Swing& swing : plan->swings)
            if (swing.end_effector == e && swing.first_phase == 0) elapsed_s = swing.elapsed_s;
          CHECK(elapsed_s == doctest::Approx(t + later - begin).epsilon(0.02));
          // A replan may touch down at another time, and is then as high as that asks for.
          const double left_s = plan->phases.front().duration;
          if (std::abs(t + later + left_s - (begin + phase.duration)) > 0.003) continue;
          for (double s = 0.0; s < left_s; s += 0.01) {
            const Eigen::Vector3d planned = walk().at(t + later + s).end_effectors[e].position_W;
            CHECK(std::abs(plan->at(s).end_effectors[e].position_W.z() - planned.z()) < 0.003);
            ++in_air;
          }
        }
      }
    }
    begin += phase.duration;
  }
  CHECK(in_air > 50);
}

TEST_CASE("a phase under way ends when it was to, replan after replan, though a turn asks for longer ones") {
  ReplanOptions options;
  options.command = VelocityCommand{{0.1, 0.0}, 0.39};
  Plan plan = walk();
  double t = 1.0, walked_s = 0.0;
  int looked_at = 0;
  for (int i = 0; i < 30; ++i) {
    Measured measured;
    measured.state = rest_of(plan, t).plan.knots.front();
    const double left_s = plan.knot_times()[plan.at(t).phase + 1] - t;
    const PlanResult result = ddp::replan(plan, t, measured, options);
    CAPTURE(i);
    CHECK(result.report.status == Status::solved);
    if (left_s > options.committed_s) {  // what is nearer is held by a bound
      CHECK(result.plan.phases.front().duration < left_s + 0.01);
      ++looked_at;
    }
    plan = result.plan;
    t = 0.1;
    walked_s += t;
  }
  CHECK(looked_at > 10);
  // It begins to turn with the next step, within a stride.
  CHECK(plan.at(t).base_rpy.z() > 0.39 * (walked_s - 1.0));
}

TEST_CASE("whenever the time is up there is a plan whose next two steps keep all limits, or is said to be none") {
  int from_previous = 0, cut_short = 0;
  for (const double tick_s : {1e-6, 3e-5, 1e-4, 2e-4, 4e-4, 1e-3, 1e-2}) {
    CAPTURE(tick_s);
    ReplanOptions options;
    options.search.time_limit_s = 0.02;
    options.search.clock = ticking(tick_s);
    const PlanResult result = ddp::replan(walk(), 1.2, pushed_at(1.2, {0.02, 0.02, 0.0}), options);
    REQUIRE(!result.plan.phases.empty());
    INFO(result.report.message);
    if (result.report.status == Status::solved) continue;
    CHECK(result.report.status == Status::time_limit);
    ++cut_short;
    from_previous += result.report.plan_from == PlanFrom::previous_plan;
    const CheckResult again =
        check(result.plan, result.plan.scene, result.plan.robot, {}, {}, result.report.kept_until_s);
    CHECK(again.ok());
    CHECK(result.report.kept_until_s > 0.5);
  }
  CHECK(cut_short > 0);
  CHECK(from_previous > 0);
}

TEST_CASE("a caller that stops a replan gets the best so far") {
  ReplanOptions options;
  int asked = 0;
  options.search.stop = [&] { return ++asked > 0; };
  const PlanResult result = ddp::replan(walk(), 1.2, pushed_at(1.2, {0.2, 0.25, 0.0}), options);
  CHECK(result.report.status == Status::interrupted);
  CHECK(asked <= 2);
}

TEST_CASE("what is wrong with a replan is named") {
  Measured measured = pushed_at(1.0, {0.0, 0.0, 0.0});
  measured.contacts = {0, 0};
  CHECK_THROWS_AS(ddp::replan(walk(), 1.0, measured), InvalidPlan);
  measured.contacts = {0, 0, -1, 9};
  CHECK_THROWS_AS(ddp::replan(walk(), 1.0, measured), InvalidPlan);
  measured.contacts.clear();
  ReplanOptions options;
  options.committed_s = -1.0;
  CHECK_THROWS_AS(ddp::replan(walk(), 1.0, measured, options), InvalidOptions);
  Scene renamed = walk().scene;
  renamed.surfaces.front().name = "other";
  for (Stance* stance : {&renamed.start, &renamed.goal})
    for (auto& [who, surface] : stance->contacts) surface = "other";
  CHECK_THROWS_AS(ddp::replan(walk(), 1.0, measured, renamed, walk().robot), InvalidScene);
}

TEST_CASE("a plan that misses a limit by little between its instants may be brought within it") {
  const Plan plan = ddp::plan(load_scene("gap_with_rail"), load_robot("humanoid44")).plan;
  int brought = 0;
  for (const double t : {2.65, 2.67, 2.69, 2.71, 2.73}) {
    CAPTURE(t);
    std::vector<std::string> lines;
    const PlanResult result = told_replan(plan, t, {0.15, 0.15, 0.0}, lines);
    INFO(result.report.message);
    REQUIRE(!lines.empty());
    if (lines.size() != 2 || lines.front().find("reach") == std::string::npos) continue;
    CHECK(lines.front().find("over the limit") != std::string::npos);
    CHECK(result.report.plan_from == PlanFrom::same_sequence);
    const bool accepted = lines.back().find("accepted") != std::string::npos;
    CHECK(check(result.plan, plan.scene, plan.robot).ok() == accepted);
    if (accepted) ++brought;
  }
  CHECK(brought >= 1);
}

TEST_CASE("the length of legs is known: steps at the corners of reach boxes are accepted at once") {
  const Plan plan = ddp::plan(load_scene("stepping_stones"), load_robot("g1")).plan;
  for (const double t : {0.1, 0.5, 1.0, 2.0}) {
    CAPTURE(t);
    std::vector<std::string> lines;
    const PlanResult result = told_replan(plan, t, {0.0, 0.0, 0.0}, lines);
    INFO(result.report.message);
    CHECK(lines.size() == 1);
    CHECK(result.report.plan_from == PlanFrom::same_sequence);
    CHECK(check(result.plan, plan.scene, plan.robot).ok());
  }
}
