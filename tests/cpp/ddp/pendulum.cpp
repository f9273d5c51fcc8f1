#include "ddp/pendulum.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <string>

#include "mcplan/base/rotation.hpp"
#include "pendulum_cases.hpp"

namespace {

using namespace pendulum_cases;
using ddp::PendulumStep;

struct Integrated {
  VectorXd x;     ///< without angles where the model is Model::wrench
  Matrix3d r_WB;  ///< rotation of the base, of Model::wrench
};

/// The equations of motion by the classical Runge-Kutta scheme, from forces alone:
///
///     p'' = sum f_l - e_z,   f_l = mu_l (p - s_l),   L' = sum (a_l - p) x f_l + sum tau_l
///
/// and R' = [R I^-1 R' L] x R, or theta' = I^-1 L without torques of the forces in the paper's model.
Integrated integrate(const Case& c, int steps) {
  const Layout& at = c.layout;
  const int axes = at.axis_count(), nx = at.nx();
  const auto momentum_of = [&](const VectorXd& y) {
    Vector3d out = Vector3d::Zero();
    for (int a = 0; a < axes; ++a) out[at.axes()[a]] = y[at.momentum(a)];
    return out;
  };
  const auto rate = [&](const VectorXd& y) {
    VectorXd out = VectorXd::Zero(y.size());
    const Vector3d p = y.segment<3>(at.com()), momentum = momentum_of(y);
    Vector3d acceleration(0, 0, -1), torque = Vector3d::Zero();
    for (int l = 0; l < at.end_effector_count(); ++l) {
      const Vector3d acts =
          c.x.segment<3>(at.end(l)) + at.offsets(l).pressure * c.u.segment(at.pressure(l), at.pressure_count(l));
      const Vector3d line = acts + at.offsets(l).force_line * c.u.segment(at.force_line(l), at.force_line_count(l));
      const Vector3d force = c.pendulum.mu(c.u, l) * (p - line);
      acceleration += force;
      torque += (acts - p).cross(force);
    }
    for (int i = 0; i < at.moment_count(); ++i) torque += c.u[at.moment(i)] * at.moments()[i].direction_W;
    out.segment<3>(at.com()) = y.segment<3>(at.velocity());
    out.segment<3>(at.velocity()) = acceleration;
    for (int a = 0; a < axes; ++a) {
      const int axis = at.axes()[a];
      out[at.momentum(a)] = torque[axis];
      if (c.model == Model::lipm) out[at.angle(a)] = momentum[axis] / kInertia[axis];
    }
    if (c.model == Model::wrench) {
      const Eigen::Map<const Matrix3d> r(y.data() + nx);
      const Vector3d omega = r * (r.transpose() * momentum).cwiseQuotient(kInertia);
      Eigen::Map<Matrix3d> turning(out.data() + nx);
      for (int i = 0; i < 3; ++i) turning.col(i) = omega.cross(r.col(i));
    }
    return out;
  };
  VectorXd y(nx + 9);
  const Matrix3d begin =
      c.model == Model::wrench ? mcplan::rotation_from_rpy(c.x.segment<3>(at.angle())) : Matrix3d(Matrix3d::Identity());
  y << c.x, Eigen::Map<const VectorXd>(begin.data(), 9);
  const double dt = c.u[at.duration()] / steps;
  for (int i = 0; i < steps; ++i) {
    const VectorXd k1 = rate(y), k2 = rate(y + 0.5 * dt * k1), k3 = rate(y + 0.5 * dt * k2), k4 = rate(y + dt * k3);
    y += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  Integrated out{y.head(nx), Eigen::Map<const Matrix3d>(y.data() + nx)};
  for (int l = 0; l < at.end_effector_count(); ++l) out.x.segment<3>(at.end(l)) += c.u.segment<3>(at.stride(l));
  return out;
}

/// [rad] between two rotations.
double angle_between(const Matrix3d& a, const Matrix3d& b) { return Eigen::AngleAxisd(a.transpose() * b).angle(); }

}  // namespace

TEST_CASE("every entry of the Jacobian agrees with differences, from stiff contact to flight and beyond") {
  Random random(1);
  for (const Shape& shape : shapes())
    for (StiffnessInput input : {StiffnessInput::mu, StiffnessInput::lambda})
      for (double scale : {1.0, 1e-2, 1e-5, 0.0, -1.0}) {
        if (scale < 0.0 && input == StiffnessInput::lambda) continue;
        const Layout& at = shape.layout;
        const Case c = draw(random, shape, input, std::abs(scale), scale < 0.0 ? -1.0 : 1.0);
        CAPTURE(shape.name);
        CAPTURE(scale);
        CAPTURE(static_cast<int>(input));
        PendulumStep step;
        c.pendulum.step(c.x, c.u, 1.0, step);
        VectorXd z(at.nz());
        z << c.x, c.u;
        const MatrixXd expected = differences(
            [&](const VectorXd& there) { return next(c, there.head(at.nx()), there.tail(at.nu())); }, z, 2e-4);
        const MatrixXd jacobian = c.pendulum.dense_jacobian(step);
        REQUIRE(jacobian.rows() == at.nx());
        REQUIRE(jacobian.cols() == at.nz());
        CHECK((jacobian - expected).cwiseAbs().maxCoeff() <= 1e-8);
        // A mu input sees what contact would give even without any; lambda does not.
        const double seen = jacobian.middleCols(at.nx() + at.stiffness(), at.end_effector_count()).norm();
        if (scale == 0.0) CHECK((seen > 0.1) == (input == StiffnessInput::mu));
      }
}

TEST_CASE("the Jacobian inside a phase is that of the motion up to there") {
  Random random(11);
  for (const Shape& shape : shapes())
    for (double fraction : {0.0, 0.3}) {
      const Layout& at = shape.layout;
      const Case c = draw(random, shape, StiffnessInput::mu, 1.0);
      CAPTURE(shape.name);
      CAPTURE(fraction);
      PendulumStep step;
      c.pendulum.step(c.x, c.u, fraction, step);
      VectorXd z(at.nz());
      z << c.x, c.u;
      const auto there = [&](const VectorXd& from) {
        VectorXd u = from.tail(at.nu());
        u[at.duration()] *= fraction;
        return next(c, from.head(at.nx()), u);
      };
      CHECK((c.pendulum.dense_jacobian(step) - differences(there, z, 2e-4)).cwiseAbs().maxCoeff() <= 1e-8);
    }
}

TEST_CASE("the closed form is the integral of the equations of motion") {
  Random random(2);
  double worst = 0.0;
  for (const Shape& shape : shapes())
    for (double scale : {1.0, 1e-2, 1e-5, 0.0, -1.0})
      for (double spin : {0.2, 1.0}) {
        if (kSlowBuild && spin == 1.0) continue;
        const Layout& at = shape.layout;
        const Case c = draw(random, shape, StiffnessInput::mu, std::abs(scale), scale < 0.0 ? -1.0 : 1.0, spin);
        CAPTURE(shape.name);
        CAPTURE(scale);
        const VectorXd there = next(c, c.x, c.u);
        VectorXd error = (there - integrate(c, 8000).x).cwiseQuotient((1.0 + there.array().abs()).matrix());
        // The one thing of the model that is not in closed form, see below.
        if (shape.model == Model::wrench) error.segment(at.angle(), at.axis_count()).setZero();
        worst = std::max(worst, error.cwiseAbs().maxCoeff());
        CHECK(error.cwiseAbs().maxCoeff() <= 1e-12);
      }
  MESSAGE("closed form against 8000 Runge-Kutta steps: ", worst);
}

TEST_CASE("the base turns as its rotation does: one step a phase is enough for a walk, and more converge in order 4") {
  Random random(12);
  const Shape shape = shapes()[0];
  const Layout& at = shape.layout;
  // After `parts` steps of one phase, each with its own closed form.
  const auto in_parts = [&](const Case& c, int parts) {
    VectorXd x = c.x, u = c.u;
    u[at.duration()] /= parts;
    for (int l = 0; l < at.end_effector_count(); ++l) u.segment<3>(at.stride(l)).setZero();
    for (int i = 0; i < parts; ++i) x = next(c, x, u);
    return x;
  };
  for (double spin : {0.02, 0.1}) {
    double worst = 0.0, turned = 0.0;
    std::vector<double> error(4, 0.0);
    for (int i = 0; i < 30; ++i) {
      const Case c = draw(random, shape, StiffnessInput::mu, 0.3, 1.0, spin);
      const Matrix3d truth = integrate(c, 500).r_WB;
      const auto rotation = [&](const VectorXd& x) { return mcplan::rotation_from_rpy(x.segment<3>(at.angle())); };
      turned = std::max(turned, angle_between(rotation(c.x), truth));
      worst = std::max(worst, angle_between(rotation(next(c, c.x, c.u)), truth));
      for (int j = 0; j < 4; ++j) error[j] += angle_between(rotation(in_parts(c, 1 << j)), truth) / 30;
    }
    MESSAGE("momenta of the order ", spin, ": turned by ", turned, " rad, worst error ", worst,
            " rad, mean error of 1, 2, 4, 8 steps ", error[0], " ", error[1], " ", error[2], " ", error[3]);
    CHECK(worst <= (spin < 0.05 ? 1e-3 : 5e-3));
    for (int j = 1; j + 1 < 4; ++j) CHECK(error[j] / error[j + 1] > 11.0);
  }
}

TEST_CASE("without offsets p and v are the paper's, and the momentum changes by moments alone") {
  Random random(13);
  for (double scale : {1.0, 1e-5, 0.0}) {
    const Shape soles = shapes()[0];
    const Shape plain{"", Model::lipm, {std::vector<Layout::Offsets>(3), {0, 1, 2}, {}}};
    const Layout &at = soles.layout, &paper = plain.layout;
    Case c = draw(random, soles, StiffnessInput::mu, scale);
    c.u.segment(at.pressure(0), at.moment() - at.pressure(0)).setZero();
    VectorXd u(paper.nu());
    u << c.u.head(4 * 3), c.u[at.duration()];
    const Pendulum pendulum(paper, kInertia, StiffnessInput::mu, Model::lipm);
    VectorXd there;
    pendulum.next(c.x, u, there);
    const VectorXd ours = next(c, c.x, c.u);
    CHECK(ours.segment<6>(at.com()) == there.segment<6>(at.com()));
    Vector3d moment = Vector3d::Zero();
    for (int i = 0; i < at.moment_count(); ++i) moment += c.u[at.moment(i)] * at.moments()[i].direction_W;
    const Vector3d momentum = c.x.segment<3>(at.momentum()) + c.u[at.duration()] * moment;
    CHECK((ours.segment<3>(at.momentum()) - momentum).norm() <= 1e-15);
  }
}

TEST_CASE("a pressure offset is an end-effector that stands elsewhere") {
  Random random(14);
  const Shape shape = shapes()[0];
  const Layout& at = shape.layout;
  const Case c = draw(random, shape, StiffnessInput::mu, 1.0);
  VectorXd x = c.x, u = c.u;
  for (int l = 0; l < at.end_effector_count(); ++l) {
    x.segment<3>(at.end(l)) += at.pressure_offset(u, l);
    u.segment(at.pressure(l), at.pressure_count(l)).setZero();
  }
  const VectorXd moved = next(c, x, u), there = next(c, c.x, c.u);
  CHECK((moved - there).head(at.end(0)).cwiseAbs().maxCoeff() <= 1e-14);
}

TEST_CASE("step, next and what is worked out at single instants are one function") {
  Random random(3);
  for (const Shape& shape : shapes()) {
    const Layout& at = shape.layout;
    CAPTURE(shape.name);
    const Case c = draw(random, shape, StiffnessInput::lambda, 1.0);
    const Pendulum::Course course(c.pendulum, c.pendulum.drive(c.x, c.u));
    PendulumStep step;
    for (double fraction : {0.0, 0.3, 1.0}) {
      const double t = fraction * c.u[at.duration()];
      c.pendulum.step(c.x, c.u, fraction, step);
      VectorXd u = c.u;
      u[at.duration()] = t;
      const VectorXd there = next(c, c.x, u);
      CHECK(step.duration == t);
      CHECK((step.com - there.segment<3>(at.com())).norm() <= 1e-13);
      Vector3d com, angle;
      course.at(t, com, angle);
      CHECK((step.com - com).norm() <= 1e-13);
      CHECK((step.velocity - there.segment<3>(at.velocity())).norm() <= 1e-13);
      CHECK((step.angle - there.segment(at.angle(), at.axis_count())).norm() <= 1e-13);
      CHECK((step.momentum - there.segment(at.momentum(), at.axis_count())).norm() <= 1e-13);
      for (int a = 0; a < at.axis_count(); ++a) CHECK(std::abs(step.angle[a] - angle[at.axes()[a]]) <= 1e-13);
    }
  }
}

TEST_CASE("flight is a parabola, and nothing turns the body any faster") {
  Random random(4);
  for (const Shape& shape : shapes()) {
    const Layout& at = shape.layout;
    CAPTURE(shape.name);
    Case c = draw(random, shape, StiffnessInput::mu, 0.0);
    c.u.segment(at.moment(), at.moment_count()).setZero();
    for (double h : {1e-6, 0.1, 1.0, 3.0}) {
      c.u[at.duration()] = h;
      const Vector3d p = c.x.segment<3>(at.com()), v = c.x.segment<3>(at.velocity());
      const VectorXd there = next(c, c.x, c.u);
      CHECK((there.segment<3>(at.com()) - (p + h * v - 0.5 * h * h * Vector3d::UnitZ())).norm() <= 1e-15 * (1 + h * h));
      CHECK((there.segment<3>(at.velocity()) - (v - h * Vector3d::UnitZ())).norm() <= 1e-15 * (1 + h));
      CHECK(there.segment(at.momentum(), at.axis_count()) == c.x.segment(at.momentum(), at.axis_count()));
    }
  }
}

TEST_CASE("the limit of vanishing stiffness is flight, from both sides and without a jump") {
  Random random(5);
  for (const Shape& shape : shapes()) {
    const Layout& at = shape.layout;
    const Case flight = draw(random, shape, StiffnessInput::mu, 0.0);
    const VectorXd there = next(flight, flight.x, flight.u);
    for (double mu : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-200, -1e-12, -1e-9, -1e-6}) {
      CAPTURE(shape.name);
      CAPTURE(mu);
      VectorXd u = flight.u;
      u.segment(at.stiffness(), at.end_effector_count()).setConstant(mu);
      CHECK((next(flight, flight.x, u) - there).norm() <= 50.0 * std::abs(mu) + 1e-15);
    }
  }
}

TEST_CASE("previous undoes next") {
  Random random(6);
  for (const Shape& shape : shapes())
    for (double scale : {1.0, 1e-2, 1e-5, 0.0})
      for (double spin : {0.02, 0.1}) {
        const Case c = draw(random, shape, StiffnessInput::mu, scale, 1.0, spin);
        CAPTURE(shape.name);
        CAPTURE(scale);
        CAPTURE(spin);
        VectorXd back, forth;
        c.pendulum.previous(next(c, c.x, c.u), c.u, back);
        CHECK((back - c.x).cwiseAbs().maxCoeff() <= 1e-12);
        c.pendulum.previous(c.x, c.u, back);
        c.pendulum.next(back, c.u, forth);
        CHECK((forth - c.x).cwiseAbs().maxCoeff() <= 1e-12);
      }
}

TEST_CASE("products that never form the Jacobian agree with the dense one") {
  Random random(7);
  for (const Shape& shape : shapes())
    for (double scale : {1.0, 0.0}) {
      const Layout& at = shape.layout;
      CAPTURE(shape.name);
      CAPTURE(scale);
      const Case c = draw(random, shape, StiffnessInput::mu, scale);
      const int nx = at.nx(), nu = at.nu(), nz = at.nz(), axes = at.axis_count();
      PendulumStep step;
      c.pendulum.step(c.x, c.u, 1.0, step);
      const MatrixXd jacobian = c.pendulum.dense_jacobian(step);
      const MatrixXd a = jacobian.leftCols(nx), b = jacobian.rightCols(nu);
      const VectorXd dx = noise(random, nx, 1.0), du = noise(random, nu, 1.0);

      VectorXd out;
      c.pendulum.apply(step, dx, du, out);
      CHECK((out - a * dx - b * du).cwiseAbs().maxCoeff() <= 1e-13);

      const VectorXd before = noise(random, nz, 1.0);
      VectorXd g = before;
      c.pendulum.add_transposed(step, dx, g);
      CHECK((g - before - jacobian.transpose() * dx).cwiseAbs().maxCoeff() <= 1e-13);

      const Vector3d along_com = noise(random, 3, 1.0);
      Vector3d along_angle = Vector3d::Zero();
      for (int i = 0; i < axes; ++i) along_angle[i] = uniform(random, -1.0, 1.0);
      g = before;
      c.pendulum.add_along(step, along_com, along_angle, g);
      const VectorXd along = jacobian.middleRows(at.com(), 3).transpose() * along_com +
                             jacobian.middleRows(at.angle(), axes).transpose() * along_angle.head(axes);
      CHECK((g - before - along).cwiseAbs().maxCoeff() <= 1e-13);

      const MatrixXd a_inverse = a.inverse();
      c.pendulum.apply_inverse(step, dx, out);
      CHECK((out - a_inverse * dx).cwiseAbs().maxCoeff() <= 1e-11);

      MatrixXd t = MatrixXd::Identity(nz, nz);
      t.topLeftCorner(nx, nx) = a_inverse;
      t.topRightCorner(nx, nu) = -a_inverse * b;
      MatrixXd rows = noise(random, 5, nz, 1.0);
      const MatrixXd expected = rows * t;
      c.pendulum.substitute_inverse(step, rows);
      CHECK((rows - expected).cwiseAbs().maxCoeff() <= 1e-11);
    }
}
