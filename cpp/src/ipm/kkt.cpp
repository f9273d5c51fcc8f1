#include "ipm/kkt.hpp"

#include <algorithm>
#include <cmath>

#include "ipm/order.hpp"

namespace mcplan::ipm {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxRefinements = 5;
constexpr double kSmallResidual = 1e-9;  // as little as a step of the barrier method needs
constexpr double kNoPivot = 1e-14;       // of an equality, over its size: the rounding errors of nothing
constexpr int kFewRows = 64;             // up to which a product is cheaper without packing its factors

}  // namespace

Kkt::Kkt(const nlp::Problem& problem, const Unknowns& unknowns)
    : n_(unknowns.free_count()),
      m_(unknowns.equality_count()),
      fronts_(n_ + m_, elimination_order(problem, unknowns), structure(problem, unknowns, *this)) {
  const std::vector<int>& places = fronts_.places();
  std::size_t next = 0;
  for (Term& term : hessian_terms_) term.place = places[next++];
  for (Term& term : equality_terms_) term.place = places[next++];
  int widest = 0, longest = 0;
  for (Dense& block : dense_) {
    block.first_place = static_cast<int>(next);
    next += block.columns * (block.columns + 1) / 2;
    widest = std::max(widest, block.columns);
    longest = std::max(longest, block.rows);
  }
  block_ = MatrixXd::Zero(longest, widest);
  product_ = MatrixXd::Zero(widest, widest);
  slack_weights_ = VectorXd::Zero(unknowns.slack_count());
  slacks_ = roots_ = slack_weights_;
  bound_weights_ = VectorXd::Zero(n_);
  right_.resize(n_ + m_);
  left_a_.resize(n_);
  left_b_.resize(m_);
}

std::vector<Fronts::Pair> Kkt::structure(const nlp::Problem& problem, const Unknowns& unknowns, Kkt& out) {
  out.hessian_terms_.clear();
  std::vector<Fronts::Pair> pairs;
  for (std::size_t i = 0; i < problem.hessian_structure().size(); ++i) {
    const nlp::Entry& entry = problem.hessian_structure()[i];
    const int a = unknowns.index_of[entry.row], b = unknowns.index_of[entry.column];
    if (a < 0 || b < 0) continue;
    out.hessian_terms_.push_back({static_cast<int>(i), a, b, 0});
    pairs.emplace_back(a, b);
  }
  for (std::size_t i = 0; i < problem.jacobian_structure().size(); ++i) {
    const nlp::Entry& entry = problem.jacobian_structure()[i];
    const int column = unknowns.index_of[entry.column];
    if (column < 0) continue;
    if (const int row = unknowns.equality_of[entry.row]; row >= 0) {
      out.equality_terms_.push_back({static_cast<int>(i), row, column, 0});
      pairs.emplace_back(column, unknowns.free_count() + row);
    }
    if (const int row = unknowns.slack_of[entry.row]; row >= 0)
      out.inequality_terms_.push_back({static_cast<int>(i), row, column, 0});
  }
  std::vector<int> local(problem.variable_count(), -1);
  for (const nlp::Problem::Block& block : problem.blocks()) {
    if (block.is_cost()) continue;
    Dense dense;
    std::vector<int> columns, local_row(block.piece->rows(), -1);
    for (std::size_t i = 0; i < block.jacobian_at.size(); ++i) {
      const int row = block.jacobian_from[i] % block.piece->rows();
      const int variable = block.piece->variables()[block.jacobian_from[i] / block.piece->rows()];
      const int slack = unknowns.slack_of[block.first_row + row], column = unknowns.index_of[variable];
      if (slack < 0 || column < 0) continue;
      if (local_row[row] < 0) {
        local_row[row] = dense.rows++;
        dense.slacks.push_back(slack);
      }
      if (local[variable] < 0) {
        local[variable] = dense.columns++;
        columns.push_back(column);
      }
      dense.entries.push_back({block.jacobian_at[i], local_row[row], local[variable]});
    }
    for (int column : columns) local[unknowns.free[column]] = -1;
    if (dense.rows == 0) continue;
    for (int j = 0; j < dense.columns; ++j)
      for (int i = j; i < dense.columns; ++i) pairs.emplace_back(columns[i], columns[j]);
    out.dense_.push_back(std::move(dense));
  }
  return pairs;
}

void Kkt::set_weights(const Eigen::Ref<const VectorXd>& slacks, const Eigen::Ref<const VectorXd>& bounds) {
  slack_weights_ = slacks;
  roots_ = slacks.cwiseSqrt();
  bound_weights_ = bounds;
}

void Kkt::assemble(double delta, double delta_c) {
  fronts_.set_zero();
  double* values = fronts_.values();
  for (const Term& term : hessian_terms_) values[term.place] += hessian_[term.from];
  for (const Term& term : equality_terms_) values[term.place] += jacobian_[term.from];
  const std::vector<int>& diagonal = fronts_.diagonal_places();
  for (int i = 0; i < n_; ++i) values[diagonal[i]] += bound_weights_[i] + delta;
  for (int i = 0; i < m_; ++i) values[diagonal[n_ + i]] -= delta_c;
  for (const Dense& dense : dense_) {
    auto A = block_.topLeftCorner(dense.rows, dense.columns);
    auto C = product_.topLeftCorner(dense.columns, dense.columns);
    A.setZero();
    for (const Dense::Entry& entry : dense.entries)
      A(entry.row, entry.column) = jacobian_[entry.from] * roots_[dense.slacks[entry.row]];
    const int* place = fronts_.places().data() + dense.first_place;
    if (dense.rows <= kFewRows) {
      for (int j = 0; j < dense.columns; ++j)
        for (int i = j; i < dense.columns; ++i) values[*place++] += A.col(i).dot(A.col(j));
      continue;
    }
    C.setZero();
    C.selfadjointView<Eigen::Lower>().rankUpdate(A.transpose());
    for (int j = 0; j < dense.columns; ++j)
      for (int i = j; i < dense.columns; ++i) values[*place++] += C(i, j);
  }
  // An equality's pivot is a sum of squares of its coefficients, each over about the variable's diagonal entry.
  VectorXd& least = fronts_.least_pivots();
  least.tail(m_).setZero();
  if (delta_c > 0.0) return;
  for (const Term& term : equality_terms_) {
    const double square = jacobian_[term.from] * jacobian_[term.from];
    double& of_row = least[n_ + term.row];
    of_row = std::max(of_row, kNoPivot * square / std::max(1.0, std::abs(values[diagonal[term.column]])));
  }
}

Kkt::Factor Kkt::factor(double delta, double delta_c) {
  delta_ = delta;
  delta_c_ = delta_c;
  assemble(delta, delta_c);
  const Fronts::Inertia inertia = fronts_.factor();
  // Fewer negative pivots than equalities: these say the same twice, and rounding errors stand for what is zero.
  if (inertia.zero > 0 || inertia.negative < m_) return Factor::singular;
  return inertia.negative == m_ ? Factor::good : Factor::wrong_inertia;
}

void Kkt::multiply_inequalities(const VectorXd& x, VectorXd& out) const {
  out.setZero();
  for (const Term& term : inequality_terms_) out[term.row] += jacobian_[term.from] * x[term.column];
}

void Kkt::add_inequalities_transposed(const VectorXd& y, VectorXd& out) const {
  for (const Term& term : inequality_terms_) out[term.column] += jacobian_[term.from] * y[term.row];
}

void Kkt::multiply_equalities(const VectorXd& x, VectorXd& out) const {
  out.setZero();
  for (const Term& term : equality_terms_) out[term.row] += jacobian_[term.from] * x[term.column];
}

void Kkt::add_equalities_transposed(const VectorXd& y, VectorXd& out) const {
  for (const Term& term : equality_terms_) out[term.column] += jacobian_[term.from] * y[term.row];
}

void Kkt::residual(const VectorXd& a, const VectorXd& b, const VectorXd& dx, const VectorXd& lambda) {
  multiply_equalities(dx, left_b_);
  left_b_ = b - left_b_ + delta_c_ * lambda;
  multiply_inequalities(dx, slacks_);
  slacks_.array() *= slack_weights_.array();
  left_a_.array() = (bound_weights_.array() + delta_) * dx.array();
  for (const Term& term : hessian_terms_) {
    const double value = hessian_[term.from];
    left_a_[term.row] += value * dx[term.column];
    if (term.row != term.column) left_a_[term.column] += value * dx[term.row];
  }
  add_inequalities_transposed(slacks_, left_a_);
  add_equalities_transposed(lambda, left_a_);
  left_a_ = a - left_a_;
}

void Kkt::solve_roughly(const VectorXd& a, const VectorXd& b, VectorXd& dx, VectorXd& lambda) {
  right_ << a, b;
  fronts_.solve(right_);
  dx = right_.head(n_);
  lambda = right_.tail(m_);
}

void Kkt::solve(const VectorXd& a, const VectorXd& b, VectorXd& dx, VectorXd& lambda) {
  const double largest_a = n_ > 0 ? a.cwiseAbs().maxCoeff() : 0.0, largest_b = m_ > 0 ? b.cwiseAbs().maxCoeff() : 0.0;
  const double size = std::max({largest_a, largest_b, 1e-300});
  solve_roughly(a, b, dx, lambda);
  double before = nlp::kInfinity;
  for (int i = 0; i <= kMaxRefinements; ++i) {
    residual(a, b, dx, lambda);
    residual_ =
        std::max(n_ > 0 ? left_a_.cwiseAbs().maxCoeff() : 0.0, m_ > 0 ? left_b_.cwiseAbs().maxCoeff() : 0.0) / size;
    if (!(residual_ > kSmallResidual) || !(residual_ < 0.5 * before) || i == kMaxRefinements) return;
    before = residual_;
    right_ << left_a_, left_b_;
    fronts_.solve(right_);
    dx += right_.head(n_);
    lambda += right_.tail(m_);
  }
}

}  // namespace mcplan::ipm
