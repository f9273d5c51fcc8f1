// A cart swings its pole up within a short rail and with a weak motor: the interior-point kernel on a problem of one's
// own.

#include <cmath>
#include <cstdio>
#include <mcplan/mcplan.hpp>
#include <memory>
#include <string>
#include <vector>

namespace {

using mcplan::nlp::ConstVector;
using mcplan::nlp::kInfinity;
using mcplan::nlp::Matrix;
using mcplan::nlp::Vector;

constexpr double kPi = 3.14159265358979323846;
constexpr double kCart = 1.0, kPole = 0.3, kLength = 0.5, kGravity = 9.81;  // masses [kg], rod [m], [m/s^2]
constexpr double kRail = 0.6, kForce = 12.0;  // the cart keeps within +-kRail [m], its motor gives +-kForce [N]
constexpr int kSteps = 50;
constexpr double kStep = 0.04;  // [s]

/// Indices of some variables that follow each other, and of others behind them.
std::vector<int> indices(std::vector<std::pair<int, int>> first_and_size) {
  std::vector<int> out;
  for (const auto& [first, size] : first_and_size)
    for (int i = 0; i < size; ++i) out.push_back(first + i);
  return out;
}

/// At each stage: position of the cart [m], angle of the pole from hanging [rad], their velocities; then force of the
/// motor [N] and the two accelerations. The equations of motion tie them:
///
///     (cart + pole) a + pole length (alpha cos(angle) - omega^2 sin(angle)) = force
///     length alpha + a cos(angle) + gravity sin(angle) = 0
class Motion : public mcplan::nlp::Piece {
 public:
  Motion(int x, int u) : Piece("motion", indices({{x, 4}, {u, 3}}), 2) {}

  void values(const ConstVector& v, Vector f) const override {
    const double angle = v[1], omega = v[3], force = v[4], a = v[5], alpha = v[6];
    const double s = std::sin(angle), c = std::cos(angle);
    f[0] = (kCart + kPole) * a + kPole * kLength * (alpha * c - omega * omega * s) - force;
    f[1] = kLength * alpha + a * c + kGravity * s;
  }

  void jacobian(const ConstVector& v, Matrix J) const override {
    const double angle = v[1], omega = v[3], a = v[5], alpha = v[6];
    const double s = std::sin(angle), c = std::cos(angle), ml = kPole * kLength;
    J.row(0) << 0.0, -ml * (alpha * s + omega * omega * c), 0.0, -2.0 * ml * omega * s, -1.0, kCart + kPole, ml * c;
    J.row(1) << 0.0, -a * s + kGravity * c, 0.0, 0.0, 0.0, c, kLength;
  }

  void hessian(const ConstVector& v, const ConstVector& weights, Matrix H) const override {
    const double angle = v[1], omega = v[3], a = v[5], alpha = v[6];
    const double s = std::sin(angle), c = std::cos(angle), ml = kPole * kLength;
    H(1, 1) = weights[0] * ml * (omega * omega * s - alpha * c) - weights[1] * (a * c + kGravity * s);
    H(3, 1) = -weights[0] * 2.0 * ml * omega * c;  // the lower triangle is enough
    H(3, 3) = -weights[0] * 2.0 * ml * s;
    H(5, 1) = -weights[1] * s;
    H(6, 1) = -weights[0] * ml * s;
  }
};

/// weight force^2
class Effort : public mcplan::nlp::Piece {
 public:
  Effort(int force, double weight) : Piece("effort", {force}, 1), weight_(weight) {}

  void values(const ConstVector& v, Vector f) const override { f[0] = weight_ * v[0] * v[0]; }
  void jacobian(const ConstVector& v, Matrix J) const override { J(0, 0) = 2.0 * weight_ * v[0]; }
  void hessian(const ConstVector&, const ConstVector& weights, Matrix H) const override {
    H(0, 0) = 2.0 * weight_ * weights[0];
  }

 private:
  double weight_;
};

/// A swing-up, and where its variables lie.
struct SwingUp {
  SwingUp() {
    for (int k = 0; k <= kSteps; ++k) {
      x.push_back(problem.add_variables("x", 4, -kInfinity, kInfinity, {k, k}));
      u.push_back(problem.add_variables("u", 3, -kInfinity, kInfinity, {k, k}));
      problem.set_bounds(x[k], -kRail, kRail);
      problem.set_bounds(u[k], -kForce, kForce);
    }
    const double standing[] = {0.0, kPi, 0.0, 0.0};
    for (int i = 0; i < 4; ++i) {
      problem.set_bounds(x[0] + i, 0.0, 0.0);  // hanging
      problem.set_bounds(x[kSteps] + i, standing[i], standing[i]);
    }

    for (int k = 0; k <= kSteps; ++k) {
      problem.add_equality(std::make_unique<Motion>(x[k], u[k]));
      const double trapezoid = k == 0 || k == kSteps ? kStep / 2.0 : kStep;
      problem.add_cost(std::make_unique<Effort>(u[k], trapezoid));  // integral of force^2
    }

    // x[k+1] = x[k] + kStep / 2 (rate[k] + rate[k+1]), where the rates are velocities and accelerations
    Eigen::MatrixXd rate_of_x = Eigen::MatrixXd::Zero(4, 4), rate_of_u = Eigen::MatrixXd::Zero(4, 3);
    rate_of_x(0, 2) = rate_of_x(1, 3) = rate_of_u(2, 1) = rate_of_u(3, 2) = kStep / 2.0;
    const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(4, 4);
    Eigen::MatrixXd step(4, 14);
    step << I + rate_of_x, rate_of_u, rate_of_x - I, rate_of_u;
    for (int k = 0; k < kSteps; ++k)
      problem.add_equality(std::make_unique<mcplan::nlp::LinearPiece>(
          "step", indices({{x[k], 4}, {u[k], 3}, {x[k + 1], 4}, {u[k + 1], 3}}), step));
    problem.finish();

    start = Eigen::VectorXd::Zero(problem.variable_count());
    for (int k = 0; k <= kSteps; ++k) start[x[k] + 1] = kPi * k / kSteps;
  }

  mcplan::nlp::Problem problem;
  std::vector<int> x, u;
  Eigen::VectorXd start;
};

}  // namespace

int main() {
  const SwingUp swing_up;
  for (const auto& wrong : mcplan::nlp::check_derivatives(swing_up.problem, swing_up.start))
    std::printf("%s\n", wrong.to_string().c_str());

  mcplan::nlp::SolverOptions options;
  options.tolerance = options.constraint_tolerance = 1e-7;
  const auto result = mcplan::ipm::solve(swing_up.problem, swing_up.start, options);
  const std::string status(mcplan::to_string(mcplan::nlp::status_of(result.outcome)));
  std::printf("%s: integral of force^2 = %.4f N^2 s, violation below 1e-7: %s\n", status.c_str(), result.cost,
              result.worst.value < 1e-7 ? "True" : "False");

  const Eigen::VectorXd cart = result.x(swing_up.x), force = result.x(swing_up.u);  // the first of each stage
  std::printf("cart between %.4f and %.4f m, force between %.4f and %.4f N\n", cart.minCoeff(), cart.maxCoeff(),
              force.minCoeff(), force.maxCoeff());
  for (int k = 0; k <= kSteps; k += 10)
    std::printf("t = %.1f s: cart %7.4f m, pole %7.4f rad, force %8.4f N\n", k * kStep, cart[k],
                result.x[swing_up.x[k] + 1], force[k]);
  return status == "solved" ? 0 : 1;
}
