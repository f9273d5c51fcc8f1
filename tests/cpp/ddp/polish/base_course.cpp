#include "ddp/polish/base_course.hpp"

#include <doctest/doctest.h>

#include "ddp/pendulum_cases.hpp"
#include "ddp/plan_conversion.hpp"
#include "mcplan/ddp/plan.hpp"

namespace {

using namespace pendulum_cases;
using ddp::polish::BaseCourse;

/// The base's course over the phase of a state and an input, and the step to its end.
struct Course {
  Course(const Pendulum& pendulum, const VectorXd& x, const VectorXd& u) {
    pendulum.step(x, u, 1.0, end);
    base.set(pendulum, pendulum.drive(x, u), end);
  }
  BaseCourse base;
  ddp::PendulumStep end;
};

/// The angles at a fraction of a phase by many small steps.
Vector3d integrated(const Pendulum& pendulum, VectorXd x, VectorXd u, double fraction) {
  constexpr int kSmallSteps = 64;
  const Layout& at = pendulum.layout();
  for (int l = 0; l < at.end_effector_count(); ++l) u.segment<3>(at.stride(l)).setZero();
  u[at.duration()] *= fraction / kSmallSteps;
  VectorXd next;
  for (int i = 0; i < kSmallSteps; ++i) {
    pendulum.next(x, u, next);
    x = next;
  }
  return x.segment<3>(at.angle());
}

}  // namespace

TEST_CASE("the base's course depends on the variables of its phase as differences say") {
  Random random(91);
  for (const Shape& shape : shapes()) {
    CAPTURE(shape.name);
    const Layout& at = shape.layout;
    const Case c = draw(random, shape, StiffnessInput::mu, 1.0);
    VectorXd z(at.nz());
    z << c.x, c.u;
    for (double s : {0.0, 0.2, 0.7, 1.0}) {
      CAPTURE(s);
      const Course course(c.pendulum, c.x, c.u);
      const BaseCourse::Derivatives by = course.base.derivatives(s);
      MatrixXd rows = MatrixXd::Zero(3, at.nz());
      for (int a = 0; a < at.axis_count(); ++a) {
        const int axis = at.axes()[a];
        rows +=
            by.end.col(axis) * course.end.turn.row(a) + by.end.col(3 + axis) * course.end.turn.row(at.axis_count() + a);
        rows.col(at.angle(a)) += by.begin_angle.col(axis);
        rows.col(at.momentum(a)) += by.begin_momentum.col(axis);
      }
      rows.col(at.nx() + at.duration()) += by.duration;
      const auto there = [&](const VectorXd& from) {
        return VectorXd(Course(c.pendulum, from.head(at.nx()), from.tail(at.nu())).base.at(s));
      };
      CHECK((rows - differences(there, z)).cwiseAbs().maxCoeff() <= 1e-7);
    }
  }
}

TEST_CASE("with the paper's model the base's course is the model's own") {
  Random random(92);
  for (const Shape& shape : shapes()) {
    if (shape.model != Model::lipm) continue;
    CAPTURE(shape.name);
    const Case c = draw(random, shape, StiffnessInput::mu, 1.0);
    const Pendulum::Course exact(c.pendulum, c.pendulum.drive(c.x, c.u));
    const Course course(c.pendulum, c.x, c.u);
    for (double s : {0.0, 0.3, 0.6, 1.0}) {
      Vector3d com, angle;
      exact.at(s * c.u[c.layout.duration()], com, angle);
      CHECK((course.base.at(s) - angle).norm() <= 1e-13);
    }
  }
}

TEST_CASE("between the knots of a plan the base's course is nearer to a fine integration than the knots are") {
  const mcplan::Scene scene = scenes::gap_with_rail();
  const mcplan::Robot robot = scenes::humanoid44();
  const mcplan::PlanResult planned = ddp::plan(scene, robot);
  REQUIRE(planned.report.status == mcplan::Status::solved);
  ddp::Options options;
  options.phases = static_cast<int>(planned.plan.phases.size());
  const ddp::Problem problem(scene, robot, options);
  const Pendulum pendulum(problem.layout, problem.inertia, options.stiffness_input, problem.model);
  const ddp::Incumbent motion = ddp::from_plan(problem, planned.plan, 0);
  double at_ends = 0.0, inside = 0.0;
  for (int k = 0; k < problem.steps; ++k) {
    const VectorXd &x = motion.trajectory.x[k], &u = motion.trajectory.u[k];
    const Course course(pendulum, x, u);
    at_ends = std::max(at_ends, (course.base.at(1.0) - integrated(pendulum, x, u, 1.0)).norm());
    for (int i = 1; i < 5; ++i)
      inside = std::max(inside, (course.base.at(0.2 * i) - integrated(pendulum, x, u, 0.2 * i)).norm());
  }
  CHECK(inside < at_ends);
}
