#include "rhp/pieces/euler_step.hpp"

#include "rhp/pieces/support.hpp"

namespace mcplan::rhp::tests {

TEST_CASE("an Euler step is zero exactly where y1 = y0 + T / n r") {
  const EulerStep piece("step", 0, 3, 6, 9, 7);
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    VectorXd x = random.vector(10);
    const Vector3d off = random.three();
    x.segment<3>(3) = x.segment<3>(0) + x[9] / 7.0 * x.segment<3>(6) + off;
    CHECK((values(piece, x) - off).norm() < 1e-14);
  }
}

TEST_CASE("an Euler step reads the variables that it is given") {
  const EulerStep piece("step", 20, 10, 30, 5, 7);
  CHECK(piece.variables() == std::vector<int>{20, 21, 22, 10, 11, 12, 30, 31, 32, 5});
}

TEST_CASE("derivatives of an Euler step") { expect_derivatives(EulerStep("step", 0, 3, 6, 9, 5), 2); }

}  // namespace mcplan::rhp::tests
