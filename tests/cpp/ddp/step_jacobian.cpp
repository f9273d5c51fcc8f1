#include "ddp/step_jacobian.hpp"

#include <doctest/doctest.h>

#include "pendulum_cases.hpp"

using namespace pendulum_cases;
using mcplan::ddp::PendulumStep;
using mcplan::ddp::StepJacobian;

TEST_CASE("the Hessian pulled back through a step is J'VJ, J by differences") {
  Random random(73);
  StepJacobian jacobian;  // one for all: nothing of an earlier step may be left in it
  for (const Shape& shape : shapes())
    for (StiffnessInput input : {StiffnessInput::mu, StiffnessInput::lambda}) {
      CAPTURE(shape.name);
      Case c = draw(random, shape, input, 1.0);
      c.u[shape.layout.stiffness(0)] = 0.0;  // bears nothing: its columns are short
      const Layout& at = shape.layout;
      const int nx = at.nx(), nz = at.nz();
      PendulumStep step;
      c.pendulum.step(c.x, c.u, 1.0, step);
      jacobian.make(at, step);
      VectorXd z(nz);
      z << c.x, c.u;
      const auto there = [&](const VectorXd& y) { return next(c, y.head(nx), y.tail(at.nu())); };
      const MatrixXd dense = jacobian.dense();
      CHECK((dense - differences(there, z, 2e-4)).cwiseAbs().maxCoeff() <= 1e-8);

      const MatrixXd a = noise(random, nx, nx, 1.0), v = a + a.transpose(), before = noise(random, nz, nz, 1.0);
      MatrixXd h = before;
      jacobian.add_congruent(v, h);
      const MatrixXd wrong = h - before - dense.transpose() * v * dense;
      CHECK(MatrixXd(wrong.triangularView<Eigen::Upper>()).cwiseAbs().maxCoeff() <=
            1e-13 * (1.0 + h.cwiseAbs().maxCoeff()) * nx);
    }
}
