#include "mcplan/nlp/derivative_check.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <sstream>

#include "mcplan/base/error.hpp"

namespace mcplan::nlp {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using NameOf = std::function<std::string(int)>;  ///< of the i-th variable of a piece

/// A piece's derivatives at a point, as it states them and by central differences.
struct Derivatives {
  MatrixXd J, J_difference;
  MatrixXd H, H_difference;  ///< of the rows' sum with the weights; the lower triangle counts
};

/// Cube root of the rounding error: truncation and rounding of a central difference are then alike.
double step(double x) { return 6e-6 * std::max(1.0, std::abs(x)); }

VectorXd values(const Piece& piece, const VectorXd& x) {
  VectorXd f = VectorXd::Zero(piece.rows());
  piece.values(x, f);
  return f;
}

MatrixXd jacobian(const Piece& piece, const VectorXd& x) {
  MatrixXd J = MatrixXd::Zero(piece.rows(), piece.size());
  piece.jacobian(x, J);
  return J;
}

Derivatives derivatives(const Piece& piece, const VectorXd& x) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> weight(0.5, 1.5);
  VectorXd weights(piece.rows());
  for (double& w : weights) w = weight(random);

  const int n = piece.size();
  Derivatives out;
  // A linear piece is taken at its word: its Jacobian is read at one point, far away from this one, its Hessian never.
  out.J = jacobian(piece, piece.linear() ? VectorXd::Zero(n) : x);
  out.H = MatrixXd::Zero(n, n);
  if (!piece.linear()) piece.hessian(x, weights, out.H);
  out.J_difference.resize(piece.rows(), n);
  out.H_difference.resize(n, n);
  for (int i = 0; i < n; ++i) {
    VectorXd above = x, below = x;
    above[i] += step(x[i]);
    below[i] -= step(x[i]);
    const double width = above[i] - below[i];
    out.J_difference.col(i) = (values(piece, above) - values(piece, below)) / width;
    out.H_difference.col(i) = (jacobian(piece, above) - jacobian(piece, below)).transpose() * weights / width;
  }
  return out;
}

double error_of(double given, double difference) {
  return std::abs(given - difference) / std::max(1.0, std::abs(difference));
}

double error_of(const WrongDerivative& wrong) { return error_of(wrong.given, wrong.difference); }

/// NaN counts as wrong.
bool differ(double given, double difference, double tolerance) { return !(error_of(given, difference) <= tolerance); }

void compare(const Piece& piece, const Derivatives& at, const NameOf& name, double tolerance,
             std::vector<WrongDerivative>& out) {
  for (int column = 0; column < piece.size(); ++column) {
    for (int row = 0; row < piece.rows(); ++row)
      if (differ(at.J(row, column), at.J_difference(row, column), tolerance))
        out.push_back(
            {piece.name(), "jacobian", row, name(column), "", at.J(row, column), at.J_difference(row, column)});
    for (int row = column; row < piece.size(); ++row)
      if (differ(at.H(row, column), at.H_difference(row, column), tolerance))
        out.push_back(
            {piece.name(), "hessian", -1, name(row), name(column), at.H(row, column), at.H_difference(row, column)});
  }
}

/// Entries that are not zero at the point although the problem's structure has no place for them.
void compare_structure(const Problem::Block& block, const Derivatives& at, const NameOf& name, double tolerance,
                       std::vector<WrongDerivative>& out) {
  const Piece& piece = *block.piece;
  MatrixXd J = at.J, H = at.H;
  for (int place : block.jacobian_from) J.data()[place] = 0.0;
  for (int place : block.hessian_from) H.data()[place] = 0.0;
  for (int column = 0; column < piece.size(); ++column) {
    for (int row = 0; row < piece.rows(); ++row)
      if (differ(0.0, J(row, column), tolerance))
        out.push_back({piece.name(), "structure", row, name(column), "", 0.0, at.J_difference(row, column)});
    for (int row = column; row < piece.size(); ++row)
      if (differ(0.0, H(row, column), tolerance))
        out.push_back({piece.name(), "structure", -1, name(row), name(column), 0.0, at.H_difference(row, column)});
  }
}

void sort_worst_first(std::vector<WrongDerivative>& wrong) {
  const auto rank = [](const WrongDerivative& w) {
    const double error = error_of(w);
    return std::isnan(error) ? kInfinity : error;
  };
  std::stable_sort(wrong.begin(), wrong.end(),
                   [&](const WrongDerivative& a, const WrongDerivative& b) { return rank(a) > rank(b); });
}

void require(const char* field, const VectorXd& x, int size, double tolerance) {
  if (x.size() != size)
    throw InvalidInput(field, "must have " + text(size) + " values", text(static_cast<int>(x.size())));
  if (!x.allFinite()) throw InvalidInput(field, "must be finite", text(x));
  if (!(tolerance > 0.0)) throw InvalidInput("tolerance", "must be a positive number", text(tolerance));
}

}  // namespace

std::string WrongDerivative::to_string() const {
  std::ostringstream out;
  out << piece << ": " << kind;
  if (row >= 0) out << ", row " << row;
  out << ", d/d " << first;
  if (!second.empty()) out << " d/d " << second;
  out << ": " << given << ", central difference " << difference;
  return out.str();
}

std::vector<WrongDerivative> check_derivatives(const Piece& piece, const VectorXd& x, double tolerance) {
  require("x", x, piece.size(), tolerance);
  std::vector<WrongDerivative> out;
  const NameOf name = [](int i) { return "x[" + std::to_string(i) + "]"; };
  compare(piece, derivatives(piece, x), name, tolerance, out);
  sort_worst_first(out);
  return out;
}

std::vector<WrongDerivative> check_derivatives(const Problem& problem, const VectorXd& x, double tolerance) {
  require("x", x, problem.variable_count(), tolerance);
  std::vector<WrongDerivative> out;
  for (const Problem::Block& block : problem.blocks()) {
    const std::vector<int>& variables = block.piece->variables();
    const VectorXd local = x(variables);
    const NameOf name = [&](int i) { return problem.variable_name(variables[i]); };
    const Derivatives at = derivatives(*block.piece, local);
    compare(*block.piece, at, name, tolerance, out);
    compare_structure(block, at, name, tolerance, out);
  }
  sort_worst_first(out);
  return out;
}

}  // namespace mcplan::nlp
