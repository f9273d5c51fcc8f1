#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mcplan/nlp/problem.hpp"

/// Small problems, some with known optima, some with a fault.
namespace mcplan::nlp::tests {

using Values = std::function<void(const ConstVector&, Vector)>;
using Jacobian = std::function<void(const ConstVector&, Matrix)>;
using HessianOf = std::function<void(const ConstVector&, const ConstVector&, Matrix)>;

/// A piece from three functions.
class FunctionPiece : public Piece {
 public:
  FunctionPiece(std::string name, std::vector<int> variables, int rows, Values values, Jacobian jacobian,
                HessianOf hessian)
      : Piece(std::move(name), std::move(variables), rows),
        values_(std::move(values)),
        jacobian_(std::move(jacobian)),
        hessian_(std::move(hessian)) {}

  void values(const ConstVector& x, Vector f) const override { values_(x, f); }
  void jacobian(const ConstVector& x, Matrix J) const override { jacobian_(x, J); }
  void hessian(const ConstVector& x, const ConstVector& weights, Matrix H) const override { hessian_(x, weights, H); }

 private:
  Values values_;
  Jacobian jacobian_;
  HessianOf hessian_;
};

/// sum_i (x_i - target_i)^2, one row.
inline std::unique_ptr<Piece> squared_distance(std::vector<int> variables, Eigen::VectorXd target,
                                               std::function<void(const ConstVector&)> spy = nullptr) {
  return std::make_unique<FunctionPiece>(
      "distance", std::move(variables), 1,
      [target, spy](const ConstVector& x, Vector f) {
        if (spy) spy(x);
        f[0] = (x - target).squaredNorm();
      },
      [target](const ConstVector& x, Matrix J) { J = 2.0 * (x - target).transpose(); },
      [](const ConstVector& x, const ConstVector& w, Matrix H) {
        H = 2.0 * w[0] * Eigen::MatrixXd::Identity(x.size(), x.size());
      });
}

/// sum_i x_i^2.
inline std::unique_ptr<Piece> squared_norm(std::string name, std::vector<int> variables) {
  return std::make_unique<FunctionPiece>(
      std::move(name), std::move(variables), 1, [](const ConstVector& x, Vector f) { f[0] = x.squaredNorm(); },
      [](const ConstVector& x, Matrix J) { J = 2.0 * x.transpose(); },
      [](const ConstVector& x, const ConstVector& w, Matrix H) {
        H = 2.0 * w[0] * Eigen::MatrixXd::Identity(x.size(), x.size());
      });
}

/// Hock and Schittkowski's problem 71: min x0 x3 (x0 + x1 + x2) + x2, x0 x1 x2 x3 >= 25, |x|^2 = 40, 1 <= x <= 5.
struct HockSchittkowski71 {
  HockSchittkowski71() {
    problem.add_variables("x", 4, 1.0, 5.0, {0, 0});
    problem.add_cost(std::make_unique<FunctionPiece>(
        "cost", std::vector<int>{0, 1, 2, 3}, 1,
        [](const ConstVector& x, Vector f) { f[0] = x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2]; },
        [](const ConstVector& x, Matrix J) {
          J << x[3] * (2 * x[0] + x[1] + x[2]), x[0] * x[3], x[0] * x[3] + 1.0, x[0] * (x[0] + x[1] + x[2]);
        },
        [](const ConstVector& x, const ConstVector& w, Matrix H) {
          H(0, 0) = w[0] * 2 * x[3];
          H(1, 0) = H(2, 0) = w[0] * x[3];
          H(3, 0) = w[0] * (2 * x[0] + x[1] + x[2]);
          H(3, 1) = H(3, 2) = w[0] * x[0];
        }));
    problem.add_constraint(
        std::make_unique<FunctionPiece>(
            "product", std::vector<int>{0, 1, 2, 3}, 1, [](const ConstVector& x, Vector f) { f[0] = x.prod(); },
            [](const ConstVector& x, Matrix J) {
              J << x[1] * x[2] * x[3], x[0] * x[2] * x[3], x[0] * x[1] * x[3], x[0] * x[1] * x[2];
            },
            [](const ConstVector& x, const ConstVector& w, Matrix H) {
              for (int i = 0; i < 4; ++i)
                for (int j = 0; j < i; ++j) {
                  H(i, j) = w[0];
                  for (int k = 0; k < 4; ++k)
                    if (k != i && k != j) H(i, j) *= x[k];
                }
            }),
        25.0, kInfinity);
    problem.add_constraint(squared_norm("sphere", {0, 1, 2, 3}), 40.0, 40.0);
    problem.finish();
    x0 = Eigen::Vector4d(1, 5, 5, 1);
    optimum = Eigen::Vector4d(1.0, 4.74299963, 3.82114998, 1.37940829);
  }

  Problem problem;
  Eigen::VectorXd x0, optimum;
  double cost = 17.0140173;
};

}  // namespace mcplan::nlp::tests
