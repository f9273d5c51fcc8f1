#pragma once

#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mcplan/nlp/solver.hpp"
#include "nlp/problems.hpp"

namespace mcplan::nlp::tests {

using Eigen::Vector2d;
using Eigen::VectorXd;

inline bool before_3_14() { return std::stoi(ipopt_version().substr(2)) < 14; }

inline bool same_bytes(const VectorXd& a, const VectorXd& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0;
}

/// Rosenbrock's valley from (-1.2, 1): some twenty iterations. The spies are called with the point.
struct Valley {
  using Spy = std::function<void(const ConstVector&)>;
  explicit Valley(Spy in_values = nullptr, Spy in_jacobian = nullptr, Spy in_hessian = nullptr) {
    problem.add_variables("x", 2, -10.0, 10.0, {3, 3});
    problem.add_cost(std::make_unique<FunctionPiece>(
        "valley", std::vector<int>{0, 1}, 1,
        [=, on = armed](const ConstVector& x, Vector f) {
          if (in_values && *on) in_values(x);
          f[0] = 100 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1 - x[0], 2);
        },
        [=, on = armed](const ConstVector& x, Matrix J) {
          if (in_jacobian && *on) in_jacobian(x);
          J << -400 * x[0] * (x[1] - x[0] * x[0]) - 2 * (1 - x[0]), 200 * (x[1] - x[0] * x[0]);
        },
        [=, on = armed](const ConstVector& x, const ConstVector& w, Matrix H) {
          if (in_hessian && *on) in_hessian(x);
          H(0, 0) = w[0] * (1200 * x[0] * x[0] - 400 * x[1] + 2);
          H(1, 0) = w[0] * -400 * x[0];
          H(1, 1) = w[0] * 200;
        }));
    problem.finish();
    *armed = true;
  }

  Problem problem;
  std::shared_ptr<bool> armed = std::make_shared<bool>(false);  ///< finish() is not spied on
  VectorXd x0 = Vector2d(-1.2, 1.0);
};

}  // namespace mcplan::nlp::tests
