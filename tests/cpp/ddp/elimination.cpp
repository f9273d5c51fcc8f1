#include "ddp/elimination.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>

#include "support.hpp"

namespace {

using namespace support;
using mcplan::ddp::eliminate_last;

MatrixXd positive_definite(Random& random, int n) {
  const MatrixXd a = noise(random, n, n + 2, 1.0);
  return a * a.transpose() + 0.1 * MatrixXd::Identity(n, n);
}

}  // namespace

TEST_CASE("eliminating the last variables leaves the Hessian and minimiser of a dense solve") {
  Random random(71);
  for (int left : {0, 1, 2, 5, 18})
    for (int count : {0, 1, 2, 3, 4, 5, 7, 8, 11, 19}) {
      CAPTURE(left);
      CAPTURE(count);
      const MatrixXd h = positive_definite(random, left + count);
      MatrixXd done = h;
      done.triangularView<Eigen::StrictlyLower>().setConstant(std::nan(""));  // it must not be read
      REQUIRE(eliminate_last(done, count));
      if (count == 0) continue;
      const MatrixXd uu = h.bottomRightCorner(count, count), xu = h.topRightCorner(left, count);
      if (left > 0) {
        const Eigen::LLT<MatrixXd> dense(uu);
        const MatrixXd expected = h.topLeftCorner(left, left) - xu * dense.solve(xu.transpose());
        const MatrixXd schur = done.topLeftCorner(left, left).selfadjointView<Eigen::Upper>();
        CHECK((schur - expected).cwiseAbs().maxCoeff() <= 1e-10);
      }

      // u = -R^-T (R^-1 g + Y' x) against the solution of H_uu u = -(g + H_ux x).
      const auto r = done.bottomRightCorner(count, count).triangularView<Eigen::Upper>();
      const VectorXd g = noise(random, count, 1.0), x = noise(random, left, 1.0);
      VectorXd u = r.solve(g);
      u += done.topRightCorner(left, count).transpose() * x;
      u = -r.transpose().solve(u).eval();
      CHECK((uu * u + g + xu.transpose() * x).cwiseAbs().maxCoeff() <= 1e-10);
    }
}

TEST_CASE("what is not positive definite in the variables to be eliminated is refused, whatever the others are") {
  Random random(72);
  for (int at : {3, 6, 7, 11}) {
    MatrixXd h = positive_definite(random, 12);
    h.row(at) *= -1.0;  // one negative eigenvalue
    h.col(at) *= -1.0;
    h(at, at) = -1.0;
    CHECK_FALSE(eliminate_last(h, 9));
  }
  MatrixXd h = MatrixXd::Identity(12, 12);
  h(1, 1) = -1.0;
  CHECK(eliminate_last(h, 9));
  for (double bad : {0.0, std::nan("")}) {
    h.setIdentity();
    h(10, 10) = bad;
    CHECK_FALSE(eliminate_last(h, 9));
  }
}
