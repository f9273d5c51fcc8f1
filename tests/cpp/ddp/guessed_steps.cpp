#include "ddp/guessed_steps.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;
using Eigen::Vector3d;

mcplan::Scene strips(const std::vector<std::array<double, 3>>& from_to_height, double goal_x) {
  mcplan::Scene scene = scenes::flat();
  scene.surfaces.clear();
  for (std::size_t i = 0; i < from_to_height.size(); ++i) {
    const auto& [from, to, height] = from_to_height[i];
    scene.surfaces.push_back(scenes::rectangle("strip_" + std::to_string(i), from, to, -1.0, 1.0, height));
  }
  scene.start.contacts = {{"foot", scene.surfaces.front().name}};
  scene.goal.contacts = {{"foot", scene.surfaces.back().name}};
  scene.goal.position_W = {goal_x, 0.0, from_to_height.back()[2]};
  return scene;
}

/// Feet in turn, each step within what both boxes leave beside the foot that stands, to the goal.
void check_walk(const Problem& problem, const GuessedSteps& guess) {
  REQUIRE(!guess.empty());
  CHECK(guess.phases() == 2 * static_cast<int>(guess.steps.size()) + 2);
  CHECK(guess.price >= static_cast<double>(guess.steps.size()));
  std::array<Vector3d, 2> feet;
  for (int l : {0, 1}) feet[l] = problem.start.segment<3>(problem.layout.end(l));
  int last = -1;
  for (const GuessedStep& step : guess.steps) {
    CHECK(step.l != last);
    last = step.l;
    feet[step.l] = step.place;
    CHECK(problem.polygons[step.surface].outside(step.place) < 1e-9);
    CHECK(std::abs(problem.polygons[step.surface].height(step.place)) < 1e-9);
    const EndLimits& limits = problem.limits[step.l];
    const Vector3d off = step.place - feet[1 - step.l];
    CHECK(off.x() <= limits.reach_max.x() - limits.reach_min.x() + 1e-9);
    const double side = limits.nominal.y() > 0.0 ? 1.0 : -1.0;
    CHECK(side * off.y() >= 2.0 * 0.05 / problem.units.length - 1e-9);  // soles are 0.1 m wide
    CHECK(side * off.y() <= 2.0 * 0.15 / problem.units.length + 1e-9);
  }
  for (int l : {0, 1}) CHECK(feet[l].isApprox(problem.reference.x.back().segment<3>(problem.layout.end(l)), 1e-9));
}

}  // namespace

TEST_CASE("feet step in turn from start to goal, onto a block and down again as well") {
  for (const double height : {0.0, 0.06, 0.12}) {
    CAPTURE(height);
    const Problem problem(strips({{-1.0, 0.4, 0.0}, {0.4, 1.4, height}, {1.4, 3.0, 0.0}}, 2.0), scenes::humanoid44(),
                          phases(18));
    const GuessedSteps guess = guessed_steps(problem);
    check_walk(problem, guess);
    const auto on_block = [](const GuessedStep& step) { return step.surface == 1; };
    CHECK(std::any_of(guess.steps.begin(), guess.steps.end(), on_block));
  }
}

TEST_CASE("shorter strides are more steps, and what is higher is dearer") {
  const Problem flat(strips({{-1.0, 4.0, 0.0}}, 2.0), scenes::humanoid44(), phases(18));
  CHECK(guessed_steps(flat, 0.5).steps.size() > guessed_steps(flat, 1.0).steps.size());
  double last = guessed_steps(flat).price;
  for (const double height : {0.08, 0.16}) {
    const Problem up(strips({{-1.0, 0.5, 0.0}, {0.5, 4.0, height}}, 2.0), scenes::humanoid44(), phases(18));
    const double price = guessed_steps(up).price;
    CHECK(price > last);
    last = price;
  }
}

TEST_CASE("the way at the knots is that of the middle of the feet, and the reference of a problem goes so") {
  const mcplan::Scene scene = strips({{-1.0, 0.5, 0.0}, {0.5, 1.2, 0.1}, {1.2, 4.0, 0.0}}, 2.0);
  const GuessedSteps guess = guessed_steps(Problem(scene, scenes::humanoid44(), phases(18)));
  REQUIRE(!guess.empty());
  CHECK(!guess.even);
  CHECK(guessed_steps(Problem(strips({{-1.0, 4.0, 0.0}}, 2.0), scenes::humanoid44(), phases(18))).even);
  Course course;
  course.progress = guess.progress(guess.phases());
  REQUIRE(static_cast<int>(course.progress.size()) == guess.phases() + 1);
  CHECK((course.progress.front() == 0.0 && course.progress.back() == 1.0));
  for (int k = 0; k < guess.phases(); ++k) CHECK(course.progress[k] <= course.progress[k + 1]);
  const Problem problem(scene, scenes::humanoid44(), phases(guess.phases()), course);
  const ContactSequence sequence = sequence_of(problem, guess);
  const Trajectory motion = guess_of(problem, sequence, guess, problem.tuning());
  const double unit = problem.units.length;
  for (int k = 2; k < 2 * static_cast<int>(guess.steps.size()); k += 2) {
    // Footholds are a few centimetres apart, and are moved by half of that on narrow ground.
    const double reference_x = problem.reference.x[k][problem.layout.com()];
    CHECK(unit * reference_x == doctest::Approx(unit * motion.x[k][problem.layout.com()]).epsilon(0.03));
  }
  const double rate = problem.reference.x[4][problem.layout.velocity()] * 2.0 * problem.duration_initial;
  CHECK(rate ==
        doctest::Approx(problem.reference.x[5][problem.layout.com()] - problem.reference.x[3][problem.layout.com()]));
  // In other phases it is the paper's cubic.
  const Problem other(scene, scenes::humanoid44(), phases(18), course);
  CHECK(other.reference.x[9][other.layout.com()] * unit == doctest::Approx(1.0));
}

TEST_CASE("turning on the spot takes steps, too") {
  mcplan::Scene scene = strips({{-1.0, 1.0, 0.0}}, 0.0);
  scene.goal.yaw = 1.5;
  const Problem problem(scene, scenes::humanoid44(), phases(18));
  CHECK(guessed_steps(problem).steps.size() >= 3);
}

TEST_CASE("where no step leads across there are none, and none for who stands on hands or four feet") {
  const auto humanoid = scenes::humanoid44();
  const Problem gap(strips({{-1.0, 0.4, 0.0}, {1.4, 3.0, 0.0}}, 2.0), humanoid, phases(18));
  CHECK(guessed_steps(gap).empty());
  const Problem wall(strips({{-1.0, 0.4, 0.0}, {0.4, 3.0, 0.6}}, 2.0), humanoid, phases(18));
  CHECK(guessed_steps(wall).empty());
  mcplan::Scene rail = strips({{-1.0, 3.0, 0.0}}, 1.0);
  rail.surfaces.push_back(scenes::rectangle("rail", -0.5, 0.5, -0.4, -0.2, 0.7, "hand"));
  rail.start.contacts["right_hand"] = "rail";
  CHECK(guessed_steps(Problem(rail, humanoid, phases(18))).empty());
  mcplan::Robot four = humanoid;
  for (int l : {2, 3}) {
    four.end_effectors[l] = humanoid.end_effectors[l - 2];
    four.end_effectors[l].name += "_behind";
  }
  CHECK(guessed_steps(Problem(strips({{-1.0, 3.0, 0.0}}, 1.0), four, phases(18))).empty());
}

TEST_CASE("the sequence and the first guess are those of the steps") {
  const mcplan::Scene scene = strips({{-1.0, 0.4, 0.0}, {0.4, 0.9, 0.1}, {0.9, 3.0, 0.0}}, 1.5);
  const GuessedSteps guess = guessed_steps(Problem(scene, scenes::humanoid44(), phases(18)));
  REQUIRE(!guess.empty());
  for (const int more : {0, 3}) {
    const Problem problem(scene, scenes::humanoid44(), phases(guess.phases() + more));
    const ContactSequence sequence = sequence_of(problem, guess);
    REQUIRE(static_cast<int>(sequence.size()) == problem.steps + 1);
    CHECK(problem.rules.valid(sequence));
    const Trajectory motion = guess_of(problem, sequence, guess, problem.tuning());
    for (std::size_t i = 0; i < guess.steps.size(); ++i) {
      const GuessedStep& step = guess.steps[i];
      const int swing = 2 * static_cast<int>(i) + 1;
      CHECK(sequence[swing][step.l] == kFree);
      CHECK(sequence[swing + 1][step.l] == step.surface);
      CHECK(motion.x[swing + 1].segment<3>(problem.layout.end(step.l)).isApprox(step.place, 1e-12));
    }
    for (int k = 0; k < problem.steps; ++k)
      for (int l : {0, 1}) {
        const int at = problem.layout.end(l);
        const Vector3d way = motion.x[k + 1].segment<3>(at) - motion.x[k].segment<3>(at);
        CHECK((motion.u[k].segment<3>(problem.layout.stride(l)) - way).norm() < 1e-12);
        if (sequence[k][l] != kFree) CHECK(way.norm() < 1e-12);
      }
  }
  CHECK(sequence_of(Problem(scene, scenes::humanoid44(), phases(guess.phases() - 4)), guess).empty());
  CHECK(sequence_of(Problem(scene, scenes::humanoid44(), phases(18)), GuessedSteps()).empty());
}
