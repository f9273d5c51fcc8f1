#include "mcplan/nlp/problem.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "nlp/problems.hpp"

using namespace mcplan::nlp;
using namespace mcplan::nlp::tests;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Dense matrix of the sparse values; entries named twice would be added.
MatrixXd dense(int rows, int columns, const std::vector<Entry>& structure, const VectorXd& values) {
  MatrixXd out = MatrixXd::Zero(rows, columns);
  for (std::size_t i = 0; i < structure.size(); ++i) out(structure[i].row, structure[i].column) += values[i];
  return out;
}

MatrixXd jacobian(const Problem& problem, const VectorXd& x) {
  VectorXd values(problem.jacobian_structure().size());
  problem.jacobian(x, values);
  return dense(problem.row_count(), problem.variable_count(), problem.jacobian_structure(), values);
}

MatrixXd hessian(const Problem& problem, const VectorXd& x, double factor, const VectorXd& multipliers) {
  VectorXd values(problem.hessian_structure().size());
  problem.hessian(x, factor, multipliers, values);
  const MatrixXd lower = dense(problem.variable_count(), problem.variable_count(), problem.hessian_structure(), values);
  CHECK(lower.isLowerTriangular());
  return lower;
}

/// x_0 x_1 of its own two variables.
std::unique_ptr<Piece> product(std::string name, int a, int b, int* jacobian_calls = nullptr) {
  return std::make_unique<FunctionPiece>(
      std::move(name), std::vector<int>{a, b}, 1, [](const ConstVector& x, Vector f) { f[0] = x[0] * x[1]; },
      [=](const ConstVector& x, Matrix J) {
        if (jacobian_calls) ++*jacobian_calls;
        J << x[1], x[0];
      },
      [](const ConstVector&, const ConstVector& w, Matrix H) { H(1, 0) = w[0]; });
}

}  // namespace

TEST_CASE("overlapping pieces add up to the derivatives worked out by hand") {
  // cost x0 x2 + |(x0, x2)|^2 + x0 x1, rows x1 x0 and (x0 + 2 x1, -3 x2); x2 before x0 in one of the pieces
  Problem problem;
  problem.add_variables("x", 3, -5, 5, {0, 0});
  problem.add_cost(product("a", 2, 0));
  problem.add_cost(squared_norm("b", {0, 2}));
  problem.add_cost(product("c", 0, 1));
  problem.add_equality(product("d", 1, 0));
  problem.add_constraint(
      std::make_unique<LinearPiece>("e", std::vector<int>{2, 0, 1}, (MatrixXd(2, 3) << 0, 1, 2, -3, 0, 0).finished()),
      -1.0, 1.0);
  problem.finish();
  CHECK(problem.row_count() == 3);
  CHECK(problem.equality_count() == 1);
  CHECK(problem.jacobian_structure().size() == 5);  // the zeros of e have no place
  CHECK(problem.hessian_structure().size() == 4);   // (0,0) (2,2) (2,0) (1,0)

  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-2, 2);
  for (int trial = 0; trial < 20; ++trial) {
    VectorXd x(3), multipliers(3), gradient(3), rows(3);
    for (double& v : x) v = value(random);
    for (double& v : multipliers) v = value(random);
    const double factor = value(random);

    CHECK(std::abs(problem.cost(x) - (x[0] * x[2] + x[0] * x[0] + x[2] * x[2] + x[0] * x[1])) < 1e-14);
    problem.gradient(x, gradient);
    CHECK((gradient - Eigen::Vector3d(x[2] + 2 * x[0] + x[1], x[0], x[0] + 2 * x[2])).norm() < 1e-14);
    problem.rows(x, rows);
    CHECK((rows - Eigen::Vector3d(x[0] * x[1], x[0] + 2 * x[1], -3 * x[2])).norm() < 1e-14);
    CHECK((jacobian(problem, x) - (MatrixXd(3, 3) << x[1], x[0], 0, 1, 2, 0, 0, 0, -3).finished()).norm() < 1e-14);
    const double l = multipliers[0];
    CHECK((hessian(problem, x, factor, multipliers) -
           (MatrixXd(3, 3) << 2 * factor, 0, 0, factor + l, 0, 0, factor, 0, 2 * factor).finished())
              .norm() < 1e-14);
  }
}

TEST_CASE("no entry of the structure is named twice") {
  const HockSchittkowski71 hs;
  for (const auto* structure : {&hs.problem.jacobian_structure(), &hs.problem.hessian_structure()})
    for (std::size_t i = 0; i < structure->size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        CHECK_FALSE(((*structure)[i].row == (*structure)[j].row && (*structure)[i].column == (*structure)[j].column));
}

TEST_CASE("the Jacobian of a linear piece is evaluated by finish() alone") {
  struct Counting : LinearPiece {
    using LinearPiece::LinearPiece;
    mutable int calls = 0;
    void jacobian(const ConstVector& x, Matrix J) const override {
      ++calls;
      LinearPiece::jacobian(x, J);
    }
  };
  Problem problem;
  problem.add_variables("x", 2, -5, 5, {0, 0});
  auto piece = std::make_unique<Counting>("sum", std::vector<int>{0, 1}, MatrixXd::Ones(1, 2));
  const Counting& counting = *piece;
  int curved_calls = 0;
  problem.add_equality(std::move(piece));
  problem.add_equality(product("product", 0, 1, &curved_calls));
  problem.finish();
  const int calls = counting.calls, curved_before = curved_calls;
  for (int i = 0; i < 5; ++i) jacobian(problem, VectorXd::Constant(2, i));
  CHECK(counting.calls == calls);
  CHECK(curved_calls == curved_before + 5);
}

TEST_CASE("values are the same without derivatives, and a problem is not finished when asked to stop") {
  const auto made = [] {
    Problem problem;
    problem.add_variables("x", 3, -1, 1, {0, 0});
    problem.add_constraint(product("product", 0, 2), -0.1, 0.1);
    problem.add_constraint(std::make_unique<LinearPiece>("sum", std::vector<int>{0, 1}, MatrixXd::Ones(1, 2)), 0.0,
                           1.0);
    problem.add_cost(product("cost", 1, 2));
    return problem;
  };
  Problem whole = made(), values = made();
  CHECK(whole.finish());
  values.finish_for_values();
  const Eigen::Vector3d x(0.3, -0.7, 0.9);
  CHECK(values.cost(x) == whole.cost(x));
  CHECK(values.worst_violation(x).value == whole.worst_violation(x).value);
  CHECK(values.worst_violation(x).name == whole.worst_violation(x).name);
  CHECK(values.jacobian_structure().empty());
  for (int last : {0, 1, 2}) {
    Problem stopped = made();
    int polls = 0;
    CHECK_FALSE(stopped.finish([&] { return polls++ == last; }));
    CHECK(polls == last + 1);
  }
}

TEST_CASE("the worst violation is named, of a bound or of a row") {
  Problem problem;
  problem.add_variables("com", 2, -1, 1, {4, 4});
  problem.add_variables("force", 1, 0, 10, {5, 5});
  problem.add_constraint(std::make_unique<LinearPiece>("reach", std::vector<int>{0, 1}, MatrixXd::Identity(2, 2)), -0.5,
                         0.5);
  problem.add_constraint(product("moment", 1, 2), -kInfinity, 3.0);
  problem.finish();
  const auto worst = [&](double a, double b, double f) { return problem.worst_violation(Eigen::Vector3d(a, b, f)); };
  CHECK(worst(0.5, 0.5, 6.0).value == 0.0);
  CHECK(worst(0.5, 0.5, 6.0).name == "");
  CHECK(worst(0.0, 0.75, 1.0).name == "reach[1] at stage 4");
  CHECK(worst(0.0, 0.75, 1.0).value == 0.25);
  CHECK(worst(0.0, 0.0, -2.0).name == "force at stage 5");
  CHECK(worst(0.0, 0.0, -2.0).value == 2.0);
  CHECK(worst(0.0, 0.5, 9.0).name == "moment at stage 5");
  CHECK(worst(0.0, 0.5, 9.0).value == 1.5);
  CHECK(problem.variable_name(1) == "com[1] at stage 4");
}

TEST_CASE("a row that is not a number is the worst violation, whichever rows follow") {
  for (const bool first : {true, false}) {
    Problem problem;
    problem.add_variables("x", 1, -5, 5, {0, 0});
    const auto add_root = [&] {
      problem.add_equality(std::make_unique<FunctionPiece>(
          "root", std::vector<int>{0}, 1, [](const ConstVector& x, Vector f) { f[0] = std::sqrt(x[0]); },
          [](const ConstVector& x, Matrix J) { J(0, 0) = 0.5 / std::sqrt(x[0]); },
          [](const ConstVector& x, const ConstVector& w, Matrix H) { H(0, 0) = -0.25 * w[0] * std::pow(x[0], -1.5); }));
    };
    if (first) add_root();
    problem.add_equality(std::make_unique<LinearPiece>("line", std::vector<int>{0}, MatrixXd::Ones(1, 1)));
    if (!first) add_root();
    problem.finish();
    const VectorXd x = VectorXd::Constant(1, -1.0);
    CHECK(std::isnan(problem.worst_violation(x).value));
    CHECK(problem.worst_violation(x).name == "root at stage 0");
    CHECK(problem.first_not_finite(x) == "constraint root at stage 0");
    CHECK(problem.first_not_finite(-x) == "");
  }
}
