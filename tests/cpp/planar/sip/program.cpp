#include "planar/sip/program.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "interval.hpp"
#include "mcplan/nlp/derivative_check.hpp"
#include "planar/robots.hpp"

using namespace mcplan::sip;
using mcplan::PlanarTask;

namespace {

/// Every derivative of the pieces of some intervals: the ends of the motion, both sides of a phase's end, a middle.
void check_pieces(const PlanarTask& task, Options options, const std::string& what, unsigned seed = 1) {
  options.torque_weight = 1e-3;
  options.jerk_weight = 1e-6;
  const Layout layout(task, options);
  Eigen::VectorXd x = planar_tasks::random_parameters(task, layout, seed);
  x.head(layout.first_duration) *= 0.5;
  Program program(task, options, Curvature::exact, 1.0, Eigen::VectorXd::Zero(layout.parameters));
  const int last = task.interval_count() - 1;
  std::set<std::vector<int>> chosen;
  for (int k : {0, 2, 3, 5, last - 1}) chosen.insert(LocalParameters(task, layout, k).variables);
  int pieces = 0;
  for (const auto& block : program.problem().blocks()) {
    const mcplan::nlp::Piece& piece = *block.piece;
    if (!chosen.count(piece.variables()) && piece.name() != "duration") continue;
    ++pieces;
    Eigen::VectorXd local(piece.size());
    for (int i = 0; i < local.size(); ++i) local[i] = x[piece.variables()[i]];
    const auto wrong = check_derivatives(piece, local, 2e-5);
    CAPTURE(what);
    CHECK(wrong.empty());
    if (!wrong.empty()) MESSAGE(wrong.front().to_string() << " and " << wrong.size() - 1 << " more");
  }
  CHECK(pieces >= 10);  // rows and cost of five intervals
}

std::string label(const PlanarTask& task, Forces forces, bool free) {
  return task.name + ", forces " + std::to_string(static_cast<int>(forces)) + (free ? ", phase durations" : "");
}

/// A task with everything in it: clearances, a pose, capsules.
PlanarTask with_everything() {
  PlanarTask task = planar_tasks::cartwheel();
  mcplan::PlanarPose pose;
  pose.body = 3;
  pose.fraction = 0.4;
  pose.min.setConstant(-1.0);
  pose.max.setConstant(1.0);
  task.phases[1].poses = {pose};
  return task;
}

}  // namespace

TEST_CASE("derivatives of every piece agree with central differences") {
  for (int number : {1, 2, 3})
    for (Forces forces : {Forces::uniform, Forces::per_body, Forces::per_point})
      for (bool free : {false, true}) {
        const PlanarTask task = planar_tasks::paper_task(number);
        Options options;
        options.forces = forces;
        options.free_durations = free;
        check_pieces(task, options, label(task, forces, free));
      }
}

TEST_CASE("derivatives of the less usual forms agree with central differences") {
  Options options;
  options.forces = Forces::parameters;
  check_pieces(planar_tasks::cartwheel(), options, "forces as parameters");
  options.forces = Forces::per_point;
  options.free_flyer = FreeFlyer::parameterised;
  check_pieces(planar_tasks::cartwheel(), options, "base parameterised");
  options.free_durations = false;
  check_pieces(planar_tasks::walking(), options, "base parameterised, one duration");
  options = Options();
  options.self_collision = true;
  options.min_normal_force = 5.0;
  options.duration_weight = 0.7;
  check_pieces(with_everything(), options, "collision, pose, clearance, pull");
  options = Options();
  options.contact = ContactMode::band;
  options.continuous = Continuous::grid;
  options.order = 5;
  check_pieces(planar_tasks::climbing(), options, "band on a grid");
  options.contact = ContactMode::strict;
  options.dynamics = false;
  check_pieces(planar_tasks::climbing(), options, "strict, kinematics alone");
  options = Options();
  options.order = 12;
  check_pieces(planar_tasks::cartwheel(), options, "order 12");
  options.order = 3;
  check_pieces(planar_tasks::cartwheel(), options, "order 3");

  // Phases of one interval: five durations in each interval's basis.
  PlanarTask hasty = planar::standing();
  hasty.phases.assign(8, hasty.phases[0]);
  for (auto& phase : hasty.phases) {
    phase.intervals = 1;
    phase.clearances.clear();
  }
  check_pieces(hasty, Options(), "phases of one interval");
}

TEST_CASE("the sparse structure leaves nothing out") {
  Options options;
  options.torque_weight = 1e-3;
  PlanarTask task = with_everything();
  const Layout layout(task, options);
  Program program(task, options, Curvature::exact, 1.0, Eigen::VectorXd::Zero(layout.parameters));
  const auto wrong = check_derivatives(program.problem(), planar_tasks::random_parameters(task, layout, 4) * 0.7, 1e-4);
  CHECK(wrong.empty());
  if (!wrong.empty()) MESSAGE(wrong.front().to_string());
}

TEST_CASE("a row's entries are among its interval's parameters: a band and an arrow") {
  for (int number : {1, 2, 3}) {
    const PlanarTask task = planar_tasks::paper_task(number);
    const Options options;
    Program program(task, options, Curvature::exact, 1.0, Eigen::VectorXd::Zero(Layout(task, options).parameters));
    std::vector<int> interval_of;
    for (int k = 0; k < program.intervals(); ++k)
      interval_of.insert(interval_of.end(), program.model(k).rows().count(), k);
    REQUIRE(static_cast<int>(interval_of.size()) == program.problem().row_count());
    for (const auto& entry : program.problem().jacobian_structure()) {
      const std::vector<int>& touched = program.model(interval_of[entry.row]).local().variables;
      CHECK(std::find(touched.begin(), touched.end(), entry.column) != touched.end());
    }
  }
}

TEST_CASE("cost and duration are sums of their parts") {
  const PlanarTask task = planar_tasks::cartwheel();
  Options options;
  options.torque_weight = 0.5;
  options.jerk_weight = 1e-4;
  options.duration_weight = 3.0;
  const Layout layout(task, options);
  const Eigen::VectorXd x = planar_tasks::random_parameters(task, layout, 2);
  Program program(task, options, Curvature::exact, 0.1, Eigen::VectorXd::Zero(layout.parameters));
  CHECK(program.duration(x) == doctest::Approx(plan_of(task, options, layout, x).duration()));
  CHECK(program.cost(x) ==
        doctest::Approx(0.5 * program.torque_cost(x) + 1e-4 * program.jerk_cost(x) + 3.0 * program.duration(x)));
  CHECK(program.problem().cost(x) == doctest::Approx(0.1 * program.cost(x)));
}

TEST_CASE("without a cost the objective is a weak pull to the anchor") {
  const PlanarTask task = planar_tasks::cartwheel();
  const Layout layout(task, {});
  const Eigen::VectorXd anchor = planar_tasks::random_parameters(task, layout, 2);
  const Eigen::VectorXd x = planar_tasks::random_parameters(task, layout, 3);
  Program program(task, {}, Curvature::exact, 0.0, anchor);
  CHECK(program.problem().cost(x) == doctest::Approx(0.5 * Program::kProximity * (x - anchor).squaredNorm()));
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(x.size());
  program.problem().gradient(x, gradient);
  CHECK((gradient - Program::kProximity * (x - anchor)).norm() < 1e-12);
}

TEST_CASE("durations are bounded by the options and by the task, whichever is narrower") {
  PlanarTask task = planar_tasks::cartwheel();
  task.phases[1].min_duration = 0.8;
  task.phases[2].max_duration = 1.5;
  Options options;
  options.phase_duration_s = {0.3, 2.0};
  options.total_duration_s = {1.0, 9.0};
  {
    const Layout layout(task, options);
    Program program(task, options, Curvature::exact, 0.0, Eigen::VectorXd::Zero(layout.parameters));
    const auto& lower = program.problem().variable_lower();
    const auto& upper = program.problem().variable_upper();
    const int d = layout.first_duration;
    CHECK(std::vector<double>(lower.begin() + d, lower.begin() + d + 3) == std::vector<double>{0.3, 0.8, 0.3});
    CHECK(std::vector<double>(upper.begin() + d, upper.begin() + d + 3) == std::vector<double>{2.0, 2.0, 1.5});
  }
  options.free_durations = false;  // intervals share the duration: 4 of 10 are phase 1's, 3 phase 2's
  const Layout layout(task, options);
  Program program(task, options, Curvature::exact, 0.0, Eigen::VectorXd::Zero(layout.parameters));
  CHECK(program.problem().variable_lower()[layout.first_duration] == doctest::Approx(0.8 * 10.0 / 4.0));
  CHECK(program.problem().variable_upper()[layout.first_duration] == doctest::Approx(1.5 * 10.0 / 3.0));
}

TEST_CASE("a task of one phase is bounded as a phase where phases have durations of their own") {
  PlanarTask task = planar::standing();
  task.phases.resize(1);
  Options options;
  options.free_durations = true;
  options.phase_duration_s = {0.25, 0.5};
  const Layout layout(task, options);
  Program program(task, options, Curvature::exact, 0.0, Eigen::VectorXd::Zero(layout.parameters));
  CHECK(program.problem().variable_lower()[layout.first_duration] == 0.25);
  CHECK(program.problem().variable_upper()[layout.first_duration] == 0.5);
  CHECK(zero_start(task, options, layout)[layout.first_duration] == 0.5);
}

TEST_CASE("the start is the zero posture within one second, as far as bounds allow") {
  PlanarTask task = planar_tasks::cartwheel();
  Options options;
  const Layout layout(task, options);
  const Eigen::VectorXd x = zero_start(task, options, layout);
  CHECK(x.head(layout.first_duration).norm() == 0.0);
  CHECK(x.tail(layout.parameters - layout.first_duration - 3).norm() == 0.0);
  CHECK((x.segment<3>(layout.first_duration) - Eigen::Vector3d(0.3, 0.4, 0.3)).norm() < 1e-15);

  task.phases[0].min_duration = 0.7;
  CHECK(zero_start(task, options, layout)[layout.first_duration] == 0.7);
  options.free_durations = false;
  options.total_duration_s = {3.0, 4.0};
  const Layout one(task, options);
  CHECK(zero_start(task, options, one)[one.first_duration] == 3.0);
}
