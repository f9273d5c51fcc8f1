#include "wb/block_band.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <random>

using Eigen::MatrixXd;
using Eigen::VectorXd;
using mcplan::wb::BlockBand;

TEST_CASE("a band of blocks is solved as the dense matrix is") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  for (int blocks : {1, 2, 3, 7}) {
    const int size = 4;
    MatrixXd factor = MatrixXd::Zero(blocks * size, blocks * size);
    for (int i = 0; i < blocks; ++i)
      for (int j = std::max(0, i - 2); j <= i; ++j)
        factor.block(i * size, j * size, size, size) = MatrixXd::NullaryExpr(size, size, [&] { return draw(random); });
    const MatrixXd dense = factor * factor.transpose() + MatrixXd::Identity(blocks * size, blocks * size);
    BlockBand band(blocks, size);
    band.set_zero();
    for (int i = 0; i < blocks; ++i)
      for (int below = 0; below < 3 && i + below < blocks; ++below)
        band.block(i, below) = dense.block((i + below) * size, i * size, size, size);
    REQUIRE(band.factor());
    const VectorXd right = VectorXd::NullaryExpr(blocks * size, [&] { return draw(random); });
    VectorXd solution = right;
    band.solve(solution);
    CHECK((dense * solution - right).norm() < 1e-10 * right.norm());
  }
}

TEST_CASE("a band that is not positive definite is refused") {
  BlockBand band(3, 2);
  band.set_zero();
  for (int i = 0; i < 3; ++i) band.block(i, 0).setIdentity();
  band.block(1, 0)(1, 1) = -1.0;
  CHECK_FALSE(band.factor());
}
