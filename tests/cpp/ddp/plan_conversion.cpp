#include "mcplan/ddp/plan_conversion.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "mcplan/ddp/stepping_sequence.hpp"
#include "mcplan/plan/checker.hpp"
#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

/// A polished and exact walk.
struct Walk {
  explicit Walk(const mcplan::Scene& scene, StiffnessInput input = StiffnessInput::mu)
      : problem(scene, scenes::humanoid44(), options(input)) {
    const Deadline deadline(1e9);
    mcplan::Report report;
    Search search(problem, deadline, report);
    now.sequence = stepping_sequence(problem, 0);
    REQUIRE_FALSE(now.sequence.empty());
    now.trajectory = problem.initial_guess(now.sequence);
    search.polish(now, 80, 1e-5, std::numeric_limits<double>::infinity());
    REQUIRE(search.make_exact(now));
  }
  static Options options(StiffnessInput input) {
    Options out = phases(18);
    out.stiffness_input = input;
    return out;
  }
  Problem problem;
  Incumbent now;
};

const mcplan::Violation& named(const mcplan::CheckResult& result, const std::string& name) {
  for (const mcplan::Violation& v : result.constraints)
    if (v.name == name) return v;
  throw std::runtime_error("no constraint " + name);
}

}  // namespace

TEST_CASE("to a plan and back is the same motion and sequence") {
  for (auto input : {StiffnessInput::mu, StiffnessInput::lambda}) {
    const Walk walk(scenes::stairs(), input);
    const mcplan::Plan plan = to_plan(walk.problem, walk.now);
    CHECK_NOTHROW(plan.validate());
    const Incumbent back = from_plan(walk.problem, plan, 0);
    CHECK(back.sequence == walk.now.sequence);
    for (int k = 0; k <= 18; ++k) CHECK((back.trajectory.x[k] - walk.now.trajectory.x[k]).norm() <= 1e-13);
    for (int k = 0; k < 18; ++k) {
      // lambda and -lambda are the same force.
      const VectorXd difference = back.trajectory.u[k].cwiseAbs() - walk.now.trajectory.u[k].cwiseAbs();
      CHECK(difference.norm() <= 1e-12);
    }
  }
}

TEST_CASE("the plan is in SI units, obeys the dynamics, and touches where the sequence says") {
  const Walk walk(scenes::flat());
  const Layout& at = walk.problem.layout;
  const mcplan::Plan plan = to_plan(walk.problem, walk.now);
  CHECK(plan.knots.size() == 19);
  CHECK(plan.knots[9].com_W == walk.now.trajectory.x[9].segment<3>(at.com()) * 0.7);
  CHECK(plan.phases[4].duration ==
        doctest::Approx(walk.now.trajectory.u[4][at.duration()] * std::sqrt(0.7 / 9.8)).epsilon(1e-14));
  for (int k = 0; k < 18; ++k) {
    for (int l : {0, 1}) CHECK(plan.phases[k].contacts[l].surface == walk.now.sequence[k][l]);
    for (int hand : {2, 3}) CHECK(plan.phases[k].contacts[hand].surface == kFree);
  }
  const mcplan::CheckResult result = mcplan::check(plan, scenes::flat(), scenes::humanoid44());
  for (const char* name :
       {"finite", "dynamics", "at_consistency", "contact_distance", "contact_polygon", "slip", "anchor",
        "path_continuity", "free_force", "stiffness_sign", "pull", "moment", "sequence_switch"}) {
    const mcplan::Violation& v = named(result, name);
    CHECK_MESSAGE(v.value <= v.tolerance, v.to_string());
  }
  // Standing still weighs 44 kg: vertical forces times time over the whole motion balance gravity and momentum.
  double impulse = 0.0;
  for (int k = 0; k < 18; ++k) {
    constexpr int kSamples = 200;
    for (int i = 0; i < kSamples; ++i) {
      const mcplan::PlanState s = plan.at_phase(k, (i + 0.5) / kSamples * plan.phases[k].duration);
      for (const auto& end : s.end_effectors) impulse += end.force_W.z() * plan.phases[k].duration / kSamples;
    }
  }
  const double momentum = 44.0 * (plan.knots[18].com_velocity_W.z() - plan.knots[0].com_velocity_W.z());
  CHECK(impulse == doctest::Approx(44.0 * 9.8 * plan.duration() + momentum).epsilon(1e-4));
}

TEST_CASE("every free stretch has a swing that lifts off; idle hands ride along without") {
  const Walk walk(scenes::flat());
  const mcplan::Plan plan = to_plan(walk.problem, walk.now);
  int foot_swings = 0;
  for (const mcplan::Swing& swing : plan.swings) {
    if (swing.end_effector >= 2) {
      CHECK(swing.height == 0.0);
      continue;
    }
    ++foot_swings;
    CHECK(swing.height >= 0.5 * plan.robot.swing_height);
    for (int k = swing.first_phase; k < swing.end_phase; ++k)
      CHECK(plan.phases[k].contacts[swing.end_effector].surface == kFree);
    const double middle = 0.5 * plan.phases[swing.first_phase].duration;
    if (swing.end_phase == swing.first_phase + 1)
      CHECK(plan.at_phase(swing.first_phase, middle).end_effectors[swing.end_effector].position_W.z() > 0.03);
  }
  int lifts = 0;
  for (int k = 1; k <= 18; ++k)
    for (int l : {0, 1}) lifts += walk.now.sequence[k][l] == kFree && walk.now.sequence[k - 1][l] != kFree;
  CHECK(foot_swings == lifts);
}

TEST_CASE("the tail of a plan, surfaces by name, and other robots") {
  const Walk walk(scenes::stairs());
  const mcplan::Plan plan = to_plan(walk.problem, walk.now);
  mcplan::Scene reordered = scenes::stairs();
  std::swap(reordered.surfaces[0], reordered.surfaces[3]);
  const Problem shorter(reordered, scenes::humanoid44(), phases(13));
  const Incumbent tail = from_plan(shorter, plan, 5);
  REQUIRE(tail.sequence.size() == 14);
  REQUIRE(tail.trajectory.u.size() == 13);
  for (int k = 1; k < 13; ++k) {
    CHECK((tail.trajectory.x[k] - walk.now.trajectory.x[k + 5]).norm() <= 1e-13);
    for (int l : {0, 1}) {
      const int was = walk.now.sequence[k + 5][l];
      CHECK(tail.sequence[k][l] == (was == 0 ? 3 : was == 3 ? 0 : was));
    }
  }
  mcplan::Robot one_armed = scenes::humanoid44();
  one_armed.end_effectors.pop_back();
  CHECK(from_plan(Problem(scenes::stairs(), one_armed, phases(18)), plan, 0).sequence.empty());
}
