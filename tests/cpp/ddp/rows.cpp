#include "ddp/rows.hpp"

#include <doctest/doctest.h>

#include "support.hpp"

namespace {

using namespace support;
using mcplan::ddp::Rows;

}  // namespace

TEST_CASE("the quadratic of rows is 1/2 sum w^2 (e + g'z)^2") {
  Random random(31);
  constexpr int kSize = 6;
  Rows rows(kSize, true), values(kSize, false);
  rows.begin(0);
  values.begin(0);
  struct Row {
    double weight, value;
    VectorXd gradient;
  };
  std::vector<Row> expected;
  for (int i = 0; i < 40; ++i) {  // more than the first allocation holds
    Row row{uniform(random, 0.1, 3.0), uniform(random, -1.0, 1.0), VectorXd::Zero(kSize)};
    if (i % 3 == 0) {
      row.gradient[i % kSize] = 1.0;
      rows.add_single(row.weight, row.value, i % kSize);
      values.add_single(row.weight, row.value, i % kSize);
    } else {
      row.gradient = noise(random, kSize, 1.0);
      rows.add_dense(row.weight, row.value) = row.gradient;
      values.add_value(row.weight, row.value);
    }
    expected.push_back(row);
  }
  rows.add_constant(0.25);
  values.add_constant(0.25);
  double c = 1.0;
  VectorXd g = VectorXd::Ones(kSize);
  MatrixXd h = MatrixXd::Identity(kSize, kSize);
  rows.accumulate(c, g, h);
  for (int trial = 0; trial < 5; ++trial) {
    const VectorXd z = noise(random, kSize, 1.0);
    double cost = 1.0 + 0.25 + z.sum() + 0.5 * z.squaredNorm();
    for (const Row& row : expected) {
      const double e = row.weight * (row.value + row.gradient.dot(z));
      cost += 0.5 * e * e;
    }
    CHECK(c + g.dot(z) + 0.5 * z.dot(h.selfadjointView<Eigen::Upper>() * z) == doctest::Approx(cost).epsilon(1e-13));
  }
  CHECK(values.cost() == doctest::Approx(rows.cost()).epsilon(1e-15));
  CHECK(rows.count() == 40);
  CHECK(values.count() == 0);

  rows.clear();
  CHECK(rows.cost() == 0.0);
  CHECK(rows.count() == 0);
  rows.add_dense(1.0, 1.0)[0] = 2.0;  // what an earlier row left in memory must not shine through
  CHECK(rows.gradient(0).tail(kSize - 1).isZero(0.0));
}

TEST_CASE("cost is kept by term") {
  Rows rows(3, true);
  rows.begin(2);
  rows.add_single(2.0, 3.0, 1);
  rows.begin(14);
  rows.add_constant(0.5);
  CHECK(rows.terms()[2] == 18.0);
  CHECK(rows.terms()[14] == 0.5);
  CHECK(rows.cost() == 18.5);
  rows.clear();
  for (double cost : rows.terms()) CHECK(cost == 0.0);
}
