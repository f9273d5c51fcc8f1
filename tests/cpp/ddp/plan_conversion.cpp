#include "ddp/plan_conversion.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "ddp/stepping_sequence.hpp"
#include "mcplan/base/rotation.hpp"
#include "mcplan/plan/checker.hpp"
#include "plan/clearance.hpp"
#include "support.hpp"

namespace {

using mcplan::Deadline;
using namespace support;
using namespace mcplan::ddp;

/// A polished and exact walk.
struct Walk {
  explicit Walk(const mcplan::Scene& scene, Model model = Options().model, StiffnessInput input = StiffnessInput::mu)
      : problem(scene, scenes::humanoid44(), options(model, input)) {
    const Deadline deadline(1e9);
    mcplan::Report report;
    Search search(problem, deadline, report);
    now.sequence = stepping_sequence(problem, 0);
    REQUIRE_FALSE(now.sequence.empty());
    now.trajectory = problem.initial_guess(now.sequence);
    search.polish(now, 80, 1e-5, std::numeric_limits<double>::infinity(), problem.tuning());
    REQUIRE(search.make_exact(now, problem.tuning()));
  }
  static Options options(Model model, StiffnessInput input) {
    Options out = phases(18, model);
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
  mcplan::Scene turning = scenes::stairs();
  turning.goal.yaw = 0.4;
  for (Model model : kModels)
    for (auto input : {StiffnessInput::mu, StiffnessInput::lambda}) {
      CAPTURE(name(model));
      const Walk walk(turning, model, input);
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
      // Headings of soles follow from the motion. Plans of the paper's model have none.
      CHECK(plan.knots[0].end_effector_yaw.empty() == (model == Model::lipm));
      if (model == Model::lipm) continue;
      Trajectory expected = walk.now.trajectory;
      walk.problem.set_sole_yaw(walk.now.sequence, expected);
      for (int k = 0; k <= 18; ++k)
        for (int l : {0, 1}) CHECK(back.trajectory.sole_yaw[k][l] == doctest::Approx(expected.sole_yaw[k][l]));
    }
}

TEST_CASE("a plan of one model is a first guess of the other") {
  for (Model from : kModels) {
    const Walk walk(scenes::stairs(), from);
    const mcplan::Plan plan = to_plan(walk.problem, walk.now);
    const Model to = from == Model::wrench ? Model::lipm : Model::wrench;
    const Problem other(scenes::stairs(), scenes::humanoid44(), phases(18, to));
    const Incumbent back = from_plan(other, plan, 0);
    CHECK(back.sequence == walk.now.sequence);
    const Layout &there = walk.problem.layout, &here = other.layout;
    for (int k = 0; k <= 18; ++k) {
      const VectorXd &was = walk.now.trajectory.x[k], &is = back.trajectory.x[k];
      CHECK((is.segment<6>(here.com()) - was.segment<6>(there.com())).norm() <= 1e-13);
      CHECK((is.tail(6) - was.tail(6)).norm() <= 1e-13);
      CHECK(other.rpy(is).z() == doctest::Approx(walk.problem.rpy(was).z()));
      REQUIRE(back.trajectory.sole_yaw[k].size() == 2);
      if (k == 18) break;
      const VectorXd &input = walk.now.trajectory.u[k], &u = back.trajectory.u[k];
      for (int l : {0, 1}) CHECK(u[here.stiffness(l)] == doctest::Approx(input[there.stiffness(l)]));
      CHECK(u[here.duration()] == doctest::Approx(input[there.duration()]));
      // Nothing is made up: what the paper's model does not have is zero.
      if (to == Model::wrench)
        for (int l : {0, 1}) CHECK((here.line_point(is, u, l) - is.segment<3>(here.end(l))).norm() == 0.0);
    }
  }
}

TEST_CASE("contact wrenches in the plan: where they act, what they point away from, momentum and headings") {
  mcplan::Scene scene = scenes::flat();
  scene.start.yaw = 0.1;
  scene.goal.yaw = 0.7;
  const Walk walk(scene);
  const Layout& at = walk.problem.layout;
  const mcplan::Plan plan = to_plan(walk.problem, walk.now);
  double most_pressure = 0.0, most_line = 0.0, most_moment = 0.0;
  for (int k = 0; k < 18; ++k) {
    const VectorXd &x = walk.now.trajectory.x[k], &u = walk.now.trajectory.u[k];
    const mcplan::Phase& phase = plan.phases[k];
    CHECK(std::holds_alternative<mcplan::laws::Wrench>(phase.law));
    for (int l : {0, 1}) {
      const mcplan::Contact& contact = phase.contacts[l];
      if (contact.surface == kFree) continue;
      const Eigen::Vector3d foot = x.segment<3>(at.end(l)) * 0.7;
      const Eigen::Vector3d pressure = contact.center_of_pressure_W - foot;
      const Eigen::Vector3d line = contact.anchor_W - contact.center_of_pressure_W;
      CHECK((pressure - at.pressure_offset(u, l) * 0.7).norm() <= 1e-15);
      CHECK((line - at.line_offset(u, l) * 0.7).norm() <= 1e-15);
      most_pressure = std::max(most_pressure, pressure.norm());
      most_line = std::max(most_line, line.norm());
      const Eigen::Matrix3d sole = mcplan::sole_frame(Eigen::Vector3d::UnitZ(), plan.knots[k].end_effector_yaw[l]);
      CHECK(std::abs(sole.col(0).dot(pressure)) <= 0.10 + 1e-12);
      CHECK(std::abs(sole.col(1).dot(pressure)) <= 0.05 + 1e-12);
      CHECK(contact.moment_W.head<2>().norm() == 0.0);
      CHECK(std::abs(contact.moment_W.z()) <= 1.0 + 1e-12);
      most_moment = std::max(most_moment, std::abs(contact.moment_W.z()));
      // Held from the knot at which the contact begins to the end of its last phase.
      if (k + 1 < 18 && plan.phases[k + 1].contacts[l].surface != kFree)
        CHECK(plan.knots[k].end_effector_yaw[l] == plan.knots[k + 1].end_effector_yaw[l]);
    }
  }
  MESSAGE("centre of pressure up to ", most_pressure, " m, force line ", most_line, " m, moment ", most_moment, " Nm");
  CHECK(most_pressure > 1e-3);
  CHECK(most_line > 1e-3);
  const double unit = 44.0 * 0.7 * std::sqrt(9.8 * 0.7);
  for (int k = 0; k <= 18; ++k) {
    const mcplan::Knot& knot = plan.knots[k];
    CHECK((knot.angular_momentum_W - walk.now.trajectory.x[k].segment<3>(at.momentum()) * unit).norm() <= 1e-12);
    // The base's rates are those of its momentum.
    const Eigen::Matrix3d r = mcplan::rotation_from_rpy(knot.base_rpy);
    const Eigen::Vector3d omega = r * (r.transpose() * knot.angular_momentum_W / 5.0);
    Eigen::Matrix3d turning = Eigen::Matrix3d::Zero();
    for (int i = 0; i < 3; ++i)
      turning += knot.base_rpy_rate[i] * mcplan::rotation_derivative(knot.base_rpy, i) * r.transpose();
    CHECK((Eigen::Vector3d(turning(2, 1), turning(0, 2), turning(1, 0)) - omega).norm() <= 1e-12);
    REQUIRE(knot.end_effector_yaw.size() == 4);
    for (int hand : {2, 3}) CHECK(knot.end_effector_yaw[hand] == knot.base_rpy.z());
  }
  for (int l : {0, 1}) {
    CHECK(plan.knots.front().end_effector_yaw[l] == 0.1);
    CHECK(plan.knots.back().end_effector_yaw[l] == 0.7);
  }
  // Plan::at works from what the plan says and must arrive where the trajectory is.
  for (int k = 0; k < 18; ++k) {
    const mcplan::PlanState end = plan.at_phase(k, plan.phases[k].duration);
    CHECK((end.com_W - plan.knots[k + 1].com_W).norm() <= 1e-11);
    CHECK((end.angular_momentum_W - plan.knots[k + 1].angular_momentum_W).norm() <= 1e-11);
    CHECK((end.base_rpy - plan.knots[k + 1].base_rpy).norm() <= 1e-11);
  }
}

TEST_CASE("the plan is in SI units, obeys the dynamics, and touches where the sequence says") {
  for (Model model : kModels) {
    CAPTURE(name(model));
    const Walk walk(scenes::flat(), model);
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
