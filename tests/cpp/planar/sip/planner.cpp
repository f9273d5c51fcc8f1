#include "mcplan/planar/sip/planner.hpp"

#include <doctest/doctest.h>
#include <omp.h>

#include <cmath>
#include <functional>

#include "clocks.hpp"
#include "in_threads.hpp"
#include "interval.hpp"
#include "mcplan/planar/sip/certificate.hpp"
#include "planar/robots.hpp"
#include "slow_build.hpp"
#include "tasks.hpp"

using namespace mcplan::sip;
using mcplan::PlanarPlan;
using mcplan::PlanarTask;
using mcplan::Status;

namespace {

Options without_cost(Forces forces = Forces::per_point) {
  Options options;
  options.forces = forces;
  options.torque_weight = 0.0;
  return options;
}

/// The small robot on both feet, without clearances and poses.
PlanarTask standing(int phases, int intervals) {
  PlanarTask task = planar::standing();
  task.phases.resize(phases);
  for (auto& phase : task.phases) {
    phase.intervals = intervals;
    phase.clearances.clear();
    phase.poses.clear();
  }
  return task;
}

PlanarTask moved(PlanarTask task, const Eigen::Vector2d& by_W) {
  for (auto& surface : task.surfaces) surface.origin_W += by_W;
  for (auto& phase : task.phases)
    for (auto& contact : phase.contacts) contact.position_W += by_W;
  return task;
}

/// A feasible cartwheel, found once for all tests.
const Result& feasible_cartwheel() {
  static const Result result = Planner(planar_tasks::cartwheel(), without_cost()).solve();
  return result;
}

/// The field that the planner refuses, before it solves anything.
std::string field(const PlanarTask& task, const Options& options = {}) {
  try {
    Planner planner(task, options);
  } catch (const mcplan::InvalidInput& error) {
    return error.field();
  }
  return "accepted";
}

/// One contact of one point: no force there balances a moment.
PlanarTask on_a_point() {
  PlanarTask task = standing(2, 4);
  task.robot.end_effectors[planar::left_foot].points = {0.0};
  task.phases[1].contacts.pop_back();
  return task;
}

}  // namespace

TEST_CASE("a solved motion passes the checker, and the report says what was solved") {
  const Result& result = feasible_cartwheel();
  REQUIRE(result.report.status == Status::solved);
  CHECK(check(result.plan).ok());
  CHECK(result.plan.planner == "sip");
  CHECK(result.parameters == 91);
  Planner planner(planar_tasks::cartwheel(), without_cost());
  CHECK(planner.parameters() == 91);
  CHECK(planner.constraints() == result.constraints);
  const mcplan::Drift drift = largest_drift(result.plan);
  CHECK(result.drift_m == drift.position_m);
  CHECK(result.drift_rad == drift.angle_rad);
  CHECK(drift.position_m <= std::sqrt(2.0) * 1e-3);  // of both components of the tube
  CHECK(drift.angle_rad <= 5e-3);
  CHECK(result.report.cost_terms.at("duration") == doctest::Approx(result.plan.duration()));
  CHECK(result.report.iterations > 0);
  for (const char* part : {"evaluation", "linear_solver", "check"}) CHECK(result.report.timing_s.count(part) == 1);
  CHECK(!result.report.version.empty());
}

TEST_CASE(
    "a limb that climbs stays out of slope and wall, of which the task says nothing, unless it is let into them") {
  PlanarTask task = planar_tasks::climbing();
  task.phases = {task.phases[4], task.phases[5], task.phases[6]};  // limb C goes up the wall
  task.phases[0].intervals = task.phases[2].intervals = 3;
  const auto deepest = [](const PlanarPlan& plan) {
    double out = -INFINITY;
    for (const mcplan::SolidDepth& depth : solid_depths(plan)) out = std::max(out, depth.depth_m);
    return out;
  };
  const Result outside = Planner(task, without_cost()).solve();
  CHECK(outside.report.status == Status::solved);
  CHECK(deepest(outside.plan) < mcplan::PlanarTolerances().clearance);
  CHECK(certify(outside.plan).proved());

  PlanarTask allowed = task;
  allowed.no_clearance = {{2, 0}, {2, 1}};
  const Result let_in = Planner(allowed, without_cost()).solve();
  CHECK(let_in.report.status == Status::solved);
  CHECK(certify(let_in.plan).proved());
  if (kSlowBuild) return;

  Options without = without_cost();
  without.clearance = false;
  const Result inside = Planner(task, without).solve();
  CHECK(inside.report.status == Status::solved);  // nothing was asked of it
  REQUIRE(deepest(inside.plan) > 0.01);
  REQUIRE(check(inside.plan).violations().size() == 1);
  CHECK(check(inside.plan).worst().name == "clearance");
  CHECK_FALSE(certify(inside.plan).proved());
  CHECK(let_in.plan.control_points == inside.plan.control_points);
}

TEST_CASE("the reported torque integral is that of exact torques") {
  const PlanarPlan& plan = feasible_cartwheel().plan;
  constexpr int kPieces = 500;  // of each phase
  double sum = 0.0;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i <= 2 * kPieces; ++i) {
      const double ratio = i == 0 || i == 2 * kPieces ? 1.0
                           : i % 2 == 1               ? 4.0
                                                      : 2.0,
                   step = plan.durations[k] / kPieces;
      sum += ratio * step / 6.0 * plan.at_phase(k, 0.5 * i * step).torque.squaredNorm();
    }
  CHECK(feasible_cartwheel().report.cost_terms.at("torque") == doctest::Approx(sum).epsilon(1e-3));
}

TEST_CASE("a cost that is warm-started stays feasible and does not rise, however early it is stopped") {
  const PlanarPlan& start = feasible_cartwheel().plan;
  const double begin = feasible_cartwheel().report.cost_terms.at("torque");
  Options options;
  options.hessian = HessianChoice::exact;
  for (int iterations : {1, 4, 15}) {
    options.max_iterations = iterations;
    const Result result = Planner(planar_tasks::cartwheel(), options).solve(start);
    CAPTURE(iterations);
    CHECK(result.report.status == Status::iteration_limit);
    CHECK(result.report.iterations <= iterations);
    CHECK(check(result.plan).ok());
    CHECK(result.report.cost <= begin * (1.0 + 1e-9));
  }
}

TEST_CASE("a time limit ends a solve in time, with the best that was found") {
  Options options = without_cost();
  options.time_limit_s = 0.2;
  options.clock = CountingClock(0.01);  // some looks an iteration
  const Result result = Planner(planar_tasks::climbing(), options).solve();
  CHECK(result.report.status == Status::time_limit);
  CHECK(result.report.message.find("time_limit_s") != std::string::npos);
  CHECK(result.plan.durations.size() == 9);
  result.plan.validate();
  CHECK(result.report.worst_violation.value > result.report.worst_violation.tolerance);  // said, not hidden
}

TEST_CASE("what a limit that is over at once costs does not grow with the motion") {
  double looks_s = 0.0;
  for (const PlanarTask& task : {standing(1, 4), planar_tasks::cartwheel(), planar_tasks::climbing()}) {
    Options options;
    options.time_limit_s = 1e-6;
    options.clock = CountingClock(1.0);
    const Result result = Planner(task, options).solve();
    CHECK(result.report.status == Status::time_limit);
    CHECK(result.report.iterations == 0);
    CHECK_NOTHROW(result.plan.validate());
    CHECK(result.report.cost_terms.count("torque") == 1);
    if (looks_s > 0.0) CHECK(result.report.time_s == looks_s);  // of all intervals or none
    looks_s = result.report.time_s;
  }
}

TEST_CASE("no program is begun whose first point would come after the limit, the first one of a solve included") {
  // Its 55,308 derivatives take 38 ms by what was measured; a solver that was begun would iterate until the limit.
  Options options = without_cost();
  for (const bool in_time : {false, true}) {
    options.time_limit_s = in_time ? 0.06 : 0.03;
    options.clock = CountingClock(1e-6);
    const Result result = Planner(planar_tasks::climbing(), options).solve();
    CHECK(result.report.status == Status::time_limit);
    CHECK((result.report.iterations > 0) == in_time);
    CHECK_NOTHROW(result.plan.validate());
  }
}

TEST_CASE("the last check is kept from the limit, by what a check took") {
  // A check of the start at every 16th instant takes a look at the clock, and so do the values of all intervals: what
  // is kept are six of those, and as many looks as a check of all instants has more of them.
  const PlanarTask task = planar_tasks::climbing();
  const auto instants = [&](double duration_s, double sample_s) {
    return duration_s / sample_s + 2.0 * task.interval_count();
  };
  Options options = without_cost();
  double shortest_s = 0.0;
  for (const auto& phase : task.phases) shortest_s += std::max(options.phase_duration_s.min, phase.min_duration);
  constexpr double kTick_s = 0.01;
  options.clock = CountingClock(kTick_s);
  options.time_limit_s = 1e-6;
  const double of_start = instants(Planner(task, options).solve().plan.duration(), 0.016);
  for (double limit_s : {2.0, 4.0, 8.0}) {
    CAPTURE(limit_s);
    options.time_limit_s = limit_s;
    const Result result = Planner(task, options).solve();
    REQUIRE(result.report.status == Status::time_limit);
    // At least; how long the best motion is is asked once an iteration.
    const double kept_s = kTick_s * (6.0 + instants(shortest_s, 0.001) / of_start);
    // After that: looks of the evaluation that is stopped (3), of the solver (1), around the check and at the end (3).
    CHECK(result.report.time_s <= limit_s - std::min(kept_s, 0.5 * limit_s) + 7.0 * kTick_s);
  }
}

TEST_CASE("an iteration limit and a stop request have statuses of their own") {
  Options options = without_cost();
  options.max_iterations = 2;
  CHECK(Planner(planar_tasks::cartwheel(), options).solve().report.status == Status::iteration_limit);
  options = Options();
  int polled = 0;
  options.stop = [&polled] { return ++polled > 3; };
  const Result result = Planner(planar_tasks::cartwheel(), options).solve();
  CHECK(result.report.status == Status::interrupted);
  CHECK(polled < 20);  // no second attempt after a request to stop
}

TEST_CASE("a pose out of reach ends without a solution, and the pose is what is violated") {
  PlanarTask task = standing(1, 4);
  mcplan::PlanarPose pose;
  pose.fraction = 0.5;
  pose.min.y() = 5.0;  // the trunk, five metres up, with both feet on the ground
  task.phases[0].poses = {pose};
  Options options = without_cost();
  options.max_iterations = 100;
  const Result result = Planner(task, options).solve();
  CHECK((result.report.status == Status::infeasible || result.report.status == Status::iteration_limit));
  CHECK(result.report.worst_violation.name == "pose");
  CHECK(result.report.message.find("pose") != std::string::npos);
}

TEST_CASE("torque limits that cannot carry the weight end without a solution") {
  PlanarTask task = planar_tasks::cartwheel();
  for (auto& body : task.robot.bodies) body.torque_max *= 0.05;
  Options options = without_cost();
  options.max_iterations = kSlowBuild ? 10 : 40;
  const Result result = Planner(task, options).solve();
  CHECK((result.report.status == Status::infeasible || result.report.status == Status::iteration_limit));
  CHECK(!check(result.plan).ok());
}

TEST_CASE("the same problem gives the same bytes, twice and with any number of threads") {
  const int before = omp_get_max_threads();
  for (int threads : {1, 2}) {
    omp_set_num_threads(threads);
    const Result again = Planner(planar_tasks::cartwheel(), without_cost()).solve();
    CHECK(again.plan.control_points == feasible_cartwheel().plan.control_points);
    CHECK(again.plan.durations == feasible_cartwheel().plan.durations);
    CHECK(again.plan.weights == feasible_cartwheel().plan.weights);
  }
  omp_set_num_threads(before);
}

TEST_CASE("planners and proofs in several threads give what one alone gives") {
  const PlanarTask task = standing(1, 4);  // shared, as a user's would be
  const auto planned = [&](int t) {
    const PlanarPlan plan = Planner(task, without_cost(t % 2 ? Forces::per_point : Forces::parameters)).solve().plan;
    CertifyOptions options;
    options.max_depth = 3;
    std::vector<double> out(plan.control_points.data(), plan.control_points.data() + plan.control_points.size());
    for (const ProvedConstraint& c : certify(plan, options).constraints) out.push_back(c.bound);
    return out;
  };
  const auto together = in_threads(4, planned);
  for (int t = 0; t < 4; ++t) CHECK(together[t] == planned(t % 2));
}

TEST_CASE("a planner may be asked twice") {
  Planner planner(standing(1, 4));
  const Result first = planner.solve(), second = planner.solve();
  CHECK(first.plan.control_points == second.plan.control_points);
  CHECK(first.report.iterations == second.report.iterations);
}

TEST_CASE("a task that is moved as a whole has the same solution") {
  if (kSlowBuild) return;  // the code of other solves with a cost, on other numbers
  const Result here = Planner(planar_tasks::cartwheel()).solve();
  const Result there = Planner(moved(planar_tasks::cartwheel(), {100.0, 3.0})).solve();
  REQUIRE(here.report.status == Status::solved);
  REQUIRE(there.report.status == Status::solved);
  CHECK(there.report.cost == doctest::Approx(here.report.cost).epsilon(1e-3));
  for (int k = 0; k < 3; ++k) CHECK(there.plan.durations[k] == doctest::Approx(here.plan.durations[k]).epsilon(1e-2));
  const auto a = here.plan.at(0.5), b = there.plan.at(0.5);
  CHECK((b.configuration.base - a.configuration.base - Eigen::Vector3d(100.0, 3.0, 0.0)).norm() < 1e-2);
}

TEST_CASE("small and odd tasks are solved") {
  const auto status = [](const PlanarTask& task, const Options& options = {}) {
    const Result result = Planner(task, options).solve();
    CHECK(result.plan.control_points.allFinite());
    return result.report.status;
  };
  CHECK(status(standing(1, 2)) == Status::solved);  // one phase, one posture
  CHECK(status(standing(2, 1)) == Status::solved);  // the same contacts twice, an interval each

  PlanarTask one_joint = standing(1, 4);
  one_joint.robot.bodies.resize(2);
  one_joint.robot.collision_pairs.clear();
  one_joint.robot.end_effectors = {{"seat", 0, {0.0, 0.0}, 0.0, {-0.1, 0.1}}};
  one_joint.phases[0].contacts = {{0, 0, {0.0, 0.0}, 0.0}};
  CHECK(status(one_joint) == Status::solved);

  PlanarTask points = standing(2, 4);  // two contacts of a point each: that balances a moment
  for (auto& end : points.robot.end_effectors) end.points = {0.0};
  CHECK(status(points) == Status::solved);

  PlanarTask three = standing(1, 4);  // three contacts of a point each
  mcplan::PlanarSurface table;
  table.name = "table";
  table.origin_W = {0.0, planar::hip_height() + 0.2};
  three.surfaces.push_back(table);
  for (auto& end : three.robot.end_effectors) end.points = {0.0};
  three.phases[0].contacts.push_back({planar::hand, 1, table.origin_W, 0.0});
  CHECK(status(three) == Status::solved);

  PlanarTask free = standing(1, 4);  // no limits of joints: no rows for them
  for (auto& body : free.robot.bodies) {
    body.position_min = -INFINITY;
    body.position_max = INFINITY;
    body.velocity_max = body.torque_max = INFINITY;
  }
  CHECK(Planner(free).constraints() < Planner(standing(1, 4)).constraints());
  CHECK(status(free) == Status::solved);

  Options kinematic = without_cost();
  kinematic.dynamics = false;
  CHECK(status(planar_tasks::walking(), kinematic) == Status::solved);
}

TEST_CASE("tasks that this planner cannot make finite are refused by the field") {
  CHECK(field(standing(1, 4)) == "accepted");
  CHECK(field(standing(1, 1)) == "phases[0].intervals");
  CHECK(field(on_a_point()) == "phases[1].contacts");
  Options options;
  options.dynamics = false;  // its plan would have forces all the same
  CHECK(field(on_a_point(), options) == "phases[1].contacts");
  options = Options();
  options.forces = Forces::parameters;  // balance is a constraint there, and a moment may well be zero
  CHECK(field(on_a_point(), options) == "accepted");

  PlanarTask rigid = standing(1, 4);
  rigid.robot.bodies.resize(1);
  rigid.robot.collision_pairs.clear();
  rigid.robot.end_effectors = {{"seat", 0, {0.0, 0.0}, 0.0, {-0.1, 0.1}}};
  rigid.phases[0].contacts = {{0, 0, {0.0, 0.0}, 0.0}};
  CHECK(field(rigid) == "bodies");

  PlanarTask slippery = standing(1, 4);
  slippery.surfaces[0].friction = 0.0;
  CHECK(field(slippery) == "surfaces[0].friction");

  PlanarTask slow = standing(2, 4);
  slow.phases[1].min_duration = 8.0;
  CHECK(field(slow) == "phase_duration_s");
  options = Options();
  options.free_durations = false;
  CHECK(field(slow, options) == "accepted");  // 16 s in all
  slow.phases[1].min_duration = 30.0;
  CHECK(field(slow, options) == "total_duration_s");

  options = Options();
  options.order = 2;
  CHECK(field(standing(1, 4), options) == "order");
}
