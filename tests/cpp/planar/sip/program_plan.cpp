// Parameters of a program and plans, one made into the other.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "interval.hpp"
#include "planar/robots.hpp"

using namespace mcplan::sip;
using mcplan::PlanarPlan;
using mcplan::PlanarTask;

namespace {

Options with(Forces forces, bool free_durations, FreeFlyer free_flyer = FreeFlyer::computed) {
  Options options;
  options.forces = forces;
  options.free_durations = free_durations;
  options.free_flyer = free_flyer;
  return options;
}

PlanarPlan random_plan(const PlanarTask& task, const Options& options, unsigned seed) {
  const Layout layout(task, options);
  return plan_of(task, options, layout, planar_tasks::random_parameters(task, layout, seed));
}

/// The field that parameters_of() complains about.
std::string field(const std::function<void(PlanarPlan&)>& mutate, Forces forces = Forces::per_point) {
  const PlanarTask task = planar_tasks::cartwheel();
  const Options options = with(forces, true);
  PlanarPlan plan = random_plan(task, options, 1);
  mutate(plan);
  try {
    parameters_of(plan, task, options, Layout(task, options));
  } catch (const mcplan::InvalidPlan& error) {
    return error.field();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("parameters, made into a plan and back, are what they were") {
  for (int number : {1, 2, 3})
    for (Forces forces : {Forces::uniform, Forces::per_body, Forces::per_point, Forces::parameters})
      for (bool free : {false, true})
        for (FreeFlyer free_flyer : {FreeFlyer::computed, FreeFlyer::parameterised}) {
          const PlanarTask task = planar_tasks::paper_task(number);
          const Options options = with(forces, free, free_flyer);
          const Layout layout(task, options);
          const Eigen::VectorXd x = planar_tasks::random_parameters(task, layout, 5);
          const PlanarPlan plan = plan_of(task, options, layout, x);
          plan.validate();
          CAPTURE(task.name);
          CAPTURE(static_cast<int>(forces));
          CAPTURE(free);
          CHECK((parameters_of(plan, task, options, layout) - x).cwiseAbs().maxCoeff() < 1e-12);
        }
}

TEST_CASE("a plan of parameters is at rest at both ends") {
  const PlanarTask task = planar_tasks::walking();
  const PlanarPlan plan = random_plan(task, with(Forces::per_point, true), 2);
  for (double t : {0.0, plan.duration()}) {
    const auto state = plan.at(t);
    CHECK(state.configuration.velocity.norm() < 1e-10);
    CHECK(state.configuration.acceleration.norm() < 1e-8);
  }
}

TEST_CASE("one duration is shared by intervals") {
  const PlanarTask task = planar_tasks::cartwheel();
  const Options options = with(Forces::uniform, false);
  const Layout layout(task, options);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(layout.parameters);
  x[layout.first_duration] = 2.0;
  const PlanarPlan plan = plan_of(task, options, layout, x);
  REQUIRE(plan.durations.size() == 3);
  CHECK(plan.durations[0] == doctest::Approx(0.6));
  CHECK(plan.durations[1] == doctest::Approx(0.8));
  CHECK(plan.durations[2] == doctest::Approx(0.6));
}

TEST_CASE("weights of another force law are taken over as far as there are parameters for them") {
  const PlanarTask task = planar_tasks::climbing();
  const PlanarPlan plan = random_plan(task, with(Forces::per_point, true), 3);
  const Options body = with(Forces::per_body, true);
  const Layout layout(task, body);
  const Eigen::VectorXd x = parameters_of(plan, task, body, layout);
  for (std::size_t p = 0; p < task.phases.size(); ++p) {
    const Eigen::ArrayXd logs = plan.weights[p].array().log();  // two points for each contact
    for (int i = 0; i < layout.weights[p]; ++i)
      CHECK(x[layout.first_weight[p] + i] ==
            doctest::Approx(logs.segment<2>(2 * i + 2).mean() - logs.head<2>().mean()));
  }
  // From weights of contacts to weights of points nothing is lost: the forces are the same.
  const PlanarPlan by_body = plan_of(task, body, layout, x);
  const Options point = with(Forces::per_point, true);
  const Layout other(task, point);
  const PlanarPlan by_point = plan_of(task, point, other, parameters_of(by_body, task, point, other));
  for (double ratio : {0.1, 0.4, 0.8}) {
    const auto a = by_body.at(ratio * by_body.duration()), b = by_point.at(ratio * by_body.duration());
    CHECK((a.torque - b.torque).cwiseAbs().maxCoeff() < 1e-8);
  }
  // Uniform weights are forgotten, splines and durations are not.
  const Options uniform = with(Forces::uniform, true);
  const Layout plain(task, uniform);
  CHECK((parameters_of(plan, task, uniform, plain) - x.head(plain.parameters)).norm() < 1e-14);
}

TEST_CASE("weights beyond their bounds come back at the bounds") {
  const PlanarTask task = planar_tasks::cartwheel();
  const Options options = with(Forces::per_point, true);
  const Layout layout(task, options);
  PlanarPlan plan = random_plan(task, options, 3);
  plan.weights[0] << 1.0, 1e6, 1e-6, 1.0;
  const Eigen::VectorXd x = parameters_of(plan, task, options, layout);
  CHECK(x[layout.first_weight[0]] == options.log_weight_max);
  CHECK(x[layout.first_weight[0] + 1] == -options.log_weight_max);
}

TEST_CASE("least-norm forces become polynomials through them, and those mean nothing to weights") {
  const PlanarTask task = planar_tasks::cartwheel();
  const PlanarPlan least_norm = random_plan(task, with(Forces::per_point, true), 4);
  const Options given = with(Forces::parameters, true);
  const Layout layout(task, given);
  const PlanarPlan polynomial = plan_of(task, given, layout, parameters_of(least_norm, task, given, layout));
  CHECK(std::holds_alternative<mcplan::planar_laws::Polynomial>(polynomial.force_law));
  const double length = least_norm.durations[1] / 4.0;
  for (double s : {-1.0 / 3.0, 1.0 / 3.0}) {  // inner instants of the fit, of phase 1's second interval
    const double t = (1.0 + 0.5 * (s + 1.0)) * length;
    const auto a = least_norm.at_phase(1, t), b = polynomial.at_phase(1, t);
    for (std::size_t v = 0; v < a.forces.size(); ++v) {
      CHECK(b.forces[v].tangential == doctest::Approx(a.forces[v].tangential).epsilon(1e-6).scale(100.0));
      CHECK(b.forces[v].normal == doctest::Approx(a.forces[v].normal).epsilon(1e-6).scale(100.0));
    }
  }
  const Options point = with(Forces::per_point, true);
  const Layout weighted(task, point);
  const Eigen::VectorXd x = parameters_of(polynomial, task, point, weighted);
  CHECK(x.tail(weighted.parameters - weighted.first_weight[0]).norm() == 0.0);
}

TEST_CASE("a computed base becomes splines near it") {
  const PlanarTask task = planar::standing();
  const Options computed = with(Forces::uniform, true), own = with(Forces::uniform, true, FreeFlyer::parameterised);
  const Layout layout(task, computed), other(task, own);
  Eigen::VectorXd x = planar_tasks::random_parameters(task, layout, 5);
  x.head(layout.first_duration) *= 0.1;
  const PlanarPlan plan = plan_of(task, computed, layout, x);
  const PlanarPlan splines = plan_of(task, own, other, parameters_of(plan, task, own, other));
  REQUIRE(splines.base_control_points.cols() == task.interval_count() + 3);
  for (int i = 1; i < 40; ++i) {
    const double t = plan.duration() * i / 40.0;
    CHECK((plan.at(t).configuration.base - splines.at(t).configuration.base).norm() < 0.02);
  }
  // In the zero posture, where the base stands still, they are the base.
  x.head(layout.first_duration).setZero();
  const PlanarPlan still = plan_of(task, computed, layout, x);
  const PlanarPlan same = plan_of(task, own, other, parameters_of(still, task, own, other));
  CHECK((still.at(0.3).configuration.base - same.at(0.3).configuration.base).norm() < 1e-12);
}

TEST_CASE("a plan that does not fit is refused by the field that does not") {
  const std::string task = "warm_start.task";
  CHECK(field([](PlanarPlan&) {}) == "accepted");
  CHECK(field([](PlanarPlan& p) {
          p.task.robot.bodies.pop_back();
          p.task.robot.end_effectors[2].body = 8;
          p.task.robot.collision_pairs.clear();
          p.control_points.conservativeResize(8, Eigen::NoChange);
        }) == task + ".robot");
  CHECK(field([](PlanarPlan& p) {
          p.task.phases.pop_back();
          p.durations.pop_back();
          p.weights.pop_back();
          p.control_points.conservativeResize(Eigen::NoChange, 10);
        }) == task + ".phases");
  CHECK(field([](PlanarPlan& p) {
          p.task.phases[1].intervals = 5;
          p.control_points.conservativeResize(Eigen::NoChange, 14);
          p.control_points.col(13).setZero();
        }) == task + ".phases[1].intervals");
  CHECK(field([](PlanarPlan& p) {
          p.task.phases[0].contacts.pop_back();
          p.weights[0].conservativeResize(2);
        }) == task + ".phases[0].contacts");
  CHECK(field([](PlanarPlan& p) { p.durations[1] = -1.0; }) == "durations[1]");
  CHECK(field([](PlanarPlan& p) { p.control_points(0, 3) = NAN; }) == "control_points");
  CHECK(field([](PlanarPlan& p) { p.weights[2][1] = 0.0; }) == "weights[2][1]");
}

TEST_CASE("soles with other points and contacts of other end-effectors do not fit") {
  const std::string contacts = "warm_start.task.phases[0].contacts";
  for (Forces forces : {Forces::uniform, Forces::per_body, Forces::per_point, Forces::parameters}) {
    // One point of limb A less, and one more: weights and forces would be read beyond their ends.
    const auto points = [forces](std::vector<double> along) {
      return field(
          [&](PlanarPlan& p) {
            p = PlanarPlan();
            PlanarTask task = planar_tasks::cartwheel();
            task.robot.end_effectors[0].points = along;
            p = random_plan(task, with(forces, true), 1);
          },
          forces);
    };
    CHECK(points({0.0}) == contacts + "[0]");
    CHECK(points({-0.08, 0.0, 0.08}) == contacts + "[0]");
    CHECK(points({-0.08, 0.08}) == "accepted");
  }
  CHECK(field([](PlanarPlan& p) { std::swap(p.task.phases[0].contacts[0], p.task.phases[0].contacts[1]); }) ==
        contacts + "[0]");
  // The same contacts elsewhere are a start like any other.
  CHECK(field([](PlanarPlan& p) {
          for (auto& phase : p.task.phases)
            for (auto& contact : phase.contacts) contact.position_W.x() += 0.1;
        }) == "accepted");
}
