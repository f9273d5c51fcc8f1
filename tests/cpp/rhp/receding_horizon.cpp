#include "mcplan/rhp/receding_horizon.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <vector>

#include "clocks.hpp"
#include "in_threads.hpp"
#include "mcplan/base/error.hpp"
#include "rhp/walkers.hpp"
#include "slow_build.hpp"

namespace mcplan::rhp::tests {
namespace {

using Eigen::Vector3d;
using walkers::field_of;

/// All numbers of a plan that a cycle decides, in one list.
std::vector<double> numbers(const Plan& plan) {
  std::vector<double> out;
  const auto add = [&](const Vector3d& v) { out.insert(out.end(), v.data(), v.data() + 3); };
  for (const Knot& knot : plan.knots) {
    add(knot.com_W);
    add(knot.com_velocity_W);
    add(knot.angular_momentum_W);
    for (const Vector3d& end : knot.end_effectors_W) add(end);
  }
  for (const Phase& phase : plan.phases) {
    out.push_back(phase.duration);
    for (const Contact& contact : phase.contacts)
      for (const Vector3d& force : contact.point_forces_W) add(force);
  }
  return out;
}

bool same_bytes(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

RecedingHorizon planner(const Scene& scene, const Options& options) { return {scene, walkers::robot(), options}; }

/// Motions of two plans, the second carried back by `back`, agree to the accuracy of the solver.
void check_same_motion(const Plan& a, const Plan& b, const std::function<Vector3d(const Vector3d&)>& back,
                       const std::array<int, 2>& feet_of_b) {
  REQUIRE(a.knots.size() == b.knots.size());
  for (std::size_t k = 0; k < a.knots.size(); ++k) {
    CAPTURE(k);
    CHECK((a.knots[k].com_W - back(b.knots[k].com_W)).norm() < 1e-4);
    for (int foot = 0; foot < 2; ++foot)
      CHECK((a.knots[k].end_effectors_W[foot] - back(b.knots[k].end_effectors_W[feet_of_b[foot]])).norm() < 1e-4);
  }
  for (std::size_t q = 0; q < a.phases.size(); ++q) CHECK(std::abs(a.phases[q].duration - b.phases[q].duration) < 1e-4);
}

}  // namespace

TEST_CASE("every fidelity but the CoM alone walks over uneven patches, with both transcriptions") {
  for (Fidelity fidelity : {Fidelity::single, Fidelity::rectangle, Fidelity::point})
    for (Transcription transcription : {Transcription::trapezoidal, Transcription::euler}) {
      if (kSlowBuild && fidelity != Fidelity::point && transcription == Transcription::euler) continue;
      Options options = walkers::quick(fidelity);
      options.transcription = transcription;
      const Walk walk = planner(walkers::uneven(), options).walk();
      CAPTURE(static_cast<int>(fidelity));
      CAPTURE(walk.report.message);
      CHECK(walk.success);
      REQUIRE(walk.cycles.size() == 2);
      CHECK(walk.distance_m() > 0.3);
      for (const Cycle& cycle : walk.cycles) {
        CHECK(cycle.executed);
        CHECK(cycle.defect <= 1e-6);
        if (transcription == Transcription::trapezoidal) {
          CHECK_MESSAGE(cycle.status == Status::solved, cycle.message);
          CHECK(cycle.drift_com_m < 1e-6);
          CHECK(cycle.drift_momentum < 1e-4);
        } else {
          CHECK(cycle.drift_com_m > 1e-3);  // Euler's motion is not the integral of its forces, and says so
        }
      }
    }
}

TEST_CASE("a horizon of one step") {
  for (Transcription transcription : {Transcription::trapezoidal, Transcription::euler}) {
    Options options = walkers::quick(Fidelity::point, 1);
    options.transcription = transcription;
    auto one = planner(walkers::plain(), options);
    const Cycle cycle = one.step();
    CAPTURE(cycle.message);
    CHECK(cycle.executed);
    CHECK(one.horizon().phases.size() == 3);
    CHECK(same_bytes(numbers(one.horizon()), numbers(one.executed())));
  }
}

TEST_CASE("the next cycle starts exactly where the last one ends") {
  for (Transcription transcription : {Transcription::trapezoidal, Transcription::euler}) {
    Options options = walkers::quick();
    options.transcription = transcription;
    auto walker = planner(walkers::uneven(), options);
    REQUIRE(walker.step().executed);
    const Plan first = walker.executed();
    const State handed = walker.state();
    CHECK(handed.com_W == first.knots.back().com_W);
    CHECK(handed.com_velocity_W == first.knots.back().com_velocity_W);
    CHECK(handed.angular_momentum_W == first.knots.back().angular_momentum_W);
    CHECK(handed.feet_W == first.knots.back().end_effectors_W);
    CHECK(handed.surfaces == first.final_contacts);
    REQUIRE(walker.step().executed);
    const Plan second = walker.executed();
    CHECK(second.knots.front().com_W == handed.com_W);
    CHECK(second.knots.front().com_velocity_W == handed.com_velocity_W);
    CHECK(second.knots.front().angular_momentum_W == handed.angular_momentum_W);
    CHECK(second.knots.front().end_effectors_W == handed.feet_W);

    const Plan both = walker.result().plan;
    CHECK(both.phases.size() == 6);
    CHECK(both.duration() == doctest::Approx(first.duration() + second.duration()));
    CHECK(both.knots[3].com_W == second.knots.front().com_W);
    CHECK(both.knots.back().com_W == second.knots.back().com_W);
  }
}

TEST_CASE("the feet step in turn, each onto the surface that its step names") {
  Options options = walkers::quick();
  options.cycles = 3;
  const Scene scene = walkers::uneven();
  const Plan plan = planner(scene, options).walk().plan;
  REQUIRE(plan.phases.size() == 9);
  for (int i = 0; i < 3; ++i) {
    const int foot = i % 2 == 0 ? walkers::left : walkers::right;
    for (int e : {0, 1}) {
      CHECK(plan.phases[3 * i].contacts[e].surface >= 0);
      CHECK((plan.phases[3 * i + 1].contacts[e].surface < 0) == (e == foot));
    }
    const int landed = plan.phases[3 * i + 2].contacts[foot].surface;
    REQUIRE(landed >= 0);
    CHECK(scene.surfaces[landed].name == scene.steps[i].surface);
  }
}

TEST_CASE("a cycle starts from the measured state, to the last bit") {
  auto walker = planner(walkers::uneven(), walkers::quick());
  State measured = walker.state();
  measured.com_W += Vector3d(0.013, -0.007, 0.004);
  measured.com_velocity_W = {0.05, -0.02, 0.01};
  measured.angular_momentum_W = {0.1, -0.2, 0.05};
  measured.feet_W[walkers::right] += Vector3d(0.01, -0.01, 0.0);
  const Cycle cycle = walker.step(measured);
  CAPTURE(cycle.message);
  REQUIRE(cycle.status == Status::solved);
  const Plan plan = walker.executed();
  CHECK(plan.measured_start);
  CHECK(plan.knots.front().com_W == measured.com_W);
  CHECK(plan.knots.front().com_velocity_W == measured.com_velocity_W);
  CHECK(plan.knots.front().angular_momentum_W == measured.angular_momentum_W);
  CHECK(plan.knots.front().end_effectors_W == measured.feet_W);
  CHECK(walker.result().plan.measured_start);
}

TEST_CASE("a cycle that fails keeps the last plan and says what is wrong") {
  auto walker = planner(walkers::uneven(), walkers::quick());
  REQUIRE(walker.step().executed);
  const std::vector<double> before = numbers(walker.executed()), horizon_before = numbers(walker.horizon());
  const std::vector<double> walked_before = numbers(walker.result().plan);
  State measured = walker.state();
  measured.com_W += Vector3d(3.0, 0.0, 0.0);
  const Cycle failed = walker.step(measured);
  CHECK_FALSE(failed.executed);
  CHECK(failed.status != Status::solved);
  CHECK(failed.status != Status::acceptable);
  CHECK_FALSE(failed.message.empty());
  CHECK(failed.worst_violation.value > 0.1);
  CHECK_FALSE(failed.worst_violation.name.empty());
  CHECK(same_bytes(numbers(walker.executed()), before));
  CHECK(same_bytes(numbers(walker.horizon()), horizon_before));
  const Walk walk = walker.result();
  CHECK(same_bytes(numbers(walk.plan), walked_before));
  CHECK_FALSE(walk.success);
  CHECK(walk.cycles.size() == 2);
  CHECK(walk.report.status == failed.status);
  CHECK(walk.report.message.find("cycle 1") != std::string::npos);
}

TEST_CASE("after a failed cycle the walk goes on from a state that is possible") {
  auto walker = planner(walkers::uneven(), walkers::quick());
  REQUIRE(walker.step().executed);
  const State good = walker.state();
  State measured = good;
  measured.com_W.x() += 3.0;
  REQUIRE_FALSE(walker.step(measured).executed);
  const Cycle next = walker.step(good);
  CAPTURE(next.message);
  CHECK(next.executed);
  CHECK(walker.executed().knots.front().com_W == good.com_W);
}

TEST_CASE("a cycle ends at its time limit") {
  Options options = walkers::quick(Fidelity::single, 6);
  options.intervals = 7;
  // After the limit: the solver's own limit begins a look after the cycle's was read (1); it was not over at a look
  // before an evaluation, which is clocked (2), and is over at the next one (1); the solver says how long it took (1);
  // what is done with the best point is clocked (1), and the cycle says how long it took (1). The kernel looks once
  // more, for what is left when it begins.
  constexpr double kTick_s = 0.01;  // the solver looks several times an iteration
  for (const auto& [solver, looks_after] : {std::pair(nlp::Solver::ipopt, 7), {nlp::Solver::automatic, 8}})
    for (double limit : {1e-6, 0.05, 0.1, 0.2}) {
      options.solver = solver;
      options.time_limit_s = limit;
      options.clock = CountingClock(kTick_s);
      const Cycle cycle = planner(walkers::uneven(), options).step();
      CAPTURE(limit);
      CHECK(cycle.status == Status::time_limit);
      CHECK(cycle.iterations <= 5);  // of at least 30
      CHECK(cycle.time_s <= limit + (looks_after + 1e-9) * kTick_s);
      CHECK_FALSE(cycle.message.empty());
      CHECK_FALSE(cycle.executed);
    }
}

TEST_CASE("a cycle ends at its limit of iterations") {
  Options options = walkers::quick();
  options.max_iterations = 4;
  auto walker = planner(walkers::uneven(), options);
  const Cycle cycle = walker.step();
  CHECK(cycle.status == Status::iteration_limit);
  CHECK(cycle.iterations <= 4);
}

TEST_CASE("a stop request ends a cycle, and the loop with it") {
  Options options = walkers::quick();
  options.cycles = 5;
  int polls = 0;
  options.stop = [&] { return ++polls > 3; };
  const Walk walk = planner(walkers::uneven(), options).walk();
  CHECK(walk.cycles.size() == 1);
  CHECK(walk.report.status == Status::interrupted);
  CHECK_FALSE(walk.success);
}

TEST_CASE("the logger gets a line a cycle") {
  Options options = walkers::quick();
  std::vector<std::string> lines;
  options.logger = [&](LogLevel, const std::string& line) { lines.push_back(line); };
  planner(walkers::plain(), options).walk();
  CHECK(lines.size() == 2);
}

TEST_CASE("the same walk twice is the same to the last bit") {
  const Options options = walkers::quick();
  const Walk a = planner(walkers::uneven(), options).walk(), b = planner(walkers::uneven(), options).walk();
  REQUIRE(a.success);
  CHECK(same_bytes(numbers(a.plan), numbers(b.plan)));
}

TEST_CASE("on mirrored ground, the right foot first, the walk is mirrored") {
  Options options = walkers::quick();
  options.tolerance = 1e-7;
  const Walk walk = planner(walkers::uneven(), options).walk();
  const Walk other = planner(walkers::mirrored(walkers::uneven()), options).walk();
  REQUIRE(walk.success);
  REQUIRE(other.success);
  CHECK(other.plan.phases[1].contacts[walkers::right].surface < 0);
  check_same_motion(walk.plan, other.plan, [](const Vector3d& p) { return Vector3d(p.x(), -p.y(), p.z()); }, {1, 0});
  CHECK(walk.cycles[0].cost == doctest::Approx(other.cycles[0].cost).epsilon(1e-6));
}

TEST_CASE("in a world that is turned and shifted the walk is turned and shifted") {
  const Vector3d shift(40.0, -70.0, 12.0);
  const auto compare = [&](const Options& options, double yaw) {
    const Walk walk = planner(walkers::uneven(), options).walk();
    const Walk other = planner(walkers::moved(walkers::uneven(), yaw, shift), options).walk();
    REQUIRE(walk.success);
    REQUIRE(other.success);
    const Eigen::AngleAxisd back(-yaw, Vector3d::UnitZ());
    check_same_motion(walk.plan, other.plan, [&](const Vector3d& p) { return Vector3d(back * (p - shift)); }, {0, 1});
    CHECK(walk.distance_m() == doctest::Approx(other.distance_m()).epsilon(1e-4));
  };
  Options options = walkers::quick();
  options.tolerance = 1e-7;
  compare(options, M_PI / 2.0);
  if (kSlowBuild) return;
  // The limits on each component of L and L' are boxes in the world, which turn into themselves at right angles alone.
  options.fidelity = Fidelity::single;
  options.momentum_max = options.momentum_rate_max = 1000.0;
  compare(options, 2.1);
}

TEST_CASE("a sequence taken from a plan is walked to its end, where the robot rests") {
  Options options = walkers::quick(Fidelity::single, 3);
  const Plan sequence = planner(walkers::uneven(), options).walk().plan;
  REQUIRE(sequence.phases.size() == 6);
  options.cycles = 14;
  options.constraint_tolerance = 1e-9;  // the state at the end is that of the forces, integrated
  RecedingHorizon refined(walkers::uneven(), walkers::robot(), sequence, options);
  const Walk walk = refined.walk();
  CAPTURE(walk.report.message);
  CHECK(walk.success);
  REQUIRE(walk.cycles.size() == 2);
  CHECK(walk.plan.knots.back().com_velocity_W.norm() < 1e-9);
  CHECK(walk.plan.knots.back().angular_momentum_W.norm() < 1e-6);
  CHECK(walk.plan.final_contacts == sequence.final_contacts);
  CHECK(field_of<InvalidInput>([&] { refined.step(); }) == "cycles");
}

TEST_CASE("what a scene lacks is refused by name") {
  const Options options = walkers::quick();
  const auto field = [&](const std::function<void(Scene&)>& spoil) {
    Scene scene = walkers::uneven();
    spoil(scene);
    return field_of<InvalidScene>([&] { planner(scene, options); });
  };
  CHECK(field([](Scene& scene) { scene.steps.clear(); }) == "steps");
  CHECK(field([](Scene& scene) { scene.steps[2].end_effector = "third_foot"; }) == "steps[2].end_effector");
  CHECK(field([](Scene& scene) { scene.steps[1].surface = "nowhere"; }).find("steps[1]") == 0);
  CHECK(field([](Scene& scene) { scene.surfaces[2].end_effectors = {"right_foot"}; }) == "steps[2].surface");
  CHECK(field([](Scene& scene) { scene.start.contacts = {{"left_foot", "start"}}; }) == "start.contacts");
  CHECK(field([](Scene& scene) {
          auto& vertices = scene.surfaces[1].vertices_W;  // a dent
          vertices.insert(vertices.begin() + 1, 0.25 * (vertices[0] + vertices[1] + vertices[2] + vertices[3]));
        }).find("surfaces[1].vertices") == 0);
}

TEST_CASE("a robot that does not have two feet is refused") {
  Robot robot = walkers::robot();
  robot.end_effectors[1].kind = "hand";
  CHECK(field_of<InvalidRobot>([&] { RecedingHorizon(walkers::uneven(), robot, walkers::quick()); }) ==
        "end_effectors");
}

TEST_CASE("measurements that do not fit the robot are refused and change nothing") {
  auto walker = planner(walkers::uneven(), walkers::quick());
  const State good = walker.state();
  State wrong = good;
  wrong.feet_W.pop_back();
  CHECK(field_of<InvalidInput>([&] { walker.step(wrong); }) == "measured.feet_W");
  wrong = good;
  wrong.surfaces[0] = 99;
  CHECK(field_of<InvalidInput>([&] { walker.step(wrong); }) == "measured.surfaces");
  wrong = good;
  wrong.com_W.y() = std::numeric_limits<double>::quiet_NaN();
  CHECK(field_of<InvalidInput>([&] { walker.step(wrong); }).find("measured") == 0);
  CHECK(walker.state().com_W == good.com_W);
  CHECK(walker.result().cycles.empty());
}

TEST_CASE("a patch too far or too steep is infeasible, and the worst row is named") {
  nlp::Solver solver = nlp::Solver::ipopt;
  const auto first_failure = [&](const std::function<void(Scene&)>& spoil) {
    Options options = walkers::quick();
    options.cycles = 3;
    options.solver = solver;
    options.max_iterations = solver == nlp::Solver::ipm ? 400 : 120;
    Scene scene = walkers::uneven();
    spoil(scene);
    const Walk walk = planner(scene, options).walk();
    CHECK_FALSE(walk.success);
    CHECK_FALSE(walk.cycles.back().executed);
    return walk.cycles.back();
  };
  for (nlp::Solver each : {nlp::Solver::ipopt, nlp::Solver::ipm}) {
    CAPTURE(static_cast<int>(each));
    solver = each;
    const Cycle far = first_failure([](Scene& scene) {
      for (Vector3d& vertex : scene.surfaces[1].vertices_W) vertex.x() += 1.5;
    });
    CHECK(far.status == Status::infeasible);
    CHECK_FALSE(far.worst_violation.name.empty());
    CHECK(far.worst_violation.value > 1e-3);

    const Cycle steep = first_failure([](Scene& scene) {
      scene.surfaces[1] = walkers::patch("right_1", 0.35, 0.95, -0.5, 0.0, 0.0, 0.0, -1.5);
      scene.surfaces[1].friction = 0.1;
    });
    CHECK((steep.status == Status::infeasible || steep.status == Status::iteration_limit));
    CHECK_FALSE(steep.worst_violation.name.empty());

    const Cycle small = first_failure([](Scene& scene) {
      scene.surfaces[1] = walkers::patch("right_1", 0.40, 0.50, -0.2, -0.1);  // shorter than the sole
    });
    CHECK(small.status == Status::infeasible);
    CHECK_FALSE(small.worst_violation.name.empty());
  }
}

TEST_CASE("walkers in several threads walk as one alone does") {
  const Scene scene = walkers::uneven();
  const auto walk = [&](int t) {
    constexpr Fidelity kFidelities[] = {Fidelity::point, Fidelity::rectangle, Fidelity::single};
    return numbers(planner(scene, walkers::quick(kFidelities[t])).walk().plan);
  };
  constexpr int kThreads = kSlowBuild ? 2 : 3;
  const auto together = in_threads(kThreads, walk);
  for (int t = 0; t < kThreads; ++t) CHECK(same_bytes(together[t], walk(t)));
}

}  // namespace mcplan::rhp::tests
