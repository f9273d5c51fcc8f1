#include "mcplan/online/planner.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "mcplan/base/error.hpp"
#include "mcplan/ddp/plan.hpp"
#include "mcplan/online/following.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/robot/robot_files.hpp"
#include "scenes.hpp"

using namespace mcplan;
using namespace mcplan::online;

namespace {

const Plan& walk() {
  static const Plan plan = ddp::plan(scenes::flat(), scenes::humanoid44()).plan;
  return plan;
}

/// The state that a plan has at t, the CoM's velocity off by a push [m/s], at a time of the clock.
MeasuredState state(const Plan& plan, double t, double clock_s, const Eigen::Vector3d& push = {0.0, 0.0, 0.0}) {
  const PlanState now = plan.at(t);
  MeasuredState out;
  out.time_s = clock_s;
  Knot& knot = out.measured.state;
  knot.com_W = now.com_W;
  knot.com_velocity_W = now.com_velocity_W + push;
  knot.base_rpy = now.base_rpy;
  knot.base_rpy_rate = now.base_rpy_rate;
  knot.angular_momentum_W = now.angular_momentum_W;
  for (const EndEffectorState& end : now.end_effectors) {
    knot.end_effectors_W.push_back(end.position_W);
    knot.end_effector_velocities_W.push_back(end.velocity_W);
    knot.end_effector_yaw.push_back(end.yaw);
    out.measured.contacts.push_back(end.surface);
  }
  return out;
}

}  // namespace

TEST_CASE("what is submitted comes back as the plan that replan makes, from the planner's thread") {
  const MeasuredState measured = state(walk(), 1.0, 1.0, {0.0, 0.2, 0.0});
  Planner planner(walk());
  CHECK(!planner.poll());
  const std::uint64_t ticket = planner.submit(measured);
  const std::optional<Update> update = planner.wait();
  REQUIRE(update);
  CHECK(!planner.poll());  // handed out once
  CHECK(!planner.busy());
  const PlanResult expected = ddp::replan(walk(), 1.0, measured.measured, beside_a_controller());
  REQUIRE(update->result);
  CHECK(update->ticket == ticket);
  CHECK(update->usable);
  CHECK(update->begins_s == 1.0);
  CHECK(update->kept_until_s == 1.0 + expected.report.kept_until_s);
  CHECK(update->took_s > 0.0);
  CHECK(update->result->report.status == expected.report.status);
  REQUIRE(update->result->plan.knots.size() == expected.plan.knots.size());
  for (std::size_t k = 0; k < expected.plan.knots.size(); ++k)
    CHECK(update->result->plan.knots[k].com_W == expected.plan.knots[k].com_W);
  CHECK(check(update->result->plan, update->result->plan.scene, walk().robot).ok());
}

TEST_CASE("a plan for a robot that is pushed begins beside it, and the update says how far") {
  MeasuredState measured = state(walk(), 1.0, 1.0);
  measured.push = {{0.2, -0.5}, 0.1};
  Planner planner(walk());
  planner.submit(measured);
  const std::optional<Update> update = planner.wait();
  REQUIRE(update);
  REQUIRE(update->result);
  CHECK(update->com_shift_W.y() < -0.01);
  CHECK(update->result->plan.knots.front().com_W.isApprox(measured.measured.state.com_W + update->com_shift_W, 1e-12));
  measured.push.lasted_s = -1.0;
  planner.submit(measured);
  const std::optional<Update> refused = planner.wait();
  REQUIRE(refused);
  CHECK(refused->error == "push.lasted_s: must be at least 0, got -1");
}

TEST_CASE("a robot that is off the planned height by little goes on from it, but for a margin of zero") {
  const MeasuredState measured = state(walk(), 1.0, 1.0, {0.0, 0.0, -0.05});
  PlannerOptions options;
  for (const double margin : {0.03, 0.0}) {
    options.height_margin_m = margin;
    Planner planner(walk(), 0.0, options);
    planner.submit(measured);
    const std::optional<Update> update = planner.wait();
    REQUIRE(update);
    REQUIRE(update->result);
    const Eigen::Vector3d begin_W = update->result->plan.knots.front().com_velocity_W;
    const Eigen::Vector3d off_W = begin_W - walk().at(1.0).com_velocity_W;
    CHECK(off_W.norm() == doctest::Approx(margin > 0.0 ? 0.0 : 0.05));
  }
}

TEST_CASE("what a landing turns the base by is not in the plan, but for a margin of zero") {
  MeasuredState measured = state(walk(), 1.0, 1.0);
  measured.measured.state.base_rpy_rate.x() += 0.2;
  measured.measured.state.angular_momentum_W.setZero();  // made from the rates
  PlannerOptions options;
  for (const double margin : {0.3, 0.0}) {
    options.turn_margin_rad_s = margin;
    Planner planner(walk(), 0.0, options);
    planner.submit(measured);
    const std::optional<Update> update = planner.wait();
    REQUIRE(update);
    REQUIRE(update->result);
    const Eigen::Vector3d begin = update->result->plan.knots.front().base_rpy_rate;
    const double off_rad_s = (begin - walk().at(1.0).base_rpy_rate).norm();
    CHECK(std::abs(off_rad_s - (margin > 0.0 ? 0.0 : 0.2)) < 1e-9);
  }
}

TEST_CASE("the next plan is made from the one taken over, by the planner's thread") {
  Planner planner(walk(), -0.5);  // the plan began half a second before the clock
  planner.submit(state(walk(), 1.0, 0.5));
  const std::optional<Update> first = planner.wait();
  REQUIRE((first && first->usable));
  planner.take_over(*first);
  CHECK(planner.begins_s() == 0.5);
  CHECK(planner.plan().duration() == first->result->plan.duration());
  planner.submit(state(first->result->plan, 0.2, 0.7));
  const std::optional<Update> second = planner.wait();
  REQUIRE((second && second->usable));
  CHECK(second->begins_s == 0.7);
  CHECK(second->result->plan.duration() == doctest::Approx(walk().duration() - 1.2).epsilon(0.2));
}

TEST_CASE("what the planner's thread keeps of a plan that was solved is not looked at again") {
  ddp::Options longer;
  longer.phases = 26;
  const Plan plan = ddp::plan(scenes::flat(), load_robot("talos"), longer).plan;
  PlannerOptions options;
  options.replan.horizon = 6;
  Planner planner(plan, 0.0, options);
  planner.submit(state(plan, 0.6, 0.6));
  const std::optional<Update> first = planner.wait();
  REQUIRE((first && first->result && first->result->report.status == Status::solved));
  CHECK(first->result->report.checked_until_s == first->result->plan.duration());  // nobody has said what the plan is
  planner.take_over(*first);
  planner.submit(state(first->result->plan, 0.1, 0.7));
  const std::optional<Update> second = planner.wait();
  REQUIRE((second && second->result && second->result->report.status == Status::solved));
  CHECK(second->result->report.checked_until_s < second->result->plan.duration());
  CHECK(check(second->result->plan, plan.scene, plan.robot).ok());
  // What the options say is about the first plan alone.
  options.replan.previous_accepted = true;
  Planner told(plan, 0.0, options);
  told.submit(state(plan, 0.6, 0.6));
  std::optional<Update> update = told.wait();
  REQUIRE((update && update->result));
  CHECK(update->result->report.checked_until_s < update->result->plan.duration());
  update->result->report.status = Status::acceptable;
  told.take_over(*update);
  told.submit(state(update->result->plan, 0.1, 0.7));
  update = told.wait();
  REQUIRE((update && update->result));
  CHECK(update->result->report.checked_until_s == update->result->plan.duration());
}

TEST_CASE("a state that waits for the planner's thread is replaced by a later one") {
  Planner planner(walk());
  std::uint64_t last = 0;
  for (const double t : {0.5, 0.6, 0.7, 0.8}) last = planner.submit(state(walk(), t, t));
  const std::optional<Update> update = planner.wait();
  REQUIRE(update);
  CHECK(update->ticket == last);
  CHECK(update->begins_s == 0.8);
}

TEST_CASE("a state that is refused leaves the plan and the planner's thread alone") {
  MeasuredState bad = state(walk(), 1.0, 1.0);
  bad.measured.state.com_W.x() = std::numeric_limits<double>::quiet_NaN();
  Planner planner(walk());
  planner.submit(bad);
  const std::optional<Update> update = planner.wait();
  REQUIRE(update);
  CHECK(!update->result);
  CHECK(!update->usable);
  CHECK(update->error.find("com_W") != std::string::npos);
  CHECK_THROWS_WITH_AS(planner.take_over(*update), doctest::Contains("must have a plan"), InvalidInput);
  planner.submit(state(walk(), 1.0, 1.0));
  CHECK(planner.wait()->usable);
  CHECK(planner.begins_s() == 0.0);
}

TEST_CASE("commands, scenes and robots hold for the planner's thread from then on") {
  Planner planner(walk());
  planner.set_command(ddp::VelocityCommand{{0.0, 0.0}, 0.0});
  planner.submit(state(walk(), 1.0, 1.0));
  const std::optional<Update> stopped = planner.wait();
  REQUIRE((stopped && stopped->result));
  const Plan& stop = stopped->result->plan;
  CHECK(stop.at(stop.duration()).com_W.x() < walk().at(walk().duration()).com_W.x() - 0.2);
  planner.set_command(std::nullopt);

  Scene nowhere = walk().scene;
  for (Surface& surface : nowhere.surfaces) surface.name += " of another scene";
  planner.set_scene(nowhere);
  planner.submit(state(walk(), 1.0, 1.0));
  CHECK(!planner.wait()->error.empty());
  planner.set_scene(std::nullopt);

  Robot heavy = walk().robot;
  heavy.mass *= 1.1;
  planner.set_robots({heavy});
  planner.submit(state(walk(), 1.0, 1.0));
  const std::optional<Update> heavier = planner.wait();
  REQUIRE((heavier && heavier->result));
  CHECK(heavier->result->plan.robot.mass == heavy.mass);
  planner.take_over(*heavier);
  planner.set_robots({});  // the first plan's own
  planner.submit(state(walk(), 1.0, 1.0));
  CHECK(planner.wait()->result->plan.robot.mass == walk().robot.mass);
}

TEST_CASE("many threads ask one planner, whose destructor waits for no more than an iteration") {
  Planner planner(walk());
  std::thread other([&] {
    for (int i = 0; i < 20; ++i) {
      planner.submit(state(walk(), 1.0, 1.0));
      if (const auto update = planner.poll(); update && update->usable) planner.take_over(*update);
      planner.set_command(std::nullopt);
    }
  });
  for (int i = 0; i < 20; ++i) {
    planner.submit(state(walk(), 0.5, 0.5));
    (void)planner.busy();
    (void)planner.plan();
  }
  other.join();
  CHECK(planner.submit(state(walk(), 1.0, 1.0)) == 41);
}

TEST_CASE("options of a planner are refused by name") {
  PlannerOptions options;
  options.period_s = 0.0;
  CHECK_THROWS_WITH_AS(Planner(walk(), 0.0, options), doctest::Contains("period_s"), InvalidOptions);
  options = {};
  options.height_margin_m = -0.01;
  CHECK_THROWS_WITH_AS(Planner(walk(), 0.0, options), doctest::Contains("height_margin_m"), InvalidOptions);
  options = {};
  options.turn_margin_rad_s = NAN;
  CHECK_THROWS_WITH_AS(Planner(walk(), 0.0, options), doctest::Contains("turn_margin_rad_s"), InvalidOptions);
  options = {};
  options.replan.horizon = -1;
  CHECK_THROWS_WITH_AS(Planner(walk(), 0.0, options), doctest::Contains("horizon"), InvalidOptions);
}

TEST_CASE("broken plans and times are refused, and leave a planner as it was") {
  Plan broken = walk();
  broken.knots.pop_back();
  CHECK_THROWS_AS(Planner{broken}, InvalidPlan);
  CHECK_THROWS_WITH_AS(Planner(walk(), std::numeric_limits<double>::quiet_NaN()), doctest::Contains("begins_s"),
                       InvalidInput);
  Planner planner(walk());
  Update update;
  update.result.emplace();
  update.result->plan = broken;
  update.begins_s = 1.0;
  CHECK_THROWS_AS(planner.take_over(update), InvalidPlan);
  CHECK(planner.begins_s() == 0.0);
}
