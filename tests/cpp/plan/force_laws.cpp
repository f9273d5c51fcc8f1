#include "mcplan/plan/force_laws.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>
#include <string>

#include "mcplan/plan/checker.hpp"
#include "plan/force_laws.hpp"

namespace {

using namespace fixtures;
using mcplan::Contact;
using mcplan::Phase;
using mcplan::Plan;
using mcplan::PlanState;

/// The force of a contact [N] as the law's equation has it, of the CoM at an instant.
Vector3d force(mcplan::laws::Pendulum /*law*/, const Plan& plan, const Phase& phase, int l, double /*t*/,
               const Vector3d& com) {
  const Contact& contact = phase.contacts[l];
  return plan.robot.mass * contact.stiffness * (com - contact.anchor_W);
}

Vector3d force(mcplan::laws::Wrench /*law*/, const Plan& plan, const Phase& phase, int l, double t,
               const Vector3d& com) {
  return force(mcplan::laws::Pendulum(), plan, phase, l, t, com);
}

Vector3d force(mcplan::laws::Held /*law*/, const Plan& /*plan*/, const Phase& phase, int l, double t,
               const Vector3d& /*com*/) {
  const Contact& contact = phase.contacts[l];
  const int n = static_cast<int>(contact.points_W.size()), j = static_cast<int>(t / phase.duration * phase.intervals);
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < n; ++i) sum += contact.point_forces_W[j * n + i];
  return sum;
}

Vector3d force(mcplan::laws::Linear /*law*/, const Plan& /*plan*/, const Phase& phase, int l, double t,
               const Vector3d& /*com*/) {
  const Contact& contact = phase.contacts[l];
  const int n = static_cast<int>(contact.points_W.size()), j = static_cast<int>(t / phase.duration * phase.intervals);
  const double s = t / phase.duration * phase.intervals - j;
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < n; ++i)
    sum += (1.0 - s) * contact.point_forces_W[j * n + i] + s * contact.point_forces_W[(j + 1) * n + i];
  return sum;
}

/// At 13 instants of each phase, none of them within a step of differences of one between two intervals.
template <class Use>
void for_each_instant(const Plan& plan, const Use& use) {
  for (int k = 0; k < static_cast<int>(plan.phases.size()); ++k)
    for (int i = 0; i < 13; ++i) use(k, plan.phases[k].duration * (i + 0.37) / 13);
}

}  // namespace

TEST_CASE("under every law contact forces are those of its equation, and zero in the air") {
  for_each_law([](auto law) {
    const std::string name = law.name;
    CAPTURE(name);
    const Plan plan = plan_under(law);
    REQUIRE(std::holds_alternative<decltype(law)>(plan.phases[0].law));
    for_each_instant(plan, [&](int k, double t) {
      const PlanState state = plan.at_phase(k, t);
      for (int l = 0; l < 4; ++l) {
        const Vector3d expected = force(law, plan, plan.phases[k], l, t, state.com_W);
        CHECK((state.end_effectors[l].force_W - expected).norm() < 1e-10);
        if (plan.phases[k].contacts[l].surface < 0) CHECK(state.end_effectors[l].force_W.norm() == 0.0);
      }
    });
  });
}

TEST_CASE("under every law velocity, acceleration and moments are the differences of what they belong to") {
  for_each_law([](auto law) {
    const std::string name = law.name;
    CAPTURE(name);
    const Plan plan = plan_under(law);
    const double h = 1e-5, mass = plan.robot.mass;
    for_each_instant(plan, [&](int k, double t) {
      const PlanState before = plan.at_phase(k, t - h), at = plan.at_phase(k, t), after = plan.at_phase(k, t + h);
      CHECK(((after.com_W - before.com_W) / (2 * h) - at.com_velocity_W).norm() < 1e-7);
      CHECK(((after.com_velocity_W - before.com_velocity_W) / (2 * h) - at.com_acceleration_W).norm() < 1e-6);
      CHECK(((after.base_rpy - before.base_rpy) / (2 * h) - at.base_rpy_rate).norm() < 1e-3);
      Vector3d push(0, 0, -mass * kGravity), moment = Vector3d::Zero();
      for (const auto& end : at.end_effectors) {
        push += end.force_W;
        moment += end.moment_W + (end.position_W - at.com_W).cross(end.force_W);
      }
      CHECK((push - mass * at.com_acceleration_W).norm() < 1e-9);
      CHECK(((after.angular_momentum_W - before.angular_momentum_W) / (2 * h) - moment).norm() < 1e-3);
    });
  });
}

TEST_CASE("the checker, which derives every law again, finds the same dynamics, and one newton too many in any law") {
  for_each_law([](auto law) {
    const std::string name = law.name;
    CAPTURE(name);
    const auto severity_of = [](const Plan& plan, const std::string& constraint) {
      for (const auto& found : mcplan::check(plan, plan.scene, plan.robot).constraints)
        if (found.name == constraint) return found.value / found.tolerance;
      return -1.0;
    };
    Plan plan = plan_under(law);
    CHECK(severity_of(plan, "at_consistency") < 1.0);
    CHECK(severity_of(plan, "dynamics") < 1.0);
    Contact& contact = plan.phases[0].contacts[left_foot];
    if (law.has_points)
      for (Vector3d& each : contact.point_forces_W) each.z() += 0.25;
    else
      contact.stiffness += 1.0 / (plan.robot.mass * (plan.knots[0].com_W - contact.anchor_W).z());
    CHECK(severity_of(plan, "at_consistency") < 1.0);
    CHECK(severity_of(plan, "dynamics") > 1.0);
  });
}

TEST_CASE("a phase of every law passes through a file unchanged") {
  std::mt19937 rng(7);
  std::normal_distribution<double> noise(0.0, 1e-3);
  for_each_law([&](auto law) {
    const std::string name = law.name;
    CAPTURE(name);
    Plan plan = plan_under(law);
    for (Phase& phase : plan.phases) {
      phase.duration += 0.01 * std::abs(noise(rng));
      for (Contact& contact : phase.contacts) {
        for (Vector3d& each : contact.point_forces_W) each.x() += noise(rng);
        if (contact.surface < 0 || law.has_points) continue;
        contact.stiffness += std::abs(noise(rng));
        for (Vector3d* each : {&contact.anchor_W, &contact.moment_W, &contact.center_of_pressure_W})
          each->y() += noise(rng);
      }
    }
    const Plan back = mcplan::plan_from_json(mcplan::plan_to_json(plan));
    REQUIRE(back.phases.size() == plan.phases.size());
    for (std::size_t k = 0; k < plan.phases.size(); ++k) {
      CHECK(back.phases[k].law == plan.phases[k].law);
      CHECK(back.phases[k].intervals == plan.phases[k].intervals);
      CHECK(back.phases[k].duration == plan.phases[k].duration);
    }
    CHECK(back == plan);
  });
}

TEST_CASE("what a phase says of its law are that law's own words, and names differ") {
  std::set<std::string> names;
  for_each_law([&](auto law) {
    const std::string name = law.name;
    CAPTURE(name);
    Phase phase;
    phase.law = law;
    phase.intervals = law.has_points ? 4 : 0;
    CHECK(phase.has_points() == law.has_points);
    CHECK(phase.has_momentum() == law.has_momentum);
    CHECK(phase.has_wrenches() == law.has_wrenches);
    CHECK(phase.node_count() == law.node_count(phase.intervals));
    names.insert(law.name);
  });
  CHECK(names == std::set<std::string>{"pendulum", "held", "linear", "wrench"});
  Phase phase;
  phase.intervals = 4;
  phase.law = mcplan::laws::Held();
  CHECK(phase.node_count() == 4);
  phase.law = mcplan::laws::Linear();
  CHECK(phase.node_count() == 5);
  CHECK(mcplan::ForceLaw() == mcplan::ForceLaw(mcplan::laws::Pendulum()));
  CHECK(mcplan::ForceLaw() != mcplan::ForceLaw(mcplan::laws::Wrench()));
}
