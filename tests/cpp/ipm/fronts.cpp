#include "ipm/fronts.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <random>

#include "ipm/pivoting.hpp"

using namespace mcplan::ipm;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// A symmetric matrix, its structure, and an order in which to eliminate it.
struct Case {
  MatrixXd matrix;
  std::vector<Fronts::Pair> pairs;
  std::vector<std::vector<int>> order;
};

double draw(std::mt19937& random) { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); }

void set(Case& out, int a, int b, double value) {
  out.matrix(a, b) = out.matrix(b, a) = value;
  out.pairs.emplace_back(a, b);
}

/// min sum x_k' Q x_k, indefinite in what the dynamics fix, s.t. x_{k+1} = A x_k + B u_k: a chain of stages whose
/// unknowns are states, inputs and the multipliers of the dynamics that lead to it.
Case chain(int stages, int states, int inputs, int seed) {
  std::mt19937 random(seed);
  const int block = 2 * states + inputs;
  Case out;
  out.matrix = MatrixXd::Zero(stages * block, stages * block);
  out.order.resize(stages);
  for (int k = 0; k < stages; ++k) {
    const int at = k * block;
    for (int i = 0; i < block; ++i) out.order[stages - 1 - k].push_back(at + i);
    for (int i = 0; i < states + inputs; ++i)
      for (int j = 0; j <= i; ++j) set(out, at + i, at + j, (i == j ? (i < states ? 0.5 : 3.0) : 0.2 * draw(random)));
    for (int r = 0; r < states; ++r) {
      const int row = at + states + inputs + r;
      set(out, row, at + r, -1.0);
      for (int j = 0; k > 0 && j < states + inputs; ++j) set(out, row, at - block + j, draw(random));
    }
  }
  return out;
}

/// A band of blocks with an arrow, positive definite.
Case arrow(int blocks, int size, int heads, int seed) {
  std::mt19937 random(seed);
  const int n = blocks * size + heads;
  Case out;
  out.matrix = MatrixXd::Zero(n, n);
  for (int b = 0; b < blocks; ++b) {
    out.order.emplace_back();
    for (int i = 0; i < size; ++i) {
      const int row = b * size + i;
      out.order.back().push_back(row);
      for (int j = std::max(0, (b - 1) * size); j < row; ++j) set(out, row, j, draw(random));
      for (int h = 0; h < heads; ++h) set(out, blocks * size + h, row, draw(random));
    }
  }
  out.order.emplace_back();
  for (int h = 0; h < heads; ++h) out.order.back().push_back(blocks * size + h);
  for (int i = 0; i < n; ++i) out.matrix(i, i) = 1.0 + out.matrix.row(i).cwiseAbs().sum();
  return out;
}

void load(Fronts& fronts, const Case& given) {
  fronts.set_zero();
  for (std::size_t p = 0; p < given.pairs.size(); ++p) {
    const auto [a, b] = given.pairs[p];
    if (a != b) fronts.values()[fronts.places()[p]] += given.matrix(a, b);
  }
  for (int i = 0; i < given.matrix.rows(); ++i) fronts.values()[fronts.diagonal_places()[i]] += given.matrix(i, i);
}

}  // namespace

TEST_CASE("a factorisation solves as a dense one does, and counts the signs of the eigenvalues") {
  for (int seed = 0; seed < 30; ++seed) {
    const Case given = seed % 2 ? chain(1 + seed % 7, 1 + seed % 4, seed % 3, seed)
                                : arrow(1 + seed % 5, 1 + seed % 6, seed % 4, seed);
    CAPTURE(seed);
    const int n = static_cast<int>(given.matrix.rows());
    Fronts fronts(n, given.order, given.pairs);
    for (int again = 0; again < 2; ++again) {
      load(fronts, given);
      const Fronts::Inertia inertia = fronts.factor();
      const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(given.matrix).eigenvalues();
      CHECK(inertia.zero == 0);
      CHECK(inertia.negative == (eigenvalues.array() < 0.0).count());
      CHECK(inertia.positive == (eigenvalues.array() > 0.0).count());
    }
    std::mt19937 random(seed);
    VectorXd b(n);
    for (double& value : b) value = draw(random);
    VectorXd x = b;
    fronts.solve(x);
    const VectorXd expected = given.matrix.fullPivLu().solve(b);
    CHECK((x - expected).lpNorm<Eigen::Infinity>() <= 1e-9 * std::max(1.0, expected.lpNorm<Eigen::Infinity>()));
  }
}

TEST_CASE("the size of the fronts does not grow with the number of stages") {
  const auto largest = [](const Case& given) {
    return Fronts(static_cast<int>(given.matrix.rows()), given.order, given.pairs).largest_front();
  };
  CHECK(largest(chain(40, 3, 2, 1)) == largest(chain(4, 3, 2, 1)));
  CHECK(largest(arrow(40, 4, 3, 1)) == largest(arrow(4, 4, 3, 1)));
}

TEST_CASE("an unknown that nothing holds is a pivot of size zero, and a number that is none is one, too") {
  for (const double value : {0.0, std::nan("")}) {
    Fronts fronts(3, {{0}, {1, 2}}, {{0, 2}});
    fronts.set_zero();
    fronts.values()[fronts.diagonal_places()[0]] = 1.0;
    fronts.values()[fronts.places()[0]] = 0.5;
    fronts.values()[fronts.diagonal_places()[1]] = value;
    fronts.values()[fronts.diagonal_places()[2]] = 2.0;
    CHECK(fronts.factor().zero == 1);
  }
}

TEST_CASE("pivots of size two eliminate what has zeros on its diagonal") {
  MatrixXd F(4, 4);
  F << 0, 2, 1, 3, 2, 0, 5, 1, 1, 5, 0, 2, 3, 1, 2, 0;
  const MatrixXd given = F;
  int pivots[4];
  double off_diagonal[4];
  const PivotCount count = eliminate(F, 4, pivots, off_diagonal, 1e-300);
  CHECK(count.positive + count.negative == 4);
  MatrixXd L = MatrixXd::Identity(4, 4), D = MatrixXd::Zero(4, 4), P = MatrixXd::Zero(4, 4);
  for (int k = 0; k < 4; ++k) {
    D(k, k) = F(k, k);
    if (off_diagonal[k] != 0.0) D(k + 1, k) = D(k, k + 1) = off_diagonal[k];
    for (int i = k + 1; i < 4; ++i) L(i, k) = F(i, k);
    P(k, pivots[k]) = 1.0;
  }
  CHECK((P.transpose() * L * D * L.transpose() * P - given).cwiseAbs().maxCoeff() < 1e-13);
}
