#include "check_rows.hpp"

namespace {

using namespace support;

Writer task_at(const ddp::Problem& problem, int k, bool discovering = false) {
  About about{k};
  about.discovering = discovering;
  return term(problem, "task", about);
}

/// Weights that can be told apart.
ddp::Options distinct(ddp::Model model) {
  ddp::Options options = phases(6, model);
  ddp::Weights& w = options.weights;
  w.com = 2, w.com_end = 3, w.velocity = 5, w.velocity_end = 7, w.rotation = 11, w.rotation_end = 13;
  w.end_effector = 17, w.end_effector_end = 19, w.stride = 23, w.stiffness = 29, w.moment = 31;
  w.angle = 37, w.momentum = 41, w.center_of_pressure = 43, w.force_line = 47;
  return options;
}

/// Weight on the entry i of x, and of u, at step k.
struct Weighed {
  const ddp::Problem& problem;
  int k;
  bool discovering = false;
  double state(int i) const {
    const VectorXd u = VectorXd::Zero(problem.layout.nu());
    VectorXd x = problem.reference.x[k];
    CHECK(cost(problem, task_at(problem, k, discovering), x, u) <= 1e-20);
    x[i] += 0.1;
    return std::sqrt(cost(problem, task_at(problem, k, discovering), x, u) / 0.5) / 0.1;
  }
  double input(int i) const {
    VectorXd u = VectorXd::Zero(problem.layout.nu());
    u[i] = 0.1;
    return std::sqrt(cost(problem, task_at(problem, k, discovering), problem.reference.x[k], u) / 0.5) / 0.1;
  }
};

}  // namespace

TEST_CASE("task cost: gradients") {
  for (ddp::Model model : kModels)
    for (bool discovering : {false, true}) {
      const ddp::Problem problem = workshop(phases(6, model));
      for (int k : {0, 3, problem.steps}) check_rows(problem, task_at(problem, k, discovering), 41, 0.3, 30);
    }
}

TEST_CASE("in the paper's model the task cost is Table I's weights on the distance to the reference") {
  ddp::Options options = distinct(ddp::Model::lipm);
  for (ddp::Method method : {ddp::Method::standard, ddp::Method::paper}) {
    options.method = method;
    if (method == ddp::Method::paper) {  // which refuses the weights of the other model
      const ddp::Weights usual;
      ddp::Weights& w = options.weights;
      w.angle = usual.angle, w.momentum = usual.momentum;
      w.center_of_pressure = usual.center_of_pressure, w.force_line = usual.force_line;
    }
    const ddp::Problem problem = workshop(options);
    const ddp::Layout& at = problem.layout;
    for (int k : {0, 3, 6})
      for (bool discovering : {false, true}) {
        const Weighed weight{problem, k, discovering};
        const bool end = k == 0 || k == 6;
        // The start is a fact, not a wish, but for the paper and for the CoM, which must fall to begin a walk.
        const bool pinned = k == 0 && method == ddp::Method::standard;
        const auto expected = [&](double inside, double at_end) { return doctest::Approx(end ? at_end : inside); };
        const auto fact = [&](double inside, double at_end) {
          return pinned ? doctest::Approx(1000.0) : expected(inside, at_end);
        };
        CHECK(weight.state(at.com() + 2) == expected(2, 3));
        CHECK(weight.state(at.velocity()) == fact(5, 7));
        CHECK(weight.state(at.angle(1)) == fact(11, 13));
        // The weight is on the rate, momentum = inertia x rate.
        const double inertia = problem.inertia[2];
        CHECK(inertia == doctest::Approx(6.0 / (44.0 * 0.49)));
        CHECK(weight.state(at.momentum(2)) == fact(11 / inertia, 13 / inertia));
        CHECK(weight.state(at.end(1) + 1) == fact(17, 19));
        if (k == 6) continue;
        CHECK(weight.input(at.stride(1)) == doctest::Approx(23));
        CHECK(weight.input(at.stiffness(1)) == doctest::Approx(29));
        CHECK(weight.input(at.moment(1)) == doctest::Approx(31));
        CHECK(weight.input(at.duration()) <= 1e-10);
      }
  }
}

TEST_CASE("contact wrenches are held near the paper's model, harder while the sequence is sought") {
  const ddp::Problem problem = workshop(distinct(ddp::Model::wrench));
  const ddp::Layout& at = problem.layout;
  for (int k : {0, 3, 6})
    for (bool discovering : {false, true}) {
      const Weighed weight{problem, k, discovering};
      const double stiffer = discovering ? 10.0 / 3.0 : 1.0, stiffer_angle = discovering ? 10.0 : 1.0;
      const bool start = k == 0, end = k == 6;
      const auto expected = [&](double inside, double at_end) {
        return doctest::Approx(start ? 1000.0 : end ? at_end : inside);
      };
      CHECK(weight.state(at.com() + 2) == expected(2, 3));
      CHECK(weight.state(at.velocity()) == expected(5, 7));
      CHECK(weight.state(at.angle(1)) == expected(37 * stiffer_angle, 13));
      CHECK(weight.state(at.momentum(2)) == expected(41 * stiffer, 13));
      CHECK(weight.state(at.end(1) + 1) == expected(17, 19));
      if (end) continue;
      CHECK(weight.input(at.stride(1)) == doctest::Approx(23));
      CHECK(weight.input(at.stiffness(1)) == doctest::Approx(29));
      CHECK(weight.input(at.pressure(1)) == doctest::Approx(43));
      CHECK(weight.input(at.force_line(2) + 2) == doctest::Approx(47 * stiffer));
      CHECK(weight.input(at.moment(1)) == doctest::Approx(31));
      CHECK(weight.input(at.duration()) <= 1e-10);
    }
}

TEST_CASE("plans that a controller follows keep upright and centred, however much of the sole they may use") {
  const ddp::Options options = distinct(ddp::Model::wrench);
  for (double share : {1.0, 0.999999, 0.75})
    for (bool tracked : {false, true}) {
      mcplan::Robot robot = scenes::humanoid44();
      robot.pressure_ratio = share;
      robot.tracked = tracked;
      const ddp::Problem problem(scenes::flat(), robot, options);
      const ddp::Layout& at = problem.layout;
      const Weighed weight{problem, 3};
      CHECK(weight.state(at.angle(1)) == doctest::Approx(tracked ? 370 : 37));
      CHECK(weight.state(at.momentum(2)) == doctest::Approx(tracked ? 410.0 / 3.0 : 41));
      CHECK(weight.input(at.pressure(1)) == doctest::Approx(tracked ? 172 : 43));
      CHECK(weight.input(at.force_line(1)) == doctest::Approx(tracked ? 470.0 / 3.0 : 47));
    }
}
