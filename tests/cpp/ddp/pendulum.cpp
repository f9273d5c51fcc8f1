#include "mcplan/ddp/pendulum.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>

#include "support.hpp"

namespace {

using namespace support;
using ddp::Layout;
using ddp::Pendulum;
using ddp::PendulumStep;
using ddp::StiffnessInput;
using Eigen::Vector3d;

/// Three ends, all axes, moments on two ends; two ends with yaw alone; four ends without a base.
std::vector<Layout> layouts() {
  return {Layout(3, {0, 1, 2}, {{0, 0}, {0, 1}, {0, 2}, {2, 1}}), Layout(2, {2}, {{0, 0}, {1, 0}}), Layout(4, {}, {})};
}

const Vector3d kInertia(0.2, 0.5, 0.3);

struct Case {
  Layout layout;
  Pendulum pendulum;
  VectorXd x, u;
};

/// Random state and input; mu_l of the order `scale` (lambda_l of its root), `sign` for repelling contacts.
Case draw(Random& random, const Layout& layout, StiffnessInput input, double scale, double sign = 1.0) {
  Case c{layout, Pendulum(layout, kInertia, input), noise(random, layout.nx(), 1.0), noise(random, layout.nu(), 0.5)};
  for (int l = 0; l < layout.ends(); ++l) {
    const double mu = scale * uniform(random, 0.5, 1.0);
    c.u[layout.stiffness(l)] = input == StiffnessInput::lambda ? std::sqrt(mu) : sign * mu;
  }
  c.u[layout.duration()] = uniform(random, 0.5, 1.8);
  return c;
}

VectorXd next(const Case& c, const VectorXd& x, const VectorXd& u) {
  VectorXd out;
  c.pendulum.next(x, u, out);
  return out;
}

/// p'' = Lambda p - sum mu_l p_l - e_z and theta'' = I^-1 sum tau_l by the classical Runge-Kutta scheme.
VectorXd integrate(const Case& c, int steps) {
  const Layout& at = c.layout;
  const auto mu = [&](int l) { return c.pendulum.mu(c.u, l); };
  const auto rate = [&](const VectorXd& y) {
    VectorXd out = VectorXd::Zero(at.nx());
    out.segment<3>(at.com()) = y.segment<3>(at.velocity());
    Vector3d acceleration(0, 0, -1);
    for (int l = 0; l < at.ends(); ++l) acceleration += mu(l) * (y.segment<3>(at.com()) - c.x.segment<3>(at.end(l)));
    out.segment<3>(at.velocity()) = acceleration;
    for (int a = 0; a < at.axis_count(); ++a) out[at.angle(a)] = y[at.rate(a)];
    for (int i = 0; i < at.moment_count(); ++i) {
      const int a = at.moments()[i].axis;
      out[at.rate(a)] += c.u[at.moment(i)] / kInertia[at.axes()[a]];
    }
    return out;
  };
  VectorXd y = c.x;
  const double dt = c.u[at.duration()] / steps;
  for (int i = 0; i < steps; ++i) {
    const VectorXd k1 = rate(y), k2 = rate(y + 0.5 * dt * k1), k3 = rate(y + 0.5 * dt * k2), k4 = rate(y + dt * k3);
    y += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  for (int l = 0; l < at.ends(); ++l) y.segment<3>(at.end(l)) += c.u.segment<3>(at.stride(l));
  return y;
}

}  // namespace

TEST_CASE("every entry of the Jacobian agrees with differences, from stiff contact to flight and beyond") {
  Random random(1);
  for (const Layout& layout : layouts())
    for (StiffnessInput input : {StiffnessInput::mu, StiffnessInput::lambda})
      for (double scale : {1.0, 1e-2, 1e-5, 0.0, -1.0}) {
        if (scale < 0.0 && input == StiffnessInput::lambda) continue;
        const Case c = draw(random, layout, input, std::abs(scale), scale < 0.0 ? -1.0 : 1.0);
        CAPTURE(layout.nx());
        CAPTURE(scale);
        CAPTURE(static_cast<int>(input));
        PendulumStep step;
        c.pendulum.step(c.x, c.u, 1.0, step);
        VectorXd z(layout.nz());
        z << c.x, c.u;
        const MatrixXd expected =
            differences([&](const VectorXd& at) { return next(c, at.head(layout.nx()), at.tail(layout.nu())); }, z);
        const MatrixXd jacobian = c.pendulum.dense_jacobian(step);
        REQUIRE(jacobian.rows() == layout.nx());
        REQUIRE(jacobian.cols() == layout.nz());
        CHECK((jacobian - expected).cwiseAbs().maxCoeff() <= 1e-8);
        // A mu input sees what contact would give even without any; lambda does not.
        const double seen = jacobian.middleCols(layout.nx() + layout.stiffness(), layout.ends()).norm();
        if (scale == 0.0) CHECK((seen > 0.1) == (input == StiffnessInput::mu));
      }
}

TEST_CASE("the closed form is the integral of the equations of motion") {
  Random random(2);
  for (const Layout& layout : layouts())
    for (double scale : {1.0, 1e-2, 1e-5, 0.0, -1.0}) {
      const Case c = draw(random, layout, StiffnessInput::mu, std::abs(scale), scale < 0.0 ? -1.0 : 1.0);
      CAPTURE(scale);
      CHECK((next(c, c.x, c.u) - integrate(c, 8000)).cwiseAbs().maxCoeff() <= 1e-12);
    }
}

TEST_CASE("step, next and com_at are one function") {
  Random random(3);
  for (const Layout& layout : layouts()) {
    const Case c = draw(random, layout, StiffnessInput::lambda, 1.0);
    PendulumStep step;
    for (double fraction : {0.0, 0.3, 1.0}) {
      c.pendulum.step(c.x, c.u, fraction, step);
      VectorXd u = c.u;
      u[layout.duration()] *= fraction;
      const VectorXd there = next(c, c.x, u);
      CHECK((step.com - there.segment<3>(layout.com())).norm() <= 1e-14);
      CHECK((step.com - c.pendulum.com_at(c.x, c.u, fraction)).norm() <= 1e-14);
      for (int a = 0; a < step.angle.size(); ++a)
        CHECK(std::abs(step.angle[a] - c.pendulum.angle_at(c.x, c.u, fraction, a)) <= 1e-14);
      CHECK((step.velocity - there.segment<3>(layout.velocity())).norm() <= 1e-14);
      CHECK((step.angle - there.segment(layout.angle(), layout.axis_count())).norm() <= 1e-14);
      CHECK((step.rate - there.segment(layout.rate(), layout.axis_count())).norm() <= 1e-14);
    }
  }
}

TEST_CASE("flight is a parabola") {
  Random random(4);
  Case c = draw(random, layouts()[0], StiffnessInput::mu, 0.0);
  for (double h : {1e-6, 0.1, 1.0, 3.0}) {
    c.u[c.layout.duration()] = h;
    const Vector3d p = c.x.segment<3>(c.layout.com()), v = c.x.segment<3>(c.layout.velocity());
    const VectorXd there = next(c, c.x, c.u);
    CHECK((there.segment<3>(c.layout.com()) - (p + h * v - 0.5 * h * h * Vector3d::UnitZ())).norm() <=
          1e-15 * (1 + h * h));
    CHECK((there.segment<3>(c.layout.velocity()) - (v - h * Vector3d::UnitZ())).norm() <= 1e-15 * (1 + h));
  }
}

TEST_CASE("the limit of vanishing stiffness is flight, from both sides and without a jump") {
  Random random(5);
  const Case flight = draw(random, layouts()[0], StiffnessInput::mu, 0.0);
  const VectorXd there = next(flight, flight.x, flight.u);
  for (double mu : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-200, -1e-12, -1e-9, -1e-6}) {
    CAPTURE(mu);
    VectorXd u = flight.u;
    u.segment(flight.layout.stiffness(), flight.layout.ends()).setConstant(mu);
    CHECK((next(flight, flight.x, u) - there).norm() <= 50.0 * std::abs(mu) + 1e-15);
  }
}

TEST_CASE("previous undoes next") {
  Random random(6);
  for (const Layout& layout : layouts())
    for (double scale : {1.0, 1e-2, 1e-5, 0.0}) {
      const Case c = draw(random, layout, StiffnessInput::mu, scale);
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
  for (const Layout& layout : layouts())
    for (double scale : {1.0, 0.0}) {
      const Case c = draw(random, layout, StiffnessInput::mu, scale);
      const int nx = layout.nx(), nu = layout.nu(), nz = layout.nz();
      PendulumStep step;
      c.pendulum.step(c.x, c.u, 1.0, step);
      const MatrixXd jacobian = c.pendulum.dense_jacobian(step);
      const MatrixXd a = jacobian.leftCols(nx), b = jacobian.rightCols(nu);
      const VectorXd dx = noise(random, nx, 1.0), du = noise(random, nu, 1.0);

      MatrixXd product;
      const MatrixXd m = noise(random, 5, nx, 1.0);
      c.pendulum.times_jacobian(step, m, product);
      CHECK((product - m * jacobian).cwiseAbs().maxCoeff() <= 1e-13);

      VectorXd out;
      c.pendulum.apply(step, dx, du, out);
      CHECK((out - a * dx - b * du).cwiseAbs().maxCoeff() <= 1e-13);

      const VectorXd before = noise(random, nz, 1.0);
      VectorXd g = before;
      c.pendulum.add_transposed(step, dx, g);
      CHECK((g - before - jacobian.transpose() * dx).cwiseAbs().maxCoeff() <= 1e-13);

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
