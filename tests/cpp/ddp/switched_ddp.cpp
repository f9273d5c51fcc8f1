#include "mcplan/ddp/switched_ddp.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "in_threads.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/plan/checker.hpp"
#include "support.hpp"

namespace {

using namespace support;
using mcplan::Plan;
using mcplan::PlanResult;
using mcplan::Status;
using mcplan::ddp::Options;
using mcplan::ddp::SwitchedDdp;

PlanResult solve(const mcplan::Scene& scene, const Options& options = {},
                 const mcplan::Robot& robot = scenes::humanoid44()) {
  return SwitchedDdp(scene, robot, options).solve();
}

using mcplan::ddp::Model;

/// A scene of the paper with default options but for the model; solved once for all tests that need it.
const PlanResult& solved(const std::string& name, Model model = Options().model) {
  static std::map<std::pair<std::string, Model>, PlanResult> results;
  const auto known = results.find({name, model});
  if (known != results.end()) return known->second;
  Options options;
  options.model = model;
  for (const mcplan::Scene& scene : scenes::all_four())
    if (scene.name == name) return results[{name, model}] = solve(scene, options);
  throw std::runtime_error(name);
}

/// Phases in which none of the feet touches anything.
int phases_without_feet(const Plan& plan) {
  int count = 0;
  for (const auto& row : plan.contact_sequence()) count += row[0] < 0 && row[1] < 0;
  return count;
}

void check_same_motion(const Plan& a, const Plan& b, const Eigen::Isometry3d& b_from_a, double tolerance) {
  CHECK(a.contact_sequence() == b.contact_sequence());
  REQUIRE(a.knots.size() == b.knots.size());
  double worst = 0.0;
  for (std::size_t k = 0; k < a.knots.size(); ++k) {
    worst = std::max(worst, (b_from_a * a.knots[k].com_W - b.knots[k].com_W).norm());
    worst = std::max(worst, (b_from_a.linear() * a.knots[k].com_velocity_W - b.knots[k].com_velocity_W).norm());
    for (std::size_t e = 0; e < a.knots[k].end_effectors_W.size(); ++e)
      worst = std::max(worst, (b_from_a * a.knots[k].end_effectors_W[e] - b.knots[k].end_effectors_W[e]).norm());
    if (k < a.phases.size()) worst = std::max(worst, std::abs(a.phases[k].duration - b.phases[k].duration));
  }
  CHECK(worst <= tolerance);
}

template <class Error, class Call>
std::string refused_field(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.field();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("the four scenes of the paper are solved, and the checker agrees") {
  for (Model model : kModels)
    for (const mcplan::Scene& scene : scenes::all_four()) {
      if (kSlowBuild && scene.name == "gap_with_rail") continue;
      CAPTURE(name(model));
      CAPTURE(scene.name);
      const PlanResult& result = solved(scene.name, model);
      MESSAGE(name(model), " ", scene.name, ": ", result.report.message, ", cost ", result.report.cost, ", ",
              result.report.iterations, " iterations, ", result.report.time_s, " s");
      CHECK(result.report.status == Status::solved);
      const mcplan::CheckResult check = mcplan::check(result.plan, scene, scenes::humanoid44());
      CHECK_MESSAGE(check.ok(), check.to_string());
      double sum = 0.0;
      for (const auto& [name, value] : result.report.cost_terms) sum += value;
      CHECK(sum == doctest::Approx(result.report.cost).epsilon(1e-9));
      CHECK(result.report.history.size() == static_cast<std::size_t>(result.report.iterations));
    }
}

TEST_CASE("flat and stairs are walked: feet alternate, no flight, every tread used") {
  for (Model model : kModels)
    for (const std::string scene : {"flat", "stairs"}) {
      CAPTURE(name(model));
      CAPTURE(scene);
      const auto sequence = solved(scene, model).plan.contact_sequence();
      CHECK(phases_without_feet(solved(scene, model).plan) == 0);
      int last = -1, steps = 0;
      std::vector<int> used(4, 0);
      for (std::size_t k = 0; k < sequence.size(); ++k)
        for (int l : {0, 1}) {
          if (sequence[k][l] >= 0) used[sequence[k][l]] = 1;
          if (k == 0 || sequence[k][l] >= 0 || sequence[k - 1][l] < 0) continue;
          CHECK(l != last);
          last = l;
          ++steps;
        }
      CHECK(steps >= 4);
      if (scene == "stairs") CHECK(used == std::vector<int>(4, 1));
    }
}

TEST_CASE("the gap is jumped once, on a parabola") {
  for (Model model : kModels) {
    CAPTURE(name(model));
    const Plan& plan = solved("gap", model).plan;
    int flights = 0;
    for (std::size_t k = 0; k < plan.phases.size(); ++k) {
      bool flies = true;
      for (const auto& contact : plan.phases[k].contacts) flies = flies && contact.surface < 0;
      if (flies) {
        ++flights;
        for (int i = 0; i <= 50; ++i) {
          const mcplan::PlanState s = plan.at_phase(static_cast<int>(k), i / 50.0 * plan.phases[k].duration);
          CHECK((s.com_acceleration_W - Eigen::Vector3d(0, 0, -9.8)).norm() <= 1e-12);
          if (model == Model::wrench) CHECK((s.angular_momentum_W - plan.knots[k].angular_momentum_W).norm() <= 1e-12);
        }
      }
    }
    CHECK(flights == 1);
  }
}

TEST_CASE("the jump rises at least 0.15 m above the take-off") {
  for (Model model : kModels) {
    CAPTURE(name(model));
    const Plan& plan = solved("gap", model).plan;
    for (std::size_t k = 0; k < plan.phases.size(); ++k) {
      bool flies = true;
      for (const auto& contact : plan.phases[k].contacts) flies = flies && contact.surface < 0;
      if (!flies) continue;
      const double up = plan.knots[k].com_velocity_W.z();
      const double time = std::min(plan.phases[k].duration, std::max(up, 0.0) / 9.8);  // to the apex
      CHECK(up * time - 0.5 * 9.8 * time * time >= 0.15);
    }
  }
}

TEST_CASE("over the rail both hands hold while both feet are off") {
  if (kSlowBuild) return;
  for (Model model : kModels) {
    CAPTURE(name(model));
    const Plan& plan = solved("gap_with_rail", model).plan;
    CHECK(phases_without_feet(plan) >= 1);
    for (const auto& row : plan.contact_sequence())
      if (row[0] < 0 && row[1] < 0) {
        CHECK(row[2] == 2);
        CHECK(row[3] == 3);
      }
  }
}

TEST_CASE("the plan is the same to the last bit for 1, 2 and 4 threads") {
  for (const char* name : {"stairs", "gap", "gap_with_rail"}) {
    if (kSlowBuild && name != std::string("stairs")) continue;
    const PlanResult& one = solved(name);
    for (int threads : {2, 4}) {
      if (kSlowBuild && threads == 4) continue;
      Options options;
      options.threads = threads;
      const PlanResult other = solve(one.plan.scene, options);
      CHECK(other.report.threads == threads);
      CHECK(other.report.cost == one.report.cost);
      CHECK(other.report.iterations == one.report.iterations);
      check_same_motion(one.plan, other.plan, Eigen::Isometry3d::Identity(), 0.0);
      for (std::size_t k = 0; k < one.plan.phases.size(); ++k)
        for (std::size_t e = 0; e < 4; ++e)
          CHECK(one.plan.phases[k].contacts[e].stiffness == other.plan.phases[k].contacts[e].stiffness);
    }
  }
}

TEST_CASE("planners in several threads, some with threads of their own, plan what one alone plans") {
  const mcplan::Scene& stairs = solved("stairs").plan.scene;  // shared, as a user's would be
  const std::vector<PlanResult> results = in_threads(kSlowBuild ? 2 : 4, [&](int t) {
    Options options;
    options.threads = 1 + t % 2;
    options.model = kModels[t / 2];
    return solve(stairs, options);
  });
  for (std::size_t t = 0; t < results.size(); ++t) {
    const PlanResult& alone = solved("stairs", kModels[t / 2]);
    CHECK(results[t].report.cost == alone.report.cost);
    check_same_motion(alone.plan, results[t].plan, Eigen::Isometry3d::Identity(), 0.0);
  }
}

TEST_CASE("a mirrored world gives the mirrored plan") {
  for (const mcplan::Scene& scene : scenes::all_four()) {
    if (kSlowBuild && scene.name != "stairs") continue;
    CAPTURE(scene.name);
    mcplan::Scene crooked = scene;  // nothing symmetrical about it
    crooked.goal.position_W.y() = 0.1;
    const auto flip = [](Eigen::Vector3d v) { return Eigen::Vector3d(v.x(), -v.y(), v.z()); };
    mcplan::Scene mirrored = crooked;
    for (mcplan::Stance* stance : {&mirrored.start, &mirrored.goal}) stance->position_W = flip(stance->position_W);
    for (mcplan::Surface& surface : mirrored.surfaces) {
      for (auto& v : surface.vertices_W) v = flip(v);
      std::reverse(surface.vertices_W.begin(), surface.vertices_W.end());
    }
    mcplan::Robot robot = scenes::humanoid44();
    for (mcplan::EndEffector& end : robot.end_effectors) {
      end.nominal_B = flip(end.nominal_B);
      const double low = end.reach_min_B.y();
      end.reach_min_B.y() = -end.reach_max_B.y();
      end.reach_max_B.y() = -low;
    }
    const PlanResult one = solve(crooked), other = solve(mirrored, {}, robot);
    CHECK(one.report.status == other.report.status);
    CHECK(one.report.cost == doctest::Approx(other.report.cost).epsilon(1e-6));
    Eigen::Isometry3d mirror = Eigen::Isometry3d::Identity();
    mirror.linear() = Eigen::Vector3d(1, -1, 1).asDiagonal();
    check_same_motion(one.plan, other.plan, mirror, 1e-5);
  }
}

TEST_CASE("a turned world gives the turned plan") {
  const Eigen::Isometry3d turn(Eigen::Translation3d(3.0, -2.0, 0.0) * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()));
  for (const mcplan::Scene& scene : scenes::all_four()) {
    if (kSlowBuild && scene.name != "stairs") continue;
    CAPTURE(scene.name);
    mcplan::Scene turned = scene;
    for (mcplan::Stance* stance : {&turned.start, &turned.goal}) {
      stance->position_W = turn * stance->position_W;
      stance->yaw += 0.7;
    }
    for (mcplan::Surface& surface : turned.surfaces)
      for (auto& v : surface.vertices_W) v = turn * v;
    const PlanResult& one = solved(scene.name);
    const PlanResult other = solve(turned);
    CHECK(other.report.status == one.report.status);
    CHECK(one.report.cost == doctest::Approx(other.report.cost).epsilon(1e-6));
    check_same_motion(one.plan, other.plan, turn, 1e-5);
  }
}

TEST_CASE("a warm start from a solved plan keeps its sequence and takes fewer iterations") {
  const PlanResult& cold = solved("stairs");
  const PlanResult warm = SwitchedDdp(scenes::stairs(), scenes::humanoid44()).solve(cold.plan);
  CHECK(warm.report.status == Status::solved);
  CHECK(warm.report.iterations < cold.report.iterations);
  CHECK(warm.report.cost <= 1.02 * cold.report.cost);
}

TEST_CASE("replanning starts from the measured state and arrives") {
  const PlanResult& before = solved("flat");
  for (int phase : {5, 11}) {
    CAPTURE(phase);
    const double t = before.plan.knot_times()[phase] + 0.6 * before.plan.phases[phase].duration;
    const mcplan::PlanState now = before.plan.at(t);
    mcplan::Knot measured;
    measured.com_W = now.com_W + Eigen::Vector3d(0.004, -0.003, 0.002);
    measured.com_velocity_W = now.com_velocity_W + Eigen::Vector3d(0.01, 0.01, 0.0);
    measured.base_rpy = now.base_rpy;
    measured.base_rpy_rate = now.base_rpy_rate;
    for (const auto& end : now.end_effectors) {
      measured.end_effectors_W.push_back(end.position_W);
      measured.end_effector_velocities_W.push_back(end.velocity_W);
    }
    const PlanResult again = SwitchedDdp(scenes::flat(), scenes::humanoid44()).replan(before.plan, t, measured);
    CHECK_MESSAGE(again.report.status == Status::solved, again.report.message);
    CHECK(again.plan.measured_start);
    CHECK(again.plan.phases.size() == before.plan.phases.size() - now.phase);
    CHECK((again.plan.knots.front().com_W - measured.com_W).norm() <= 0.01);
    for (int foot : {0, 1})
      CHECK((again.plan.knots.front().end_effectors_W[foot] - measured.end_effectors_W[foot]).norm() <= 1e-6);
    CHECK((again.plan.knots.back().com_W - Eigen::Vector3d(2, 0, 0.7)).norm() <= 0.01);
    // About as long as what was left.
    CHECK(again.plan.duration() == doctest::Approx(before.plan.duration() - t).epsilon(0.25));
  }
  mcplan::Knot short_one;
  CHECK(refused_field<mcplan::InvalidPlan>([&] {
          SwitchedDdp(scenes::flat(), scenes::humanoid44()).replan(before.plan, 1.0, short_one);
        }) == "measured.end_effectors_W");
}

TEST_CASE("a goal out of reach gives an honest status, never solved") {
  mcplan::Scene scene = scenes::flat();
  scene.surfaces[0].vertices_W = {{-1, -5, 0}, {40, -5, 0}, {40, 5, 0}, {-1, 5, 0}};
  scene.goal.position_W.x() = 30.0;
  Options options = phases(18);
  if (kSlowBuild) options.restarts = 0;
  const PlanResult far = solve(scene, options);
  CHECK(far.report.status != Status::solved);
  CHECK(far.report.worst_violation.value > far.report.worst_violation.tolerance);
  CHECK_FALSE(far.report.worst_violation.name.empty());

  scene = scenes::flat();
  scene.surfaces[0].vertices_W = {{-1, -5, 0}, {0.5, -5, 0}, {0.5, 5, 0}, {-1, 5, 0}};
  scene.goal.position_W.x() = 2.0;  // above nothing
  const PlanResult nowhere = solve(scene, options);
  CHECK(nowhere.report.status != Status::solved);
}

TEST_CASE("start equals goal is solved: the robot stands") {
  const PlanResult result = solve(scenes::flat(0.0), phases(8));
  CHECK_MESSAGE(result.report.status == Status::solved, result.report.message);
  for (const auto& knot : result.plan.knots) CHECK((knot.com_W - Eigen::Vector3d(0, 0, 0.7)).norm() < 0.1);
}

TEST_CASE("a turn of 30 degrees between start and goal is planned") {
  mcplan::Scene scene = scenes::flat(1.0);
  scene.goal.yaw = 0.52;
  const PlanResult result = solve(scene);
  CHECK_MESSAGE(result.report.status == Status::solved, result.report.message);
  CHECK(result.plan.knots.back().base_rpy.z() == doctest::Approx(0.52).epsilon(0.02));
}

TEST_CASE("a quarter turn on the spot takes several steps, each sole within its range of the base") {
  mcplan::Scene scene = scenes::flat(0.0);
  scene.goal.yaw = M_PI / 2;
  mcplan::Robot robot = scenes::humanoid44();
  for (int foot : {0, 1}) robot.end_effectors[foot].yaw_range = {-0.5, 0.5};
  const PlanResult result = solve(scene, {}, robot);
  CHECK_MESSAGE(result.report.status == Status::solved, result.report.message);
  const Plan& plan = result.plan;
  REQUIRE(plan.knots.size() > 1);
  CHECK(plan.knots.back().base_rpy.z() == doctest::Approx(M_PI / 2).epsilon(0.02));
  for (int foot : {0, 1}) {
    CHECK(plan.knots.back().end_effector_yaw[foot] == doctest::Approx(M_PI / 2));
    int landings = 0;
    for (std::size_t k = 1; k < plan.phases.size(); ++k)
      landings += plan.phases[k].contacts[foot].surface >= 0 && plan.phases[k - 1].contacts[foot].surface < 0;
    CHECK(landings >= 2);
  }
}

TEST_CASE("over the gap with an eighth of a turn: what turns in flight is the momentum of the take-off") {
  mcplan::Scene scene = scenes::gap();
  scene.goal.yaw = M_PI / 4;
  Options options;
  options.detours = false;  // with them it jumps straight ahead and turns where it has landed
  const PlanResult result = solve(scene, options);
  CHECK_MESSAGE(result.report.status == Status::solved, result.report.message);
  const Plan& plan = result.plan;
  REQUIRE(plan.knots.size() > 1);
  CHECK(plan.knots.back().base_rpy.z() == doctest::Approx(M_PI / 4).epsilon(0.02));
  double turned = 0.0;
  for (std::size_t k = 0; k < plan.phases.size(); ++k) {
    if (plan.phases[k].contacts[0].surface >= 0 || plan.phases[k].contacts[1].surface >= 0) continue;
    turned += plan.knots[k + 1].base_rpy.z() - plan.knots[k].base_rpy.z();
    CHECK((plan.knots[k + 1].angular_momentum_W - plan.knots[k].angular_momentum_W).norm() <= 1e-9);
  }
  MESSAGE("turned by ", turned, " rad in flight, cost ", result.report.cost);
  CHECK(turned > 0.02);
}

TEST_CASE("a given sequence is kept as the first guess; one that does not fit is refused at once") {
  Options options = phases(8);
  const std::vector<int> both{0, 0, -1, -1}, right{0, -1, -1, -1}, left{-1, 0, -1, -1};
  options.initial_sequence = {both, right, both, left, both, right, both, left, both};
  CHECK(solve(scenes::flat(0.5), options).report.status == Status::solved);
  options.initial_sequence[4] = left;
  options.initial_sequence[5] = right;
  CHECK(refused_field<mcplan::InvalidOptions>([&] { solve(scenes::flat(0.5), options); }) == "initial_sequence");
  options.initial_sequence.pop_back();
  CHECK(refused_field<mcplan::InvalidOptions>([&] { solve(scenes::flat(0.5), options); }) == "initial_sequence");
}

TEST_CASE("the log gets lines, the report its history, and neither changes the plan") {
  Options options;
  int lines = 0;
  options.logger = [&](mcplan::LogLevel, const std::string& line) {
    ++lines;
    CHECK(line.find('\n') == std::string::npos);
  };
  options.record_history = true;
  const PlanResult result = solve(scenes::stairs(), options);
  CHECK(lines >= result.report.iterations);
  CHECK(result.report.cost == solved("stairs").report.cost);
  for (const mcplan::Iteration& row : result.report.history) CHECK(row.sequence.size() == 19);
  CHECK(solved("stairs").report.history.front().sequence.empty());
  CHECK(result.report.timing_s.count("pricing") == 1);
}

TEST_CASE("the same options give the same plan, again and from one object") {
  SwitchedDdp planner(scenes::gap(), scenes::humanoid44());
  const PlanResult first = planner.solve(), second = planner.solve();
  CHECK(first.report.cost == second.report.cost);
  check_same_motion(first.plan, second.plan, Eigen::Isometry3d::Identity(), 0.0);
}
