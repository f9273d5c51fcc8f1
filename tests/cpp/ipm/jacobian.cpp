#include "ipm/jacobian.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <memory>

#include "nlp/problems.hpp"

using namespace mcplan;
using namespace mcplan::nlp;
using namespace mcplan::nlp::tests;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// Linear rows before, between and after curved ones.
void fill(Problem& problem) {
  problem.add_variables("x", 3, -10.0, 10.0, {0, 0});
  const auto line = [&](double slope) {
    problem.add_equality(
        std::make_unique<LinearPiece>("line", std::vector<int>{0, 2}, MatrixXd::Constant(1, 2, slope)));
  };
  line(2.0);
  problem.add_constraint(squared_norm("cap", {0, 1}), -kInfinity, 4.0);
  problem.add_constraint(squared_norm("cap", {1, 2}), -kInfinity, 4.0);
  line(-3.0);
  problem.add_constraint(squared_norm("cap", {2, 0}), -kInfinity, 4.0);
  line(5.0);
  problem.finish();
}

}  // namespace

TEST_CASE("the Jacobian is the problem's at one point after another, scaled where scales are given") {
  Problem problem;
  fill(problem);
  VectorXd expected(static_cast<int>(problem.jacobian_structure().size()));
  const VectorXd scales = VectorXd::LinSpaced(expected.size(), 1.0, 2.0);
  ipm::Jacobian plain(problem, {}), scaled(problem, scales);
  for (const Vector3d& x : {Vector3d(1.0, 2.0, 3.0), Vector3d(-4.0, 0.5, 0.0), Vector3d(0.0, -7.0, 1.5)}) {
    CAPTURE(x.transpose());
    problem.jacobian(x, expected);
    REQUIRE(plain.evaluate(x));
    REQUIRE(scaled.evaluate(x));
    CHECK(plain.values() == expected);
    CHECK(scaled.values() == expected.cwiseProduct(scales));
  }
}

TEST_CASE("a Jacobian that is not finite is said to be so, at the first point and at later ones") {
  Problem problem;
  fill(problem);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ipm::Jacobian jacobian(problem, {});
  CHECK_FALSE(jacobian.evaluate(Vector3d(1.0, nan, 1.0)));
  CHECK(jacobian.evaluate(Vector3d(1.0, 1.0, 1.0)));
  CHECK_FALSE(jacobian.evaluate(Vector3d(1.0, nan, 1.0)));
}
