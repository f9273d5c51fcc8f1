#include "wb/system.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace mcplan::wb {
namespace {

using Eigen::Lower;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDualDelta = 1e-7;  // of equalities: their violation falls by a step to about this times multipliers
constexpr double kSmallResidual = 1e-9;
constexpr int kMaxRefinements = 5;

}  // namespace

System::System(const Layout& layout, const Assembly& assembly, Products& products)
    : layout_(layout), assembly_(assembly), products_(products), band_(layout.nodes + 2, layout.velocities) {
  const int nv = layout.velocities;
  slack_weights_ = row_weights_ = rows_ = weighted_ = VectorXd::Zero(layout.rows);
  bound_weights_ = right_ = left_a_ = step_a_ = work_ = VectorXd::Zero(layout.variables);
  left_b_ = step_b_ = VectorXd::Zero(layout.equalities);
  forces_.resize(layout.nodes);
  Eigen::Index moving = 0, placed = 0;
  for (int k = 0; k < layout.nodes; ++k) {
    const int count = layout.node[k].forces;
    forces_[k].factor = MatrixXd::Zero(count, count);
    forces_[k].coupling = MatrixXd::Zero(count, 3 * nv);
    vectors_.push_back(products.make(k));
    moving = std::max(moving, assembly.node(k).moving.size());
    placed = std::max(placed, assembly.node(k).placed.size());
  }
  wide_ = MatrixXd::Zero(3 * nv, moving);
  window_ = MatrixXd::Zero(3 * nv, 3 * nv);
  placed_ = MatrixXd::Zero(nv, placed);
  square_ = MatrixXd::Zero(nv, nv);
}

void System::set_weights(const Eigen::Ref<const VectorXd>& slacks, const Eigen::Ref<const VectorXd>& bounds) {
  slack_weights_ = slacks;
  bound_weights_ = bounds;
}

/// A row j x + e - f whose e, f have the weights S and T: what is left of its weight D once they are eliminated.
void System::condense_weights() {
  row_weights_ = slack_weights_;
  for (int k = 0; k < layout_.nodes; ++k) {
    const NodeLayout& at = layout_.node[k];
    for (int i = 0; i < layout_.elastic_count(k); ++i) {
      double& D = row_weights_[at.first_row + layout_.joints + i];
      const double S = bound_weights_[at.first_elastic + 2 * i] + delta_;
      const double T = bound_weights_[at.first_elastic + 2 * i + 1] + delta_;
      D = D * S * T / (S * T + D * (S + T));
    }
  }
}

ipm::LinearSystem::Factor System::factor(double delta, double delta_c) {
  delta_ = delta;
  delta_c_ = std::max(delta_c, kDualDelta);
  condense_weights();
  band_.set_zero();
  for (int k = 0; k < layout_.nodes; ++k)
    if (!factor_node(k)) return Factor::wrong_inertia;
  const int nv = layout_.velocities;
  for (int i = 0; i < layout_.nodes + 2; ++i)
    band_.block(i, 0).diagonal() += bound_weights_.segment(i * nv, nv).array().matrix() + VectorXd::Constant(nv, delta);
  return band_.factor() ? Factor::good : Factor::wrong_inertia;
}

/// What a node adds: T' W T with the weights W of its costs and rows, less what its forces take off.
bool System::factor_node(int k) {
  const int nv = layout_.velocities;
  const NodeTerms& terms = assembly_.node(k);
  const NodeLayout& at = layout_.node[k];
  NodeVector& W = vectors_[k];
  W = products_.cost_weights(k);
  products_.add_inequalities(k, row_weights_, true, W);
  products_.add_to_equalities(k, 1.0 / delta_c_, W);
  const VectorXd root = W.moving.cwiseSqrt();
  const auto basis = [&](int order, int j) { return layout_.spline.basis(k, order, j); };
  auto A = wide_.leftCols(terms.moving.size());
  for (int j = 0; j < 3; ++j) {
    auto to = A.middleRows(j * nv, nv);
    to = basis(0, j) * terms.moving_q.transpose() + basis(1, j) * terms.moving_v.transpose() +
         basis(2, j) * terms.moving_a.transpose();
    to = to * root.asDiagonal();
  }
  window_.setZero();
  window_.selfadjointView<Lower>().rankUpdate(A);
  auto P = placed_.leftCols(terms.placed.size());
  P = terms.placed_q.transpose() * W.placed.cwiseSqrt().asDiagonal();
  square_.setZero();
  square_.selfadjointView<Lower>().rankUpdate(P);
  square_.triangularView<Eigen::StrictlyUpper>() = square_.transpose();
  square_.diagonal() += W.q;
  for (int j = 0; j < 3; ++j)
    for (int i = j; i < 3; ++i) {
      auto to = window_.block(i * nv, j * nv, nv, nv);
      to += basis(0, i) * basis(0, j) * square_;
      to.diagonal() += basis(1, i) * basis(1, j) * W.v + basis(2, i) * basis(2, j) * W.a;
    }
  if (at.forces > 0) {
    Forces& own = forces_[k];
    const MatrixXd to_force = root.head(nv).asDiagonal() * terms.moving_force;
    own.factor.setZero();
    own.factor.selfadjointView<Lower>().rankUpdate(to_force.transpose());
    own.factor.selfadjointView<Lower>().rankUpdate(terms.wrench.transpose() * W.wrench.cwiseSqrt().asDiagonal());
    own.factor.diagonal() +=
        W.force + bound_weights_.segment(at.first_force, at.forces) + VectorXd::Constant(at.forces, delta_);
    Eigen::LLT<Eigen::Ref<MatrixXd>> cholesky(own.factor);
    if (cholesky.info() != Eigen::Success) return false;
    own.coupling.noalias() = to_force.transpose() * A.leftCols(nv).transpose();
    own.factor.triangularView<Lower>().solveInPlace(own.coupling);
    window_.selfadjointView<Lower>().rankUpdate(own.coupling.transpose(), -1.0);
  }
  for (int j = 0; j < 3; ++j)
    for (int i = j; i < 3; ++i) band_.block(k + j, i - j) += window_.block(i * nv, j * nv, nv, nv);
  return true;
}

/// One pass through the factor: elastic variables and forces out, the band, and back.
void System::solve_once(const VectorXd& a, const VectorXd& b, VectorXd& dx, VectorXd& lambda) {
  const int nv = layout_.velocities;
  right_ = a;
  for (int k = 0; k < layout_.nodes; ++k) {
    const NodeLayout& at = layout_.node[k];
    for (int i = 0; i < layout_.elastic_count(k); ++i) {
      const int row = at.first_row + layout_.joints + i, e = at.first_elastic + 2 * i;
      const double D = slack_weights_[row], S = bound_weights_[e] + delta_, T = bound_weights_[e + 1] + delta_;
      weighted_[row] = -D * (T * a[e] - S * a[e + 1]) / (S * T + D * (S + T));
    }
    weighted_.segment(at.first_row, layout_.joints).setZero();
    NodeVector& y = vectors_[k];
    y.set_zero();
    products_.add_inequalities(k, weighted_, false, y);
    const auto own = b.segment(at.first_equality, layout_.equality_count(k));
    step_b_.segment(at.first_equality, own.size()) = own / delta_c_;
    products_.add_equalities(k, step_b_, y);
    products_.add_transposed(k, y, right_);
    if (at.forces == 0) continue;
    auto force = right_.segment(at.first_force, at.forces);
    forces_[k].factor.triangularView<Lower>().solveInPlace(force);
    right_.segment(layout_.window(k), 3 * nv).noalias() -= forces_[k].coupling.transpose() * force;
  }
  band_.solve(right_.head(layout_.coefficients));
  for (int k = 0; k < layout_.nodes; ++k) {
    const NodeLayout& at = layout_.node[k];
    if (at.forces == 0) continue;
    auto force = right_.segment(at.first_force, at.forces);
    force.noalias() -= forces_[k].coupling * right_.segment(layout_.window(k), 3 * nv);
    forces_[k].factor.triangularView<Lower>().transpose().solveInPlace(force);
  }
  dx = right_;
  for (int k = 0; k < layout_.nodes; ++k) {
    const NodeLayout& at = layout_.node[k];
    NodeVector& y = vectors_[k];
    products_.image(k, dx, y);
    products_.to_equalities(k, y, lambda);
    products_.to_inequalities(k, y, rows_);
    for (int i = 0; i < layout_.elastic_count(k); ++i) {
      const int row = at.first_row + layout_.joints + i, e = at.first_elastic + 2 * i;
      const double D = slack_weights_[row], S = bound_weights_[e] + delta_, T = bound_weights_[e + 1] + delta_;
      const double det = S * T + D * (S + T), value = rows_[row];
      dx[e] = ((T + D) * a[e] + D * a[e + 1] - D * T * value) / det;
      dx[e + 1] = (D * a[e] + (S + D) * a[e + 1] + D * S * value) / det;
    }
  }
  lambda = (lambda - b) / delta_c_;
}

void System::residual(const VectorXd& a, const VectorXd& b, const VectorXd& dx, const VectorXd& lambda) {
  left_a_ = -(bound_weights_.array() + delta_) * dx.array();
  for (int k = 0; k < layout_.nodes; ++k) {
    const NodeLayout& at = layout_.node[k];
    NodeVector& y = vectors_[k];
    products_.image(k, dx, y);
    products_.to_equalities(k, y, left_b_);
    products_.to_inequalities(k, y, rows_);
    for (int i = 0; i < layout_.elastic_count(k); ++i) {
      const int row = at.first_row + layout_.joints + i, e = at.first_elastic + 2 * i;
      rows_[row] += dx[e] - dx[e + 1];
    }
    auto own = weighted_.segment(at.first_row, layout_.row_count(k));
    own = -slack_weights_.segment(at.first_row, own.size()).cwiseProduct(rows_.segment(at.first_row, own.size()));
    const NodeVector& W = products_.cost_weights(k);
    y.q.array() *= -W.q.array();
    y.v.array() *= -W.v.array();
    y.a.array() *= -W.a.array();
    y.moving.array() *= -W.moving.array();
    y.placed.array() *= -W.placed.array();
    y.wrench.array() *= -W.wrench.array();
    y.force.array() *= -W.force.array();
    products_.add_inequalities(k, weighted_, false, y);
    step_b_.segment(at.first_equality, layout_.equality_count(k)) =
        -lambda.segment(at.first_equality, layout_.equality_count(k));
    products_.add_equalities(k, step_b_, y);
    products_.add_transposed(k, y, left_a_);
    for (int i = 0; i < layout_.elastic_count(k); ++i) {
      const double value = weighted_[at.first_row + layout_.joints + i];
      left_a_[at.first_elastic + 2 * i] += value;
      left_a_[at.first_elastic + 2 * i + 1] -= value;
    }
  }
  left_a_ += a;
  left_b_ = b - left_b_ + delta_c_ * lambda;
}

void System::refine(const VectorXd& a, const VectorXd& b, VectorXd& dx, VectorXd& lambda) {
  const double size = std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), 1e-300});
  double before = nlp::kInfinity;
  for (int i = 0; i <= kMaxRefinements; ++i) {
    residual(a, b, dx, lambda);
    residual_ = std::max(left_a_.cwiseAbs().maxCoeff(), left_b_.cwiseAbs().maxCoeff()) / size;
    if (!(residual_ > kSmallResidual) || !(residual_ < 0.5 * before) || i == kMaxRefinements) return;
    before = residual_;
    solve_once(VectorXd(left_a_), VectorXd(left_b_), step_a_, step_b_);
    dx += step_a_;
    lambda += step_b_;
  }
}

void System::solve(const VectorXd& a, const VectorXd& b, VectorXd& dx, VectorXd& lambda) {
  solve_once(a, b, dx, lambda);
  refine(a, b, dx, lambda);
}

void System::solve_roughly(const Solution& first_right, const Solution& second_right, Solution& first,
                           Solution& second) {
  solve_once(first_right.dx, first_right.lambda, first.dx, first.lambda);
  solve_once(second_right.dx, second_right.lambda, second.dx, second.lambda);
}

void System::multiply_inequalities(const VectorXd& x, VectorXd& out) const {
  for (int k = 0; k < layout_.nodes; ++k) {
    const NodeLayout& at = layout_.node[k];
    products_.image(k, x, vectors_[k]);
    products_.to_inequalities(k, vectors_[k], out);
    for (int i = 0; i < layout_.elastic_count(k); ++i)
      out[at.first_row + layout_.joints + i] += x[at.first_elastic + 2 * i] - x[at.first_elastic + 2 * i + 1];
  }
}

void System::add_inequalities_transposed(const VectorXd& y, VectorXd& out) const {
  for (int k = 0; k < layout_.nodes; ++k) {
    const NodeLayout& at = layout_.node[k];
    vectors_[k].set_zero();
    products_.add_inequalities(k, y, false, vectors_[k]);
    products_.add_transposed(k, vectors_[k], out);
    for (int i = 0; i < layout_.elastic_count(k); ++i) {
      const double value = y[at.first_row + layout_.joints + i];
      out[at.first_elastic + 2 * i] += value;
      out[at.first_elastic + 2 * i + 1] -= value;
    }
  }
}

void System::add_equalities_transposed(const VectorXd& y, VectorXd& out) const {
  for (int k = 0; k < layout_.nodes; ++k) {
    vectors_[k].set_zero();
    products_.add_equalities(k, y, vectors_[k]);
    products_.add_transposed(k, vectors_[k], out);
  }
}

}  // namespace mcplan::wb
