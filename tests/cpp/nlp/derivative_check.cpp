#include "mcplan/nlp/derivative_check.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "mcplan/base/error.hpp"
#include "nlp/problems.hpp"

using namespace mcplan;
using namespace mcplan::nlp;
using namespace mcplan::nlp::tests;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// f_0 = x_0 x_1 + sin x_2, f_1 = x_1^2 x_2, with errors added to one entry of the Jacobian and one of the Hessian.
std::unique_ptr<Piece> curved(std::vector<int> variables, double jacobian_error = 0.0, double hessian_error = 0.0) {
  return std::make_unique<FunctionPiece>(
      "curved", std::move(variables), 2,
      [](const ConstVector& x, Vector f) { f << x[0] * x[1] + std::sin(x[2]), x[1] * x[1] * x[2]; },
      [=](const ConstVector& x, Matrix J) {
        J << x[1], x[0], std::cos(x[2]), 0.0, 2 * x[1] * x[2], x[1] * x[1];
        J(1, 2) += jacobian_error;
      },
      [=](const ConstVector& x, const ConstVector& w, Matrix H) {
        H(1, 0) = w[0];
        H(1, 1) = 2 * x[2] * w[1];
        H(2, 1) = 2 * x[1] * w[1] + hessian_error;
        H(2, 2) = -std::sin(x[2]) * w[0];
      });
}

VectorXd random_point(int size, int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-3.0, 3.0);
  VectorXd x(size);
  for (double& v : x) v = value(random);
  return x;
}

/// x_0, and x_1 besides where x_0 > 2: an entry that no point in [-1.5, 1.5] shows.
std::unique_ptr<Piece> branching() {
  return std::make_unique<FunctionPiece>(
      "branch", std::vector<int>{3, 1}, 1,
      [](const ConstVector& x, Vector f) { f[0] = x[0] + (x[0] > 2 ? x[1] * x[1] : 0.0); },
      [](const ConstVector& x, Matrix J) { J << 1.0, (x[0] > 2 ? 2 * x[1] : 0.0); },
      [](const ConstVector& x, const ConstVector& w, Matrix H) { H(1, 1) = x[0] > 2 ? 2 * w[0] : 0.0; });
}

/// Claims to be linear.
struct Pretender : Piece {
  Pretender() : Piece("pretender", {0}, 1) {}
  void values(const ConstVector& x, Vector f) const override { f[0] = x[0] * x[0]; }
  void jacobian(const ConstVector& x, Matrix J) const override { J(0, 0) = 2 * x[0]; }
  void hessian(const ConstVector&, const ConstVector& w, Matrix H) const override { H(0, 0) = 2 * w[0]; }
  bool linear() const override { return true; }
};

}  // namespace

TEST_CASE("right derivatives pass at any point") {
  for (int seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    CHECK(check_derivatives(*curved({0, 1, 2}), random_point(3, seed)).empty());
    const HockSchittkowski71 hs;
    CHECK(check_derivatives(hs.problem, 2.0 * random_point(4, seed)).empty());
  }
}

TEST_CASE("a wrong entry is named, and it alone") {
  const VectorXd x = random_point(3, 1);
  const auto jacobian = check_derivatives(*curved({0, 1, 2}, 1e-3), x);
  REQUIRE(jacobian.size() == 1);
  CHECK(jacobian[0].piece == "curved");
  CHECK(jacobian[0].kind == "jacobian");
  CHECK(jacobian[0].row == 1);
  CHECK(jacobian[0].first == "x[2]");
  CHECK(std::abs(jacobian[0].difference - x[1] * x[1]) < 1e-7);

  const auto hessian = check_derivatives(*curved({0, 1, 2}, 0.0, 0.5), x);
  REQUIRE(hessian.size() == 1);
  CHECK(hessian[0].kind == "hessian");
  CHECK(hessian[0].first == "x[2]");
  CHECK(hessian[0].second == "x[1]");
  CHECK(std::abs(hessian[0].given - hessian[0].difference - 0.5) < 1e-6);

  CHECK(check_derivatives(*curved({0, 1, 2}, 1e-7), x).empty());
}

TEST_CASE("in a problem the entry is named by its variables, worst first") {
  Problem problem;
  problem.add_variables("com", 2, -5, 5, {3, 3});
  problem.add_variables("force", 3, -5, 5, {3, 3});
  problem.add_cost(curved({4, 0, 1}, 0.0, 0.1));
  problem.add_constraint(curved({0, 2, 3}, 2.0), 0.0, 1.0);
  problem.finish();
  const auto wrong = check_derivatives(problem, VectorXd::Constant(5, 0.5));
  REQUIRE(wrong.size() == 2);
  CHECK(wrong[0].to_string() == "curved: jacobian, row 1, d/d force[1] at stage 3: 2.25, central difference 0.25");
  CHECK(wrong[1].kind == "hessian");
  CHECK(wrong[1].first == "com[1] at stage 3");
  CHECK(wrong[1].second == "com[0] at stage 3");
}

TEST_CASE("an entry that the structure leaves out is named") {
  Problem problem;
  problem.add_variables("x", 4, -5, 5, {0, 0});
  problem.add_constraint(branching(), 0.0, 1.0);
  problem.finish();
  CHECK(check_derivatives(problem, VectorXd::Constant(4, 1.0)).empty());
  const auto wrong = check_derivatives(problem, VectorXd::Constant(4, 3.0));
  REQUIRE(wrong.size() == 2);
  CHECK(wrong[0].to_string() == "branch: structure, row 0, d/d x[1] at stage 0: 0, central difference 6");
  CHECK(wrong[1].kind == "structure");
  CHECK(wrong[1].row == -1);
  CHECK(wrong[1].first == "x[1] at stage 0");
  CHECK(wrong[1].second == "x[1] at stage 0");
}

TEST_CASE("a curved piece that claims to be linear is found out") {
  const auto wrong = check_derivatives(Pretender(), VectorXd::Constant(1, 0.7));
  REQUIRE(wrong.size() == 2);
  CHECK(wrong[0].kind == "jacobian");
  CHECK(wrong[1].kind == "hessian");
}

TEST_CASE("a derivative that is not a number is wrong, and worst") {
  const auto wrong = check_derivatives(*curved({0, 1, 2}, std::nan("")), random_point(3, 2));
  REQUIRE(!wrong.empty());
  CHECK(std::isnan(wrong[0].given + wrong[0].difference));
}

TEST_CASE("points of the wrong size are refused") {
  CHECK_THROWS_WITH_AS(check_derivatives(*curved({0, 1, 2}), VectorXd::Zero(2)), "x: must have 3 values, got 2",
                       InvalidInput);
}
