#include "mcplan/planar/task.hpp"

#include <doctest/doctest.h>

#include <functional>

#include "planar/robots.hpp"

namespace {

using mcplan::PlanarTask;
using M = PlanarTask;

struct Error {
  std::string field, rule;
};

Error error(const std::function<void(M&)>& mutate) {
  M task = planar::standing();
  mutate(task);
  try {
    task.validate();
  } catch (const mcplan::InvalidPlanarTask& found) {
    return {found.field(), found.rule()};
  }
  return {"accepted", ""};
}

std::string field(const std::function<void(M&)>& mutate) { return error(mutate).field; }

/// The right foot further ahead by dx from phase k on.
void step(M& task, std::size_t k, double dx) {
  for (std::size_t i = k; i < task.phases.size(); ++i) task.phases[i].contacts[1].position_W.x() += dx;
}

}  // namespace

TEST_CASE("a surface's normal is to the left of its tangent") {
  mcplan::PlanarSurface wall;
  wall.angle = -M_PI / 2.0;
  CHECK((wall.tangent_W() - Eigen::Vector2d(0.0, -1.0)).norm() < 1e-15);
  CHECK((wall.normal_W() - Eigen::Vector2d(1.0, 0.0)).norm() < 1e-15);
}

TEST_CASE("intervals are counted phase by phase") {
  M task = planar::standing();
  task.phases[0].intervals = 3;
  task.phases[1].intervals = 5;
  CHECK(task.interval_count() == 12);
  CHECK(task.first_interval(0) == 0);
  CHECK(task.first_interval(2) == 8);
  CHECK(task.phase_of(2) == 0);
  CHECK(task.phase_of(3) == 1);
  CHECK(task.phase_of(7) == 1);
  CHECK(task.phase_of(11) == 2);
}

TEST_CASE("a valid task is accepted; whole turns of a contact count for the robot, not for the surface") {
  CHECK(field([](M&) {}) == "accepted");
  CHECK(field([](M& m) {
          for (auto& phase : m.phases) phase.contacts[0].angle = 2.0 * M_PI;
        }) == "accepted");
}

TEST_CASE("the robot's errors are those of the robot") {
  M task = planar::standing();
  task.robot.bodies[2].mass = 0.0;
  CHECK_THROWS_AS(task.validate(), mcplan::InvalidRobot);
}

TEST_CASE("the field of a task that is out of its range is named") {
  CHECK(field([](M& m) { m.surfaces.clear(); }) == "surfaces");
  CHECK(field([](M& m) { m.surfaces[0].name = ""; }) == "surfaces[0].name");
  CHECK(field([](M& m) { m.surfaces.push_back(m.surfaces[0]); }) == "surfaces[1].name");
  CHECK(field([](M& m) { m.surfaces[0].origin_W.x() = NAN; }) == "surfaces[0].origin[0]");
  CHECK(field([](M& m) { m.surfaces[0].angle = HUGE_VAL; }) == "surfaces[0].angle");
  for (double bad : {0.0, -0.5, std::nan(""), HUGE_VAL})
    CHECK(field([bad](M& m) { m.surfaces[0].friction = bad; }) == "surfaces[0].friction");
  CHECK(field([](M& m) { m.surfaces[0].from = HUGE_VAL; }) == "surfaces[0].to");

  CHECK(field([](M& m) { m.phases.clear(); }) == "phases");
  CHECK(field([](M& m) { m.phases[1].intervals = 0; }) == "phases[1].intervals");
  CHECK(field([](M& m) { m.phases[1].max_duration = 0.0; }) == "phases[1].max_duration");
  CHECK(field([](M& m) { m.phases[1].min_duration = -1.0; }) == "phases[1].min_duration");
  CHECK(field([](M& m) {
          m.phases[1].min_duration = 2.0;
          m.phases[1].max_duration = 1.0;
        }) == "phases[1].max_duration");
  CHECK(field([](M& m) { m.phases[1].contacts.clear(); }) == "phases[1].contacts");
  CHECK(field([](M& m) { m.phases[1].contacts[0].end_effector = 3; }) == "phases[1].contacts[0].end_effector");
  CHECK(field([](M& m) { m.phases[1].contacts[0].surface = -1; }) == "phases[1].contacts[0].surface");
  CHECK(field([](M& m) { m.phases[1].contacts[1] = m.phases[1].contacts[0]; }) == "phases[1].contacts[1].end_effector");

  CHECK(field([](M& m) { m.phases[1].clearances[0].end_effector = 7; }) == "phases[1].clearances[0].end_effector");
  CHECK(field([](M& m) { m.phases[1].clearances[0].end_effector = planar::left_foot; }) ==
        "phases[1].clearances[0].end_effector");  // in contact
  CHECK(field([](M& m) { m.phases[1].clearances[0].first_interval = 4; }) == "phases[1].clearances[0].first_interval");
  CHECK(field([](M& m) { m.phases[1].clearances[0].end_interval = 1; }) == "phases[1].clearances[0].end_interval");
  CHECK(field([](M& m) { m.phases[1].clearances[0].end_interval = 5; }) == "phases[1].clearances[0].end_interval");
  CHECK(field([](M& m) { m.phases[1].clearances[0].middle_height = NAN; }) == "phases[1].clearances[0].middle_height");
  CHECK(field([](M& m) { m.phases[1].clearances[0].surface = 1; }) == "phases[1].clearances[0].surface");
  CHECK(field([](M& m) { m.no_clearance = {{planar::hand, 0}}; }) == "phases[0].clearances[0].surface");
  CHECK(field([](M& m) { m.no_clearance = {{3, 0}}; }) == "no_clearance[0].end_effector");
  CHECK(field([](M& m) { m.no_clearance = {{planar::left_foot, 1}}; }) == "no_clearance[0].surface");
  const mcplan::PlanarNoClearance pair{planar::left_foot, 0};
  CHECK(field([&](M& m) { m.no_clearance = {pair}; }) == "accepted");
  CHECK(field([&](M& m) { m.no_clearance = {pair, pair}; }) == "no_clearance[1].surface");
  CHECK(field([](M& m) { m.phases[1].poses[0].body = 6; }) == "phases[1].poses[0].body");
  CHECK(field([](M& m) { m.phases[1].poses[0].fraction = 1.01; }) == "phases[1].poses[0].fraction");
  CHECK(field([](M& m) { m.phases[1].poses[0].fraction = NAN; }) == "phases[1].poses[0].fraction");
  CHECK(error([](M& m) { m.phases[1].poses[0].max[2] = -1.0; }).rule == "must not be below min in angle");
}

TEST_CASE("a contact off its surface, beyond its extent or turned against it is named") {
  CHECK(error([](M& m) { m.phases[1].contacts[1].position_W.y() = 1e-3; }).rule == "must lie on surface \"ground\"");
  CHECK(field([](M& m) { m.phases[1].contacts[1].position_W.x() = NAN; }) == "phases[1].contacts[1].position[0]");
  CHECK(field([](M& m) { m.phases[1].contacts[1].angle = 1e-3; }) == "phases[1].contacts[1].angle");
  CHECK(field([](M& m) { m.phases[1].contacts[1].angle = M_PI; }) == "phases[1].contacts[1].angle");
  // The right foot's points reach to foot_x + 0.1.
  const double edge = planar::foot_x() + planar::kHalfSole;
  CHECK(field([edge](M& m) { m.surfaces[0].to = edge; }) == "accepted");
  CHECK(field([edge](M& m) { m.surfaces[0].to = edge - 1e-3; }) == "phases[0].contacts[1].position");
}

TEST_CASE("two contacts further apart than the limbs between them can stretch are named") {
  // Ankle to ankle through both hips, which are at one place, and the soles.
  const double stretch = 2.0 * (planar::kLeg + planar::kAnkle);
  const double spare = stretch - 2.0 * planar::foot_x();
  CHECK(field([spare](M& m) { step(m, 0, spare - 1e-3); }) == "accepted");
  const Error found = error([spare](M& m) { step(m, 0, spare + 1e-3); });
  CHECK(found.field == "phases[0].contacts[1].position");
  CHECK(found.rule.find("of \"left_foot\", all that the limbs between them can stretch") != std::string::npos);
}

TEST_CASE("nothing jumps from one phase to the next") {
  CHECK(error([](M& m) { step(m, 1, 0.1); }).rule.find("which it does not leave") != std::string::npos);
  // Lifted in between, the foot may come down elsewhere.
  CHECK(field([](M& m) {
          m.phases[1].contacts.pop_back();
          step(m, 2, 0.1);
        }) == "accepted");
  // One foot after the other: at the instant between the two phases both are on the ground.
  const auto hop = [](double to) {
    return [to](M& m) {
      m.phases[1].contacts.pop_back();
      m.phases[2].contacts = {m.phases[2].contacts[1]};
      m.phases[2].contacts[0].position_W.x() = to;
    };
  };
  CHECK(field(hop(1.0)) == "accepted");
  CHECK(field(hop(2.0)) == "phases[2].contacts[0].position");
}
